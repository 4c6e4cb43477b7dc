#!/usr/bin/env bash
# Accuracy of sigs calibrate with boards: synthetic boards through known lenses, beside OpenCV's own calibration of the
# same views.
#   bench/calibrate.sh [FIRST_SEED LAST_SEED [CASE [BUILD]]]   default: 11 13, all cases, build/release
# Seeds 1 to 3 are those that rules and limits were fitted with; 11 to 13 are held out. Some 10 s of processor time for
# each case and seed. A table in Markdown on stdout.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${4:-build/release}
case=()
[ -n "${3:-}" ] && [ "${3:-}" != all ] && case=("$3")
"$build/bench_calibrate" "${1:-11}" "${2:-13}" "${case[@]}" | awk -F, '
  NR == 1 { print "| case | seed | views found, used | model | focal length, % | its sd, % | principal point, px | held-out views, px | OpenCV: focal length, % | principal point, px | held-out views, px |"
            print "|---|---|---|---|---|---|---|---|---|---|---|"; next }
  NF < 10 { print "| " $0 " |"; next }
  { printf "| %s | %s | %s, %s | %s | **%.3f** | %.3f | %.2f | **%.3f** | %s | %s | %s |\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12 }'
