#!/usr/bin/env bash
# How many clips of thermal cameras `sigs init` takes for thermal, and how many clips by light that were made gray, at 1280x1024 and
# at 640x512. Needs ffmpeg; takes a minute or two.
#   bench/spectrum.sh [BUILD] [DATA]     default: build/release, ../shared/data
set -euo pipefail
cd "$(dirname "$0")/.."
sigs=${1:-build/release}/sigs
data=${2:-../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints "1" where the clip becomes a thermal project, else "0".
is_thermal() {
  "$sigs" init "$1" --force --out "$work/p.json" >/dev/null 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
  if grep -q "footage.spectrum: thermal" "$work/log"; then echo 1; else echo 0; fi
}

for clip in "$data"/thermal/IR_*.mp4; do is_thermal "$clip"; done |
  awk '{ n += $1 } END { printf "thermal clips taken for thermal: %d of %d\n", n, NR }'
for size in 1280:1024 640:512; do
  for clip in "$data"/track/V_{AIRPLANE_{001,016,030,044,055},HELICOPTER_{004,019,030,045,058}}.mp4; do
    [ -e "$clip" ] || continue
    ffmpeg -v error -y -i "$clip" -frames:v 60 -vf scale=$size -pix_fmt gray -c:v ffv1 "$work/gray.mkv" </dev/null
    is_thermal "$work/gray.mkv"
  done | awk -v size=$size '{ n += $1 } END { printf "gray clips by light of %s taken for thermal: %d of %d\n", size, n, NR }'
done

for palette in inferno magma plasma turbo; do
  for clip in "$data"/thermal/IR_{AIRPLANE_{004,012,020,028},HELICOPTER_{004,012,020}}.mp4; do
    [ -e "$clip" ] || continue
    ffmpeg -v error -y -i "$clip" -frames:v 60 -vf "format=gray,format=gbrp,pseudocolor=preset=$palette,format=yuv420p" -crf 23 "$work/colored.mp4" </dev/null
    is_thermal "$work/colored.mp4" >/dev/null
    grep -c "footage.palette: $palette:" "$work/log" || true
  done | awk -v palette=$palette '{ n += $1 } END { printf "thermal clips in %s of which the palette is found: %d of %d\n", palette, n, NR }'
done
for clip in "$data"/track/V_*[05].mp4; do
  is_thermal "$clip" >/dev/null
  grep -c "footage.palette:" "$work/log" || true
done | awk '{ n += $1 } END { printf "clips by light taken for coloured heat: %d of %d\n", n, NR }'
