#!/usr/bin/env bash
# Intervals of loss of well clear against brute force: 10,000 random pairs of flights, every 2 ms.
#   bench/encounter.sh [PAIRS] [BUILD]     default: 10000 build/release; less than a minute
# Processor time of an export with the truth of encounters for all volumes, against one without: interleaved runs of
# 40 frames of the sample footage, h264, no masks, labels xml and csv, with medians and the median of the runs'
# differences; then what is added, measured alone, for all 200 frames.
#   bench/encounter.sh export [RUNS] [BUILD]     default: 15 build/release; some minutes
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" != export ]; then
  exec "${2:-build/release}/bench_encounter" "${1:-10000}"
fi
runs=${2:-15}
build=$PWD/${3:-build/release}
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT
TIMEFORMAT='%U %S'

# Seconds of the processor, user and system.
spent() { # VOLUMES
  local times
  times=$({ time "$build/sigs" export projects/head-on/head-on.json --out "$lot/out" --force --codec h264 --masks none \
    --labels xml,csv --frames 0-39 --jobs 1 --progress none --set "export.encounter=$1" >/dev/null 2>"$lot/said"; } 2>&1) ||
    { cat "$lot/said" >&2; exit 1; }
  awk '{ print $1 + $2 }' <<<"$times"
}

all='["dwc-en-route","dwc-non-cooperative","dwc-terminal","small-uas","nmac"]'
spent '[]' >/dev/null
for ((run = 0; run < runs; run++)); do
  if ((run % 2)); then # which one comes first changes, so that neither always follows the other's warm caches
    with=$(spent "$all")
    without=$(spent '[]')
  else
    without=$(spent '[]')
    with=$(spent "$all")
  fi
  echo "$without $with"
done >"$lot/times"
median() { sort -n | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }
without=$(awk '{ print $1 }' "$lot/times" | median)
with=$(awk '{ print $2 }' "$lot/times" | median)
more=$(awk '{ print 100 * ($2 - $1) / $1 }' "$lot/times" | median)
awk -v a="$without" -v b="$with" -v m="$more" -v n="$runs" 'BEGIN {
  printf "processor time, medians of %d: %.3f s without encounter, %.3f s with; difference in pairs %+.2f %%\n", n, a, b, m }'
"$build/bench_encounter_export" projects/head-on/head-on.json "$lot"
