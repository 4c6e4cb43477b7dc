#!/usr/bin/env bash
# A whole export with one intruder of about 60 px against ffmpeg transcoding the same clip with the same settings.
#   bench/export.sh [--write] [RUNS] [BUILD]     default: 5 interleaved runs of build/release
# --write puts the table into docs/speed.md. Clips are of 1280x960 and H.264: the sample footage and, where
# ../shared/data is there, a flight over a coast, scaled up.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
runs=${1:-5}
sigs=$PWD/${2:-build/release}/sigs
here=$PWD
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

# As engine/video/libav/encoding.cpp sets them up.
h264=(-c:v libx264 -crf 18 -g 60 -x264-params threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1)
ffv1=(-c:v ffv1 -level 3 -g 1 -slicecrc 1 -threads "$(nproc)")

# Formation flight: the intruder keeps its position in front of the camera, so its size is constant. 25 frames a second, 22 m/s.
project() { # NAME CLIP FRAMES RATE
  local last=$(($3 - 1))
  local far
  far=$(awk -v n="$last" -v rate="$4" 'BEGIN { printf "%.4f", 22 * n / rate }')
  cat >"$lot/$1.json" <<EOF
{"sigs": 1, "name": "$1",
 "footage": {"video": "$2", "calibration": "$here/assets/calibrations/sample.xml"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0},
 "intruders": [{"name": "light-aircraft",
   "model": {"file": "$here/assets/models/light-aircraft/light-aircraft.obj", "forward": "+x", "up": "+z"},
   "trajectory": {"waypoints": [
     {"frame": 0, "position_m": [80, 15, -165]},
     {"frame": $last, "position_m": [$(awk -v a="$far" 'BEGIN { print 80 + a }'), 15, -165]}]}}]}
EOF
}

clips=(sample)
project sample "$here/assets/footage/sample.mp4" 200 25
cp assets/footage/sample.mp4 "$lot/sample.mp4"
if [ -e ../shared/data/video/air_karma_gopro_coast.mp4 ]; then
  ffmpeg -v error -i ../shared/data/video/air_karma_gopro_coast.mp4 -an -frames:v 200 -vf scale=1280:960 \
    -c:v libx264 -crf 18 -pix_fmt yuv420p "$lot/coast.mp4"
  project coast "$lot/coast.mp4" 200 29.97
  clips+=(coast)
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
awk '
  function median(key,   n, i, j, t, v) {
    n = split(values[key], v, " ")
    for (i = 1; i <= n; i++) for (j = i + 1; j <= n; j++) if (v[j] + 0 < v[i] + 0) { t = v[i]; v[i] = v[j]; v[j] = t }
    return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
  }
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
