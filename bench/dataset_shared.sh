#!/usr/bin/env bash
# What `sigs dataset` saves by sharing, against another build: interleaved pairs, medians, the same checksums.
#   bench/dataset_shared.sh videos SIGS_BEFORE [RUNS] [BUILD] [VIDEOS] [CODEC...]
#     VIDEOS encounters of 100 frames in the sample clip (1280x960); default: 3 pairs, build/release, 40, ffv1
#   bench/dataset_shared.sh images SIGS_BEFORE [RUNS] [BUILD] [CLIPS] [CODEC...]
#     25 images of each of CLIPS clips of ../shared/data/track, and the videos of the same clips with one small aircraft;
#     default: 3 pairs, build/release, 40, ffv1
# SIGS_BEFORE: the other program, such as /tmp/before/sigs. `bench/dataset.sh shared ...` runs this script.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=$1
before=$(realpath "$2")
runs=${3:-3}
now=$PWD/${4:-build/release}/sigs
count=${5:-40}
codecs=("${@:6}")
[ ${#codecs[@]} -gt 0 ] || codecs=(ffv1)
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

aircraft() { # NAME...
  local name comma=''
  for name in "$@"; do
    echo "$comma{\"name\": \"$name\", \"category\": \"airplane\", \"model\": {\"file\": \"$PWD/assets/models/$name/$name.obj\"}}"
    comma=,
  done
}

head_of() { # NAME CODEC
  local masks=video
  case $2 in png | jpeg | tiff) masks=none ;; esac
  echo "{\"sigs_dataset\": 1, \"name\": \"$1\", \"seed\": 7, \"settings\": {\"export.video.codec\": \"$2\", \"export.masks\": \"$masks\","
  echo '"export.labels": ["xml"]}, "backgrounds": ['
}
light='"light": {"kind": "sun", "sun": {"azimuth_deg": 120, "elevation_deg": 40}}'

encounters() { # CODEC
  head_of encounters "$1"
  echo "{\"name\": \"day\", \"footage\": {\"video\": \"$PWD/assets/footage/sample.mp4\", \"calibration\": \"$PWD/assets/calibrations/sample.xml\"},"
  echo "\"camera\": {\"position_m\": [0, 0, -1500], \"attitude_deg\": {\"roll\": 0, \"pitch\": 0}, \"speed_mps\": 22}, $light}"
  echo "], \"aircraft\": [$(aircraft airliner)],"
  echo "\"videos\": [{\"name\": \"near-{number}\", \"count\": $count, \"frames\": 100, \"redraws\": 100, \"flights\": [{\"kind\": \"encounter\","
  echo '"miss_distance_m": {"uniform": [0, 150]}, "miss_angle_deg": {"choice": [0, 180]}, "closing_speed_mps": {"uniform": [85, 140]},'
  echo '"bearing_deg": {"uniform": [-20, 20]}, "elevation_deg": 3, "time_of_closest_approach_s": 8}]}]}'
}

clips() {
  local clip comma='' number=0
  for clip in ../shared/data/track/*.mp4; do
    ((number++ < count)) || break
    echo "$comma{\"name\": \"$(basename "$clip" .mp4)\", \"footage\": {\"video\": \"$(realpath "$clip")\", \"calibration\": \"$lot/camera.xml\"},"
    echo "\"camera\": {\"position_m\": [0, 0, -5000]}, $light}"
    comma=,
  done
}

images() {
  head_of images png
  clips
  echo "], \"aircraft\": [$(aircraft airliner light-aircraft)], \"videos\": [{\"images\": $((25 * count))}]}"
}

videos_of_clips() { # CODEC
  head_of videos "$1"
  clips
  echo "], \"aircraft\": [$(aircraft airliner)], \"videos\": [{\"name\": \"{background}\", \"flights\": [{\"kind\": \"image_position\","
  echo '"x_percent": 50, "y_percent": 50, "size_px": 30}]}]}'
}

cat >"$lot/camera.xml" <<'XML'
<?xml version="1.0"?>
<opencv_storage>
<image_width>640</image_width><image_height>512</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt><data>1500 0 319.5 0 1500 255.5 0 0 1</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>5</rows><cols>1</cols><dt>d</dt><data>0 0 0 0 0</data></distortion_coefficients>
</opencv_storage>
XML

# Appends "KEY wall-s processor-s MB" to the times, and keeps the checksum.
timed() { # KEY SIGS RECIPE
  rm -rf "$lot/out"
  /usr/bin/time -o "$lot/time" -f '%e %U %S %M' "$2" dataset "$lot/$3.json" --out "$lot/out" --progress none >/dev/null 2>"$lot/said" ||
    { cat "$lot/said" >&2; exit 1; }
  tail -1 "$lot/time" | awk -v key="$1" '{ print key, $1, $2 + $3, $4 / 1024 }' >>"$lot/times"
  sha256sum <"$lot/out/SHA256SUMS" >"$lot/sum.$3.${1##* }"
}

pair() { # RECIPE
  local run
  for ((run = 0; run < runs; ++run)); do
    timed "$1 before" "$before" "$1"
    timed "$1 now" "$now" "$1"
    cmp -s "$lot/sum.$1.before" "$lot/sum.$1.now" || { echo "$1: other bytes" >&2; exit 1; }
  done
}

if [ "$kind" = images ]; then
  images >"$lot/images.json"
  pair images
fi
for codec in "${codecs[@]}"; do
  if [ "$kind" = images ]; then videos_of_clips "$codec"; else encounters "$codec"; fi >"$lot/$codec.json"
  pair "$codec"
done

awk "$(cat bench/median.awk)"'
  {
    if (!($1 in seen)) { order[++count] = $1; seen[$1] = 1 }
    for (i = 3; i <= 5; i++) values[$1 $2 i] = values[$1 $2 i] " " $i
  }
  END {
    print "| dataset | before: s | processor s | MB | now: s | processor s | MB | ratio of s | of processor s |"
    print "|---|---|---|---|---|---|---|---|---|"
    for (n = 1; n <= count; n++) {
      key = order[n]; b = key "before"; a = key "now"
      printf "| %s | %.1f | %.1f | %.0f | %.1f | %.1f | %.0f | %.2f | **%.2f** |\n", key, median(b 3), median(b 4), median(b 5),
        median(a 3), median(a 4), median(a 5), median(a 3) / median(b 3), median(a 4) / median(b 4)
    }
    if ("images" in seen)
      for (n = 2; n <= count; n++)
        printf "images against the videos in %s: %.2f of the time, %.2f of the processor time\n", order[n],
          median("imagesnow" 3) / median(order[n] "now" 3), median("imagesnow" 4) / median(order[n] "now" 4)
  }' "$lot/times"
