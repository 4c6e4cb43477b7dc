#!/usr/bin/env bash
# What near intruders cost a frame, by another build and by each compositing.quality of this one, in turn: medians over
# runs of the processor time of all threads, and shares of that of the other build.
#   bench/near.sh [--write] RUNS BUILD OTHER_BUILD [WORD]...     WORDs: of bench_near's cases, those with all of them
# --write puts the table into docs/speed.md.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
[ $# -ge 3 ] || { sed -n 2,5p "$0" >&2; exit 64; }
runs=$1 build=$2 other=$3
shift 3
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

for _ in $(seq "$runs"); do
  "$other/bench_near" --rounds 1 "$@" | sed "s/^/other /"
  for quality in exact auto draft; do
    "$build/bench_near" --rounds 1 --set "compositing.quality=$quality" "$@" | sed "s/^/$quality /"
  done
done >"$lot/times"

awk "$(cat bench/median.awk)"'
  {
    name = $2 " | " $3 " | " $4 " | " $5
    if (!(name in share)) order[++rows] = name
    share[name] = $6
    values[name $1] = values[name $1] " " $10
  }
  END {
    print "| aircraft | size | light | look | share of the image, % | before: processor ms | `exact` | share | `auto` | share | `draft` | share |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= rows; r++) {
      name = order[r]
      printf "| %s | %s | %.1f", name, share[name], median(name "other")
      for (q = 1; q <= split("exact auto draft", qualities, " "); q++)
        printf " | %.1f | **%.2f**", median(name qualities[q]), median(name qualities[q]) / median(name "other")
      print " |"
    }
  }' "$lot/times" | tee "$lot/table"
[ -z "$write" ] || bench/fill.sh docs/speed.md near "$lot/table"
