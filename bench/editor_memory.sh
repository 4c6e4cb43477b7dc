#!/usr/bin/env bash
# The editor's memory with 4K footage: the amount that it reports, and the resident memory of its process, while it
# plays, is scrubbed, a waypoint is dragged, and stages are shown. Fails where the sum is above the limit by more
# than the shown images. Needs Xvfb, xdotool and ffmpeg, no display; about two minutes.
#   bench/editor_memory.sh [BUILD]     default: build/release
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
source bench/editor_on_screen.sh

ffmpeg -v error -f lavfi -i testsrc2=size=3840x2160:rate=25 -frames:v 300 -c:v libx264 -preset ultrafast -crf 28 \
  -pix_fmt yuv420p -g 25 "$work/clip.mp4"
cat >"$work/lens.xml" <<'XML'
<?xml version="1.0"?>
<opencv_storage>
<image_width>3840</image_width>
<image_height>2160</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
  <data>2400. 0. 1919.5 0. 2400. 1079.5 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>1</rows><cols>4</cols><dt>d</dt>
  <data>-0.1 0.01 0. 0.</data></distortion_coefficients>
</opencv_storage>
XML
cat >"$work/project.json" <<JSON
{"sigs": 1, "name": "4k", "footage": {"video": "clip.mp4", "calibration": "lens.xml"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0},
 "intruders": [{"name": "one", "model": {"file": "$PWD/assets/models/light-aircraft/light-aircraft.obj",
  "forward": "+x", "up": "+z"}, "trajectory": {"waypoints": [{"frame": 0, "position_m": [90, -30, -170]},
  {"frame": 299, "position_m": [350, 30, -160]}]}}]}
JSON

# told KEY: a number of bytes in the editor's probe, in MiB; 0 where it is missing.
told() { { grep -oE "\"$1\":[0-9]+" "$probe" || echo :0; } | cut -d: -f2 | awk '{ printf "%d", $1 / 1048576 }'; }
resident() { awk '/VmRSS/ { printf "%d", $2 / 1024 }' "/proc/$editor/status"; }

# Between watch_memory and end_watch NAME a reading is recorded five times a second; then the largest ones are printed.
watch_memory() {
  touch "$work/going"
  (while [ -e "$work/going" ]; do
    echo "$(told sum) $(told shown) $(told textures) $(told images) $(told decoded) $(told limit) $(resident)"
    sleep 0.2
  done) >"$work/readings" &
  watching=$!
}
end_watch() {
  rm "$work/going"
  wait "$watching"
  awk -v name="$1" '
    { for (i = 1; i <= 7; ++i) if ($i > most[i]) most[i] = $i; over = $1 - ($6 > $2 ? $6 : $2); if (over > worst) worst = over }
    END { printf "| %s | %d | %d | %d | %d | %d | %d | %d |\n", name, most[1], most[6], most[4], most[5], most[2], most[3], most[7]
          exit worst > 0 }' "$work/readings" || failed=1
}

failed=
"$build/sigs-editor" --probe "$probe" "$work/project.json" >"$work/log" 2>&1 &
editor=$!
wait_for '"current":true'
first=$(resident)
echo "| MiB at most, with 3840x2160 | kept | limit | composited | decoded | shown beside | textures | resident |"
echo "|---|---|---|---|---|---|---|---|"
watch_memory
sleep 8
end_watch "at rest"
watch_memory
key space
sleep 30
key space
end_watch "playing"
read -r x y width height < <(box timeline/ruler)
watch_memory
xdotool mousemove "${x%.*}" "$((${y%.*} + 5))" mousedown 1
for step in $(seq 100); do
  xdotool mousemove $((${x%.*} + 10 + (step * 37 % 100) * (${width%.*} - 20) / 100)) "$((${y%.*} + 5))"
  sleep 0.15
done
xdotool mouseup 1
end_watch "scrubbing"
watch_memory
key Home
wait_for '"current":true'
read -r x y < <(middle viewport/waypoint/0/0)
xdotool mousemove "$x" "$y"
sleep 0.5
xdotool mousedown 1
for step in $(seq 100); do
  xdotool mousemove $((x + step)) $((y + step % 20))
  sleep 0.1
done
xdotool mouseup 1
end_watch "dragging"
watch_memory
click $(middle "tab/stages")
sleep 3
for step in $(seq 20); do key Right; sleep 0.4; done
end_watch "stages"
click $(middle "tab/footage")
sleep 3
echo
echo "Resident with the first frame: $first MiB; at the end: $(resident) MiB."
[ -z "$failed" ] || { echo "error: more was kept than the limit" >&2; exit 1; }
