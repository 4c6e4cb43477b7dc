#!/usr/bin/env bash
# The paper's application example (section 5.2, figures 19 to 22): OpenCV's trackers on two videos of Table 1, one calm and
# one with vibration.
#   bench/tracker_evaluation.sh [--write] [BUILD]     default: build/release; some minutes on two processors
#   --write   puts tables and plots into docs/
# The videos, reports (report.html) and plots are left in BUILD/tracker-evaluation.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
[ "${1:-}" = --write ] && write=1 && shift
build=${1:-build/release}
folder=$build/tracker-evaluation
videos=(1LRB737 3LRB737)
trackers=csrt,kcf,mil,mosse,medianflow,tld,boosting
mkdir -p "$folder"

"$build/sigs" dataset projects/table1/table1.json --only "$(IFS=,; echo "${videos[*]}")" --out "$folder/videos" --resume
for video in "${videos[@]}"; do
  echo "== $video"
  "$build/sigs" evaluate track "$folder/videos/$video/$video.xml" --tracker "$trackers" --out "$folder/$video" --force
done

# table VIDEO: the summary, as the page shows it.
table() {
  awk -F, -f bench/tracker_evaluation.awk "$folder/$1/summary.csv"
}
for video in "${videos[@]}"; do table "$video" >"$folder/$video.md"; done
if [ -n "$write" ]; then
  for video in "${videos[@]}"; do
    bench/fill.sh docs/tracker-evaluation.md "$video" "$folder/$video.md"
    for plot in center_error x_error y_error precision success; do
      cp "$folder/$video/$plot.svg" "docs/pictures/trackers-$video-${plot//_/-}.svg"
    done
  done
fi
