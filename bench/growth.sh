#!/usr/bin/env bash
# How an export's time and memory grow with frames and with intruders, on a looped clip of 320x240.
#   bench/growth.sh [--write] [BUILD] [FRAMES...]     default: build/release, 500 5000 50000 frames
# --write puts the tables into docs/speed.md. Memory is the maximum resident size (VmHWM).
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
sigs=$PWD/${1:-build/release}/sigs
shift || true
counts=("${@:-500}")
[ $# -gt 0 ] || counts=(500 5000 50000)
here=$PWD
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

ffmpeg -v error -i assets/footage/sample.mp4 -an -vf scale=320:240 -c:v libx264 -crf 20 -pix_fmt yuv420p "$lot/small.mp4"
# The sample's lens at a quarter of its size.
cat >"$lot/lens.xml" <<'EOF'
<?xml version="1.0"?>
<opencv_storage>
<image_width>320</image_width>
<image_height>240</image_height>
<fisheye_model>1</fisheye_model>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
  <data>140.4575 0. 160.3025 0. 140.3175 118.965 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>4</rows><cols>1</cols><dt>d</dt>
  <data>0.0432 0.0115 -0.0104 0.0021</data></distortion_coefficients>
</opencv_storage>
EOF

looped() { # FRAMES
  [ -e "$lot/$1.mp4" ] || ffmpeg -v error -stream_loop -1 -i "$lot/small.mp4" -c copy -frames:v "$1" "$lot/$1.mp4"
}

# Intruders side by side with the camera's velocity, so each keeps its size.
project() { # NAME FRAMES INTRUDERS
  local last=$(($2 - 1)) i list=
  for i in $(seq "$3"); do
    list+="${list:+,}$(awk -v i="$i" -v last="$last" -v model="$here/assets/models/light-aircraft/light-aircraft.obj" 'BEGIN {
      y = 25 * (i % 2 ? 1 : -1) * int(i / 2 + 0.5); z = -165 - 8 * (i % 3)
      printf "{\"name\": \"number-%d\", \"model\": {\"file\": \"%s\", \"forward\": \"+x\", \"up\": \"+z\"}, ", i, model
      printf "\"trajectory\": {\"waypoints\": [{\"frame\": 0, \"position_m\": [80, %d, %d]}, ", y, z
      printf "{\"frame\": %d, \"position_m\": [%.4f, %d, %d]}]}}", last, 80 + 22 * last / 25, y, z }')"
  done
  cat >"$lot/$1.json" <<EOF
{"sigs": 1, "name": "$1", "footage": {"video": "$lot/$2.mp4", "calibration": "$lot/lens.xml"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0}, "intruders": [$list]}
EOF
}

TIMEFORMAT='%R %U %S'
# Prints wall-clock, user and system seconds and the maximum resident kilobytes.
measured() { # NAME
  local times
  times=$({ time {
    "$sigs" export "$lot/$1.json" --out "$lot/out" --force --codec h264 --masks video --progress none >"$lot/said" 2>&1 &
    local running=$! most=0 line
    while line=$(grep VmHWM "/proc/$running/status" 2>/dev/null); do
      most=$(awk '{ print $2 }' <<<"$line")
      sleep 0.2
    done
    wait "$running" || { cat "$lot/said" >&2; exit 1; }
    echo "$most" >"$lot/most"
  } 2>&3; } 3>&2 2>&1)
  echo "$times $(cat "$lot/most")"
}

{
  echo "| frames | ms a frame | processor ms a frame | resident at most, MB | of that at ${counts[0]} |"
  echo "|---|---|---|---|---|"
  first=
  for frames in "${counts[@]}"; do
    looped "$frames"
    project "long-$frames" "$frames" 1
    read -r wall user system most < <(measured "long-$frames")
    first=${first:-$most}
    awk -v n="$frames" -v wall="$wall" -v work="$user $system" -v most="$most" -v first="$first" 'BEGIN {
      split(work, w, " ")
      printf "| %d | %.2f | %.2f | %.0f | %.3f |\n", n, 1000 * wall / n, 1000 * (w[1] + w[2]) / n, most / 1024, most / first }'
  done
} | tee "$lot/frames.table"
echo
{
  echo "| intruders | ms a frame | processor ms a frame | ms a frame for each more |"
  echo "|---|---|---|---|"
  looped 500
  before=
  for intruders in 1 2 4 8; do
    project "many-$intruders" 500 "$intruders"
    read -r wall user system most < <(measured "many-$intruders")
    awk -v k="$intruders" -v wall="$wall" -v work="$user $system" -v before="$before" 'BEGIN {
      split(work, w, " "); n = split(before, b, " "); ms = 2 * (w[1] + w[2])
      printf "| %d | %.2f | %.2f | %s |\n", k, 2 * wall, ms, n ? sprintf("%.2f", (ms - b[2]) / (k - b[1])) : "" }'
    before="$intruders $(awk -v u="$user" -v s="$system" 'BEGIN { print 2 * (u + s) }')"
  done
} | tee "$lot/intruders.table"

if [ -n "$write" ]; then
  bench/fill.sh docs/speed.md frames "$lot/frames.table"
  bench/fill.sh docs/speed.md intruders "$lot/intruders.table"
fi
