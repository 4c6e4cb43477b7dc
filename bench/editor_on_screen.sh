# The editor on a virtual display, driven by mouse and keys. Sourced: makes the folder $work with the editor's settings,
# sets $probe, and starts the display; what runs as $editor ends, and $work goes, with the script. Needs Xvfb and xdotool.
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

# value KEY: a number in the editor's probe; box NAME: x y width height of a place on the screen; middle NAME: its middle.
value() { grep -oE "\"$1\":[0-9.]+" "$probe" | cut -d: -f2; }
box() { grep -oE "\"$1\":\[[^]]*\]" "$probe" | cut -d: -f2 | tr -c '0-9.\n' ' '; }
middle() { box "$1" | awk '{ print int($1 + $3 / 2), int($2 + $4 / 2) }'; }
wait_for() { for _ in $(seq 600); do grep -qE "$1" "$probe" 2>/dev/null && return; sleep 0.1; done; echo "waited in vain for $1" >&2; exit 1; }
click() { xdotool mousemove "$1" "$2"; sleep 0.3; xdotool mousedown 1; sleep 0.15; xdotool mouseup 1; sleep 0.3; }
key() { xdotool keydown "$1"; sleep 0.1; xdotool keyup "$1"; sleep 0.1; }
