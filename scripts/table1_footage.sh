#!/usr/bin/env bash
# Renders the footage of the paper's Table 1 in its full length, which projects/table1/full.json reads from
# build/table1-footage: scripts/table1_footage.sh [--short] FOLDER [BUILD FOLDER [FRAMES]]
#   --short  190 frames each: the clips that are kept in assets/footage
#   FRAMES   only the first so many of each, to try it out
# An existing clip is unchanged. Takes about a second a frame on two cores, and some minutes before
# the first.
set -euo pipefail
short=no
if [ "${1:-}" = --short ]; then
  short=yes
  shift
fi
if [ $# -lt 1 ] || [ $# -gt 3 ]; then
  echo "usage: scripts/table1_footage.sh [--short] FOLDER [BUILD FOLDER [FRAMES]]" >&2
  exit 64
fi
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
build=${2:-build/release}
frames=${3:-0}
cmake --build "$build" --target generate_sample >/dev/null

# An unfinished clip never has a clip's name.
work=$(mktemp -d "$folder/.unfinished.XXXXXX")
trap 'rm -rf "$work"' EXIT

clip() {  # NAME LENGTH
  local name=$1 length=$2 range=()
  [ $short = yes ] && length=190
  [ "$frames" -gt 0 ] && range=(0 $((frames < length ? frames - 1 : length - 1)))
  if [ -e "$folder/$name.mp4" ]; then
    echo "$folder/$name.mp4 is there already"
    return
  fi
  "$build"/generate_sample --clip "$name" --length "$length" --attitudes "$work/$name.csv" \
    assets/calibrations/sample.xml "$work/mask.png" "${range[@]}" |
    ffmpeg -v error -y -f rawvideo -pix_fmt yuv420p -s 1280x960 -r 25 -i - -c:v libx264 -preset medium -crf 20 -bf 2 -g 50 \
      -pix_fmt yuv420p -color_range tv -colorspace bt709 -color_primaries bt709 -color_trc bt709 \
      -chroma_sample_location left -movflags +faststart -fflags +bitexact -flags:v +bitexact "$work/$name.mp4"
  if [ "$name" = table1_vibration ]; then mv "$work/$name.csv" "$folder/${name}_attitude.csv"; fi
  mv "$work/$name.mp4" "$folder/$name.mp4"
  echo "$folder/$name.mp4"
}

clip table1_clouds 636
clip table1_clear 1143
clip table1_vibration 1033
