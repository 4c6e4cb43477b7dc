#!/bin/bash
# SPDX-License-Identifier: MIT
# first_projects.sh OUT VIDEO...: makes a first project of each video (`sigs init`), exports it, and puts the middle
# frame of each into OUT/sheet.png, with the intruder's surroundings four times as large below it. Needs ffmpeg.
#   SIGS  the program; default build/release/sigs
set -euo pipefail
sigs=$(realpath "${SIGS:-build/release/sigs}")
out=$1
shift
mkdir -p "$out"
n=0
for video in "$@"; do
  name=$(printf '%02d' $n)-$(basename "${video%.*}")
  video=$(realpath "$video")
  project=$out/$name/$name.json
  "$sigs" init "$video" --out "$project" --force >/dev/null 2>"$out/$name.log"
  "$sigs" check "$project" 2>>"$out/$name.log" | tail -2 | sed "s/^/$name: /"
  first=$(grep -o '"first_frame": *[0-9]*' "$project" | grep -o '[0-9]*$')
  range=$("$sigs" check "$project" 2>/dev/null | grep -o 'frames [0-9]* to [0-9]*' | tail -1)
  last=${range##* }
  middle=$(((first + last) / 2))
  "$sigs" export "$project" --out "$out/$name/out" --codec h264 --frames "$middle" --force --progress none \
    2>>"$out/$name.log" >/dev/null
  result=$(find "$out/$name/out" -name '*.mp4' ! -name '*mask*' -o -name '*.mkv' ! -name '*mask*' | sort | head -1)
  xml=$(find "$out/$name/out" -name '*.xml' | head -1)
  box=$(grep -o '<box[^>]*>' "$xml" | head -1)
  x=$(sed 's/.* x="\([-0-9]*\).*/\1/' <<<"$box")
  y=$(sed 's/.* y="\([-0-9]*\).*/\1/' <<<"$box")
  ffmpeg -v error -y -i "$result" -frames:v 1 -filter_complex \
    "[0]split[a][b];[a]scale=400:300:force_original_aspect_ratio=decrease,pad=400:300:-1:-1[c];[b]crop=min(iw\,120):min(ih\,75):max(0\,${x:-0}-40):max(0\,${y:-0}-30),scale=400:250:flags=neighbor[d];[c][d]vstack" \
    "$out/sheet-$name.png" </dev/null || echo "$name: no image"
  n=$((n + 1))
done
ffmpeg -v error -y -pattern_type glob -i "$out/sheet-*.png" -filter_complex "tile=4x$(((n + 3) / 4))" -frames:v 1 \
  "$out/sheet.png" </dev/null
echo "$out/sheet.png"
