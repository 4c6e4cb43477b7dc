#!/usr/bin/env bash
# Accuracy and speed of the detection of the own body: both methods on every synthetic flight, agreement by run time, real clips.
#   bench/own_body.sh [--write] [quick|draw] [BUILD]     default: build/release; some fifteen minutes on two processors
#   --write   puts tables, plot and images into docs/
#   quick     few small frames: only shows that it runs; writes nothing into docs/
#   draw      measures nothing: tables and plot of the last run
# Tables (CSV), images and the masks drawn over the clips are left in BUILD/own-body.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
[ "${1:-}" = --write ] && write=1 && shift
mode=whole
case "${1:-}" in quick | draw) mode=$1 && shift ;; esac
build=${1:-build/release}
folder=$build/own-body
[ "$mode" = quick ] && folder=$build/own-body-quick
mkdir -p "$folder"
source bench/own_body/tables.sh

if [ "$mode" != draw ]; then
  effort=()
  [ "$mode" = quick ] && effort=(quick)
  for what in flights limits real time early images reliability; do
    echo "measuring: $what"
    "$build/bench_own_body" "$what" "$folder" "${effort[@]}"
  done
fi

tables=(flights limits time early real by_frames machine reliability)
for table in "${tables[@]}"; do "table_$table" >"$folder/$table.md"; done
"$build/bench_plots" own_body "$folder" "$folder/time.png"
echo "tables, plot and images: $folder"
broken=
awk -F, -f bench/own_body/claims.awk "$folder"/{flights,limits,real,time,early,reliability}.csv || broken=1

if [ -n "$write" ] && [ "$mode" != quick ]; then
  for table in flights limits time early real machine reliability; do bench/fill.sh docs/research/own-body.md "$table" "$folder/$table.md"; done
  bench/fill.sh docs/research/accuracy.md own_body "$folder/by_frames.md"
  cp "$folder/time.png" docs/images/own-body-time.png
  for image in flights stages-paper stages-stable; do
    cp "$folder/$image.jpg" "docs/images/own-body-$image.jpg"
  done
  # Without the real clips the page keeps its image of their masks.
  if [ -e "$folder/real-masks.png" ]; then cp "$folder/real-masks.png" docs/images/own-body-real-masks.png; fi
fi
if [ -n "$broken" ] && [ "$mode" != quick ]; then
  echo "error: docs/research/own-body.md says what the figures do not" >&2
  exit 1
fi
