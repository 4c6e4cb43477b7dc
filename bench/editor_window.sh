#!/usr/bin/env bash
# Updates a second of the editor's window while the mouse moves over it: at rest, playing, and while an export
# runs in the background. Medians of one reading a second, and the lowest. Needs Xvfb and xdotool, no display.
#   bench/editor_window.sh [PROJECT] [BUILD]     default: projects/head-on/head-on.json build/release
set -euo pipefail
cd "$(dirname "$0")/.."
project=${1:-projects/head-on/head-on.json}
build=${2:-build/release}
source bench/editor_on_screen.sh


# readings NAME SECONDS
readings() {
  local i
  for i in $(seq "$2"); do
    for step in $(seq 20); do xdotool mousemove $((300 + 20 * step)) $((300 + 3 * step)); sleep 0.04; done
    value turns_a_second
  done | sort -n | awk -v name="$1" '{ v[NR] = $1 } END { printf "%-12s median %5.1f, lowest %5.1f turns a second\n", name, v[int((NR + 1) / 2)], v[1] }'
}

"$build/sigs-editor" --probe "$probe" "$project" >"$work/log" 2>&1 &
editor=$!
wait_for '"current":true'
sleep 3
readings "at rest" 6
key space
sleep 1
readings "playing" 8
key space
xdotool keydown ctrl; key e; xdotool keyup ctrl
wait_for '"export/folder"'
click $(middle "export/folder")
xdotool key ctrl+a; sleep 0.3; xdotool type --delay 80 "$work/out"; sleep 0.5; key Return
click $(middle "export/go")
wait_for '"export/(cancel|hide)"'
sleep 1.5
readings "exporting" 5
