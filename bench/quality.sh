#!/usr/bin/env bash
# What compositing.quality, supersampling and samples change against `exact`, and what they take: measures, draws the
# plot and puts the table into docs/accuracy.md.
#   bench/quality.sh [BUILD] [quick|draw] [WORD]...     default: build/release; half an hour on two processors
#   quick   one repetition, a coarse truth
#   draw    measures nothing: plot and table of the last run
#   WORDs   only the scenes whose names contain all of them: airliner, 400px, sun, ...
# The figures of each scene lie in BUILD/accuracy/quality.csv.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
mode=${2:-whole}
folder=$build/accuracy
mkdir -p "$folder"
if [ "$mode" != draw ]; then
  "$build/bench_accuracy_quality" "$folder" "$mode" "${@:3}"
fi
"$build/bench_plots" quality "$folder" docs/images/accuracy-quality.png

# The largest differences of all scenes of a size, and the median of their times.
awk -F, "$(cat bench/median.awk)"'
  FNR == 1 { next }
  {
    if ($5 == "all alike" && ($3 == 8 && $7 == 1 || $6 == 1 && $7 == 1)) next  # as exact at that size; as draft
    size = $3 > 1000 ? "filling" : $3 " px"
    way = $5 == "all alike" ? "supersampling " $6 ($7 > 1 ? ", " $7 " samples" : "") : "`" $5 "`"
    key = size " | " way
    if (!(key in count)) order[++rows] = key
    ++count[key]
    if ($8 + 0 > rmse[key] + 0) rmse[key] = $8
    if ($9 + 0 > largest[key] + 0) largest[key] = $9
    if ($10 + 0 > box[key] + 0) box[key] = $10
    if ($11 + 0 > centroid[key] + 0) centroid[key] = $11
    if ($2 ~ /airliner/ && $12 != "") values["truth " key] = values["truth " key] " " $12
    values["cpu " key] = values["cpu " key] " " $16
    values["ratio " key] = values["ratio " key] " " $17
  }
  END {
    print "| size | way | scenes | RMSE against `exact` | largest difference | box, px | centroid, px | RMSE against the truth, airliners | processor ms | of `exact` |"
    print "|---|---|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= rows; r++) {
      k = order[r]
      printf "| %s | %d | %.2f | %d | %.3f | %.4f | %s | %.1f | %.2f |\n", k, count[k], rmse[k], largest[k], box[k], centroid[k], \
        values["truth " k] == "" ? "" : sprintf("%.2f", median("truth " k)), median("cpu " k), median("ratio " k)
    }
  }' "$folder/quality.csv" >"$folder/quality.md"
bench/fill.sh docs/accuracy.md quality "$folder/quality.md"
echo "docs/accuracy.md, docs/images/accuracy-quality.png"
