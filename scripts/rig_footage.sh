#!/usr/bin/env bash
# Renders the footage of projects/rig beside the front camera's: scripts/rig_footage.sh FOLDER [BUILD FOLDER]
# The aircraft is that of table1_vibration.mp4 (assets/footage/SOURCE.md); the mounts, rates and starts are those of the
# project. Takes some ten minutes on two cores.
set -euo pipefail
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  echo "usage: scripts/rig_footage.sh FOLDER [BUILD FOLDER]" >&2
  exit 64
fi
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
build=${2:-build/release}
cmake --build "$build" --target generate_sample >/dev/null

# An unfinished clip never has a clip's name.
work=$(mktemp -d "$folder/.unfinished.XXXXXX")
trap 'rm -rf "$work"' EXIT

camera() { # NAME SIZE RATE OPTIONS...
  "$build"/generate_sample --clip table1_vibration "${@:4}" "assets/calibrations/$1.yaml" "$work/mask.png" |
    ffmpeg -v error -y -f rawvideo -pix_fmt yuv420p -s "$2" -r "$3" -i - -c:v libx264 -preset medium -crf 18 -g 50 \
      -pix_fmt yuv420p -color_range tv -colorspace bt709 -color_primaries bt709 -color_trc bt709 \
      -chroma_sample_location left -movflags +faststart -fflags +bitexact -flags:v +bitexact "$work/$1.mp4"
  mv "$work/$1.mp4" "$folder/$1.mp4"
  echo "$folder/$1.mp4"
}

camera rig_left 960x720 30 --mount 0,0,-60 --rate 30 --start 0.37
camera rig_narrow 1024x768 25 --mount 0,-2,0 --start 1.2
