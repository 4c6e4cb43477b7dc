#!/usr/bin/env bash
# A waypoint dragged steadily over 4K footage in the editor's window: composites shown a second, the editor's processor
# milliseconds for each, milliseconds from one to the next (half of them, 90 and 99 of 100 come sooner), and from letting
# go to the image of the last place; with the whole frame in sight, and at 1:1. Then images a second while the clip is
# played (25 Hz, H.264), and the time from the program's start to the first image; images a second while the playhead is
# pulled over 400 frames of an all-intra clip, once from end to end at 100 moves a second, beside those that FFmpeg decodes
# of it, and how often a strip of the image changes on the screen meanwhile. Medians of interleaved runs of all builds. Needs Xvfb, xdotool and ffmpeg, no display.
#   bench/editor_drag.sh [--rounds N] [--size WIDTHxHEIGHT] [--seconds S] [BUILD...]   default: 3, 3840x2160, 4, build/release
# --images FOLDER leaves screenshots of both views, in the drag and after it, there. --first: all that runs here goes
# before other work of the machine (root), each thread by as much as the others; the rates are then those of a machine
# of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
rounds=3 seconds=4 size=3840x2160 images= first=
while [ $# -gt 0 ]; do
  case $1 in
    --rounds) rounds=$2 ;;
    --seconds) seconds=$2 ;;
    --size) size=$2 ;;
    --images) images=$2 ;;
    --first) first=1; shift; continue ;;
    *) break ;;
  esac
  shift 2
done
builds=("${@:-build/release}")
width=${size%x*} height=${size#*x}
readonly kAhead=15  # of niceness
[ -z "$first" ] || renice -n -$kAhead -p $$ >/dev/null
source bench/editor_on_screen.sh

# The sample, enlarged to the width and cut to the height around its middle, and the lens of it.
source bench/scaled_sample.sh
ffmpeg -v error -i assets/footage/sample.mp4 -an -vf "scale=$width:-2,crop=$width:$height" -c:v libx264 \
  -preset ultrafast -crf 20 -pix_fmt yuv420p -g 25 "$work/clip.mp4"
scaled_lens "$width" "$height" >"$work/lens.xml"
cat >"$work/project.json" <<JSON
{"sigs": 1, "name": "dragged", "footage": {"video": "clip.mp4", "calibration": "lens.xml"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0},
 "intruders": [{"name": "one", "model": {"file": "$PWD/assets/models/light-aircraft/light-aircraft.obj",
  "forward": "+x", "up": "+z"}, "trajectory": {"waypoints": [{"frame": 0, "position_m": [90, -10, -155]},
  {"frame": 100, "position_m": [200, 0, -165]}, {"frame": 199, "position_m": [330, 20, -160]}]}}]}
JSON

ffmpeg -v error -stream_loop 1 -i "$work/clip.mp4" -an -c:v libx264 -preset ultrafast -crf 20 -g 1 -frames:v 400 "$work/intra.mp4"
sed 's/clip\.mp4/intra.mp4/' "$work/project.json" >"$work/intra.json"

now_ms() { echo $(($(date +%s%N) / 1000000)); }
processor_ms() { awk -v hz="$(getconf CLK_TCK)" '{ printf "%d", ($14 + $15) * 1000 / hz }' "/proc/$editor/stat"; }
screenshot() { [ -z "$images" ] || { mkdir -p "$images"; import -window root "$images/$1.png"; }; }

# Round and round, 100 moves a second, in one program: starting one for each move would take a core.
moves() { # X Y
  awk -v x="$1" -v y="$2" -v count=$((100 * seconds)) 'BEGIN { for (i = 1; i <= count; ++i)
    printf "mousemove %d %d sleep 0.01 ", x + 60 * sin(i / 25) + 0.5, y + 40 * (1 - cos(i / 25)) + 0.5 }'
}

# Milliseconds until the probe tells that no button is down and the image is the wanted one, by the file time of that
# probe: the reader is not quicker than its own sleep.
settled_ms() { # SINCE_MS REVISION
  local line
  for _ in $(seq 2000); do
    read -r line <"$probe" || true
    if [[ $line == *'"buttons":0,'* && $line == *'"current":true'* ]]; then
      echo $(($(stat -c %.3Y "$probe" | tr -d .) - $1))
      return
    fi
    sleep 0.004
  done
  echo "the image never came" >&2
  exit 1
}

# The editor's threads set their own niceness, from 5 up, once they are there.
go_first() {
  [ -n "$first" ] || return 0
  local task nice
  for task in /proc/"$editor"/task/*; do
    nice=$(awk '{ print $19 }' "$task/stat") || continue
    [ "$nice" -le 0 ] || renice -n $((nice - kAhead)) -p "${task##*/}" >/dev/null || true
  done
}

# drag BUILD VIEW: appends "images/s processor_ms settled_ms" to the readings.
drag() {
  local x y images_before images_after start end work_before work_after released intervals
  read -r x y < <(middle viewport/waypoint/0/1)
  xdotool mousemove "$x" "$y"
  sleep 0.4
  xdotool mousedown 1
  sleep 0.2
  start=$(now_ms) images_before=$(value composites) work_before=$(processor_ms)
  xdotool $(moves "$x" "$y")
  end=$(now_ms) images_after=$(value composites) work_after=$(processor_ms)
  intervals=$(grep -oE '"interval_ms":\[[^]]*\]' "$probe" | cut -d: -f2 | tr -c '0-9.\n' ' ')
  screenshot "$2-dragged"
  # From the middle of a move on: the last place is one that no image shows yet.
  xdotool mousemove $((x + 9)) $((y + 9))
  released=$(now_ms)
  xdotool mouseup 1
  echo "$((images_after - images_before)) $((end - start)) $((work_after - work_before)) $(settled_ms "$released") $intervals" |
    awk '{ printf "%.1f %.1f %d %d %d %d\n", 1000 * $1 / $2, $3 / ($1 > 0 ? $1 : 1), $4, $5, $6, $7 }' | tee -a "$work/$(tr / _ <<<"$1").$2" |
    sed "s|^|$1 $2 |" >&2
  sleep 1
  screenshot "$2-settled"
}

# How often the picture of a strip of the screen changes, until watched() asks: by a second program, so that images that the
# editor made and did not show do not count.
watch() { # X Y
  ffmpeg -v error -f x11grab -draw_mouse 0 -framerate 100 -video_size 160x16 -i "$DISPLAY+$1,$2" -t 60 -fps_mode passthrough \
    -f framemd5 - 2>/dev/null >"$work/strip" &
  watcher=$!
}
watched() { # sets seen
  kill "$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || true
  seen=$(awk '!/^#/ && length($NF) == 32 { changes += $NF != last; last = $NF } END { print (changes > 0 ? changes - 1 : 0) }' "$work/strip")
}

# scrub BUILD: appends the images shown a second, from the first move to the last one's image, and those on the screen.
scrub() {
  local x y width images_before start image_x image_y ms images
  rm -f "$probe"
  "$1/sigs-editor" --probe "$probe" "$work/intra.json" >"$work/log" 2>&1 &
  editor=$!
  wait_for '"current":true'
  go_first
  sleep 3
  read -r x y width _ < <(box timeline/ruler | awk '{ print int($1) + 2, int($2 + $4 / 2), int($3) - 4 }')
  xdotool mousemove "$x" "$y"
  sleep 0.3
  xdotool mousedown 1
  sleep 0.5
  # Where nothing is drawn over the image.
  read -r image_x image_y < <(box viewport/image | awk '{ print int($1 + $3 / 10), int($2 + 0.8 * $4) }')
  watch "$image_x" "$image_y"
  start=$(now_ms) images_before=$(value composites)
  xdotool $(awk -v x="$x" -v y="$y" -v width="$width" 'BEGIN { for (i = 1; i <= 400; ++i)
    printf "mousemove %d %d sleep 0.01 ", x + width * i / 400, y }')
  xdotool mouseup 1
  wait_for '"current":true'
  ms=$(($(now_ms) - start)) images=$(($(value composites) - images_before))
  watched
  awk -v images="$images" -v ms="$ms" -v seen="$seen" 'BEGIN { printf "%.1f %.1f\n", 1000 * images / ms, 1000 * seen / ms }' |
    tee -a "$work/$(tr / _ <<<"$1").scrubbed" | sed "s|^|$1 scrubbed, images/s, of them on the screen: |" >&2
  kill "$editor"
  wait "$editor" 2>/dev/null || true
}

run() { # BUILD
  local x y line= begun images_before
  rm -f "$probe"
  begun=$(now_ms)
  "$1/sigs-editor" --probe "$probe" "$work/project.json" >"$work/log" 2>&1 &
  editor=$!
  until [[ $line == *'"current":true'* ]]; do
    read -r line 2>/dev/null <"$probe" || true
    sleep 0.004
  done
  echo "$(($(stat -c %.3Y "$probe" | tr -d .) - begun))" | tee -a "$work/$(tr / _ <<<"$1").first" | sed "s|^|$1 first image, ms: |" >&2
  go_first
  key Home
  key Down
  wait_for '"frame":100'
  wait_for '"current":true'
  sleep 2
  drag "$1" whole
  read -r x y < <(middle viewport/waypoint/0/1)
  xdotool mousemove "$x" "$y"
  sleep 0.3
  key 1
  sleep 1
  drag "$1" 1to1
  key 0
  key Home
  sleep 1
  images_before=$(value composites) start=$(now_ms)
  key space
  sleep "$seconds"
  awk -v images="$(($(value composites) - images_before))" -v ms="$(($(now_ms) - start))" 'BEGIN { printf "%.1f\n", 1000 * images / ms }' |
    tee -a "$work/$(tr / _ <<<"$1").played" | sed "s|^|$1 played, images/s: |" >&2
  kill "$editor"
  wait "$editor" 2>/dev/null || true
  scrub "$1"
}

for _ in $(seq "$rounds"); do
  for build in "${builds[@]}"; do run "$build"; done
done

# median COLUMN FILE
median() { awk -v c="$1" '{ print $c }' "$2" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
echo "| $size, $rounds rounds | view | composites a second | processor ms for each | ms from one to the next: median | 90 % | 99 % | ms from release to the image |"
echo "|---|---|---|---|---|---|---|---|"
for build in "${builds[@]}"; do
  for view in whole 1to1; do
    file=$work/$(tr / _ <<<"$build").$view
    echo "| $build | $view | $(median 1 "$file") | $(median 2 "$file") | $(median 4 "$file") | $(median 5 "$file") | $(median 6 "$file") | $(median 3 "$file") |"
  done
  file=$work/$(tr / _ <<<"$build")
  echo "| $build | played | $(median 1 "$file.played") | | | | | first image after $(median 1 "$file.first") ms |"
  echo "| $build | scrubbed | $(median 1 "$file.scrubbed") | | | | | on the screen: $(median 2 "$file.scrubbed") |"
done
decoded=$({ TIMEFORMAT=%R; time ffmpeg -v error -i "$work/intra.mp4" -f null - ; } 2>&1)
echo "FFmpeg decodes $(awk -v s="$decoded" 'BEGIN { printf "%.1f", 400 / s }') images of the all-intra clip a second"
