#!/usr/bin/env bash
# Error against run time: measures everything, draws the plots and makes the tables of docs/research/accuracy.md.
#   bench/accuracy.sh [BUILD] [quick|draw]    default: build/release
#   quick   one repetition, coarse truth; page and plots go into the build folder, docs/ is unchanged
#   draw    measures nothing: plots and tables of the last whole run
# The tables lie in BUILD/accuracy as CSV files.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
mode=${2:-whole}
folder=$build/accuracy
page=docs/research/accuracy.md
images=docs/images
if [ "$mode" = quick ]; then
  folder=$build/accuracy-quick
  page=$folder/accuracy.md
  images=$folder
fi
mkdir -p "$folder"
source bench/accuracy/tables.sh

if [ "$mode" != draw ]; then
  effort=()
  [ "$mode" = quick ] && effort=(quick)
  for what in spline lens chroma frames; do
    echo "measuring: $what"
    "$build/bench_accuracy_$what" "$folder" "${effort[@]}"
  done
fi

for plot in frames sizes lens lens_table spline; do
  "$build/bench_plots" "$plot" "$folder" "$images/accuracy-${plot//_/-}.png"
done

with_tables docs/research/accuracy.md >"$folder/page.md"
mv "$folder/page.md" "$page"
if ! awk -F, -f bench/accuracy/claims.awk "$folder"/{machine,frames,chroma,sizes,tolerance,lens,lens_table,spline,condition}.csv &&
  [ "$mode" != quick ]; then
  echo "error: $page says what the figures do not" >&2
  exit 1
fi
echo "$page, $images/accuracy-*.png"
