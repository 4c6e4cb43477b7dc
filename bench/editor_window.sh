#!/usr/bin/env bash
# Updates a second of the editor's window while the mouse moves over it: at rest, playing, and while an export
# runs in the background. Medians of one reading a second, and the lowest. Needs Xvfb and xdotool, no display.
#   bench/editor_window.sh [PROJECT] [BUILD]     default: projects/head-on/head-on.json build/release
set -euo pipefail
cd "$(dirname "$0")/.."
project=${1:-projects/head-on/head-on.json}
build=${2:-build/release}
work=$(mktemp -d)
probe=$work/probe.json
cleanup() {
  kill "${editor:-}" "${screen:-}" 2>/dev/null || true
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap cleanup EXIT

Xvfb -displayfd 3 -screen 0 1600x960x24 -nolisten tcp 3>"$work/display" 2>/dev/null &
screen=$!
until [ -s "$work/display" ]; do sleep 0.1; done
export DISPLAY=":$(cat "$work/display")" XDG_CONFIG_HOME="$work/config" XDG_STATE_HOME="$work/state"

# value KEY: a number in the editor's probe; place NAME: the middle of a place on the screen.
value() { grep -oE "\"$1\":[0-9.]+" "$probe" | cut -d: -f2; }
place() { grep -oE "\"$1\":\[[^]]*\]" "$probe" | tr -c '0-9.\n' ' ' | awk '{n = NF; print int($(n-3) + $(n-1) / 2), int($(n-2) + $n / 2)}'; }
wait_for() { for _ in $(seq 300); do grep -qE "$1" "$probe" 2>/dev/null && return; sleep 0.1; done; echo "waited in vain for $1" >&2; exit 1; }
click() { xdotool mousemove "$1" "$2"; sleep 0.3; xdotool mousedown 1; sleep 0.15; xdotool mouseup 1; sleep 0.3; }
key() { xdotool keydown "$1"; sleep 0.15; xdotool keyup "$1"; sleep 0.3; }

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
click $(place "export/folder")
xdotool key ctrl+a; sleep 0.3; xdotool type --delay 80 "$work/out"; sleep 0.5; key Return
click $(place "export/go")
wait_for '"export/(cancel|hide)"'
sleep 1.5
readings "exporting" 5
