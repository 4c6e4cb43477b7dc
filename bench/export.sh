#!/usr/bin/env bash
# A whole export with one intruder of about 60 px against ffmpeg transcoding the same clip with the same settings.
#   bench/export.sh [--write] [RUNS] [BUILD] [CLIP...]     default: 5 interleaved runs of build/release, all clips
# --write puts the table into docs/speed.md. Clips, in H.264: `sample`, the sample footage (1280x960, 200 frames); `coast`, where
# ../shared/data is there, a flight over a coast, scaled to the same; `sample-4k`, the middle of the sample footage scaled to
# 3840x2160, 48 frames.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
runs=${1:-5}
sigs=$PWD/${2:-build/release}/sigs
wanted=" ${*:3} "
here=$PWD
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

# As engine/video/libav/encoding.cpp sets them up.
h264=(-c:v libx264 -crf 18 -g 60 -x264-params threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1)
ffv1=(-c:v ffv1 -level 3 -g 1 -slicecrc 1 -threads "$(nproc)")

# Formation flight: the intruder keeps its position in front of the camera, so its size is constant. 25 frames a second, 22 m/s.
project() { # NAME CLIP FRAMES RATE CALIBRATION TIMES_AS_FAR
  local last=$(($3 - 1))
  waypoint() { # FRAME RATE TIMES_AS_FAR
    awk -v n="$1" -v rate="$2" -v k="$3" \
      'BEGIN { printf "{\"frame\": %d, \"position_m\": [%.4f, %.4f, %.4f]}", n, 80 * k + 22 * n / rate, 15 * k, -150 - 15 * k }'
  }
  cat >"$lot/$1.json" <<EOF
{"sigs": 1, "name": "$1",
 "footage": {"video": "$2", "calibration": "$5"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0},
 "intruders": [{"name": "light-aircraft",
   "model": {"file": "$here/assets/models/light-aircraft/light-aircraft.obj", "forward": "+x", "up": "+z"},
   "trajectory": {"waypoints": [
     $(waypoint 0 "$4" "$6"),
     $(waypoint "$last" "$4" "$6")]}}]}
EOF
}
is_wanted() {
  [ "$wanted" = "  " ] || [[ "$wanted" == *" $1 "* ]]
}
lens=$here/assets/calibrations/sample.xml
source bench/scaled_sample.sh

clips=()
if is_wanted sample; then
  cp assets/footage/sample.mp4 "$lot/sample.mp4"
  project sample "$lot/sample.mp4" 200 25 "$lens" 1
  clips+=(sample)
fi
if is_wanted coast && [ -e ../shared/data/video/air_karma_gopro_coast.mp4 ]; then
  ffmpeg -v error -i ../shared/data/video/air_karma_gopro_coast.mp4 -an -frames:v 200 -vf scale=1280:960 \
    -c:v libx264 -crf 18 -pix_fmt yuv420p "$lot/coast.mp4"
  project coast "$lot/coast.mp4" 200 29.97 "$lens" 1
  clips+=(coast)
fi
if is_wanted sample-4k; then
  ffmpeg -v error -i assets/footage/sample.mp4 -an -frames:v 48 -vf crop=1280:720:0:120,scale=3840:2160 \
    -c:v libx264 -crf 18 -pix_fmt yuv420p "$lot/sample-4k.mp4"
  scaled_lens 3840 2160 >"$lot/lens-4k.xml"
  project sample-4k "$lot/sample-4k.mp4" 48 25 "$lot/lens-4k.xml" 3
  clips+=(sample-4k)
fi

TIMEFORMAT='%R %U %S'
timed() { # KEY COMMAND...
  local key=$1 times
  shift
  times=$({ time "$@" >/dev/null 2>"$lot/said"; } 2>&1) || { cat "$lot/said" >&2; exit 1; }
  echo "$key $times"
}
export_with() { # CLIP CODEC MASKS
  "$sigs" export "$lot/$1.json" --out "$lot/out" --force --codec "$2" --masks "$3" --progress none
}

for _ in $(seq "$runs"); do
  for clip in "${clips[@]}"; do
    timed "$clip h264 ffmpeg" ffmpeg -y -v error -i "$lot/$clip.mp4" -an "${h264[@]}" "$lot/out.mp4"
    timed "$clip h264 none" export_with "$clip" h264 none
    timed "$clip h264 masks" export_with "$clip" h264 video
    timed "$clip ffv1 ffmpeg" ffmpeg -y -v error -i "$lot/$clip.mp4" -an "${ffv1[@]}" "$lot/out.mkv"
    timed "$clip ffv1 none" export_with "$clip" ffv1 none
    timed "$clip ffv1 masks" export_with "$clip" ffv1 video
  done
done >"$lot/times"

# Medians of wall-clock and of processor time (user and system).
awk "$(cat bench/median.awk)"'
  { row = $1 " " $2; if (!(row in seen)) { seen[row] = 1; order[++rows] = row }
    values[row " " $3 " wall"] = values[row " " $3 " wall"] " " $4
    values[row " " $3 " work"] = values[row " " $3 " work"] " " ($5 + $6) }
  END {
    print "| clip | codec | ffmpeg s | sigs s | ratio | with masks | ratio | ffmpeg processor s | sigs | ratio | with masks | ratio |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= rows; r++) {
      split(order[r], name, " ")
      printf "| %s | %s", name[1], name[2]
      for (k = 1; k <= 2; k++) {
        kind = k == 1 ? " wall" : " work"
        base = median(order[r] " ffmpeg" kind); plain = median(order[r] " none" kind); masks = median(order[r] " masks" kind)
        printf " | %.2f | %.2f | **%.2f** | %.2f | %.2f", base, plain, plain / base, masks, masks / base
      }
      print " |"
    }
  }' "$lot/times" | tee "$lot/table"

if [ -n "$write" ]; then
  bench/fill.sh docs/speed.md export "$lot/table"
fi
