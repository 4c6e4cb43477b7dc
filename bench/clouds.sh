#!/usr/bin/env bash
# Opacity of the clouds in nine real frames against clouds painted by hand (clouds/painted.json), and by how much it
# flickers at one place over 30 frames of a camera that stands still. Needs python3 with numpy and PIL; a minute.
#   bench/clouds.sh [BUILD] [DATA]     default: build/release, ../shared/data
set -euo pipefail
cd "$(dirname "$0")/.."
sigs=$(realpath "${1:-build/release}/sigs")
data=$(realpath "${2:-../shared/data}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# clouds CLIP FRAME PNG
clouds() {
  local project="$work/$(basename "$1").json"
  [ -e "$project" ] || "$sigs" init "$data/$1" --out "$project" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  "$sigs" frame "$project" --frame "$2" --stages --force --out "$work/stages" --set footage.cloud_distance_m=0 >/dev/null
  mv "$work"/stages/*_clouds.png "$3"
  rm -rf "$work/stages"
}

number=0
/usr/bin/python3 -c 'import json, sys
for frame in json.load(open(sys.argv[1]))["frames"]: print(frame["clip"], frame["frame"])' bench/clouds/painted.json |
  while read -r clip frame; do
    clouds "$clip" "$frame" "$work/$number.png" </dev/null
    number=$((number + 1))
  done
/usr/bin/python3 bench/clouds/score.py bench/clouds/painted.json "$work"

mkdir "$work/still"
for frame in {100..129}; do clouds track/V_AIRPLANE_010.mp4 "$frame" "$work/still/$frame.png"; done
/usr/bin/python3 bench/clouds/flicker.py "$work/still"
