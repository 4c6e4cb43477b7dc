#!/usr/bin/env bash
# The paper's application example (section 5.2, figures 19 to 22): OpenCV's trackers on two videos of Table 1, one calm and
# one with vibration, and on the second once more with an intruder that does not shake with its background.
#   bench/tracker_evaluation.sh [--write] [BUILD]     default: build/release; some minutes on two processors
#   --write   puts tables and plots into docs/
# The videos, reports (report.html) and plots are left in BUILD/tracker-evaluation.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
[ "${1:-}" = --write ] && write=1 && shift
build=${1:-build/release}
folder=$build/tracker-evaluation
calm=1LRB737
shaken=3LRB737
mkdir -p "$folder"

"$build/sigs" dataset projects/table1/table1.json --only "$calm,$shaken" --out "$folder/videos" --resume >/dev/null
# evaluate NAME PROJECT_OR_LABELS [options]
evaluate() {
  local name=$1
  shift
  echo "== $name"
  "$build/sigs" evaluate track "$@" --tracker all --out "$folder/$name" --force | sed '/^\//d; /^'"${folder//\//\\/}"'/d'
  awk -F, -f bench/tracker_evaluation.awk "$folder/$name/summary.csv" >"$folder/$name.md"
}
for video in "$calm" "$shaken"; do evaluate "$video" "$folder/videos/$video/$video.xml"; done
"$build/sigs" export "$folder/videos/$shaken/$shaken.json" --set camera.attitude_file= --out "$folder/still" --force >/dev/null
evaluate "$shaken-still" "$folder/still/$shaken.xml"
awk -F, -f bench/tracker_jitter.awk "$folder"/{"$calm","$shaken","$shaken-still"}/frames.csv >"$folder/jitter.md"
echo "reports: $folder/*/report.html"

if [ -n "$write" ]; then
  for table in "$calm" "$shaken" "$shaken-still" jitter; do
    bench/fill.sh docs/tracker-evaluation.md "$table" "$folder/$table.md"
  done
  for video in "$calm" "$shaken"; do
    for plot in center_error x_error y_error; do
      cp "$folder/$video/$plot.png" "docs/images/trackers-$video-${plot//_/-}.png"
    done
  done
fi
