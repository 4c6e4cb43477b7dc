#!/usr/bin/env bash
# What near intruders cost a frame, by two builds alternately: medians over runs, and the ratios of processor time.
#   bench/near.sh [--write] RUNS BUILD OTHER_BUILD [WORD]...     WORDs: of bench_near's cases, those with all of them
# --write puts the table into docs/speed.md.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
[ $# -ge 3 ] || { sed -n 2,4p "$0" >&2; exit 64; }
runs=$1
builds=("$2" "$3")
shift 3
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

for run in $(seq "$runs"); do
  for which in $((run % 2)) $(((run + 1) % 2)); do
    "${builds[$which]}/bench_near" --rounds 1 "$@" | sed "s/^/$which /"
  done
done >"$lot/times"

awk "$(cat bench/median.awk)"'
  {
    name = $2 " | " $3 " | " $4 " | " $5
    if (!(name in share)) order[++rows] = name
    share[name] = $6
    for (c = 7; c <= 10; c++) values[name $1 c] = values[name $1 c] " " $c
  }
  END {
    print "| aircraft | size | light | look | share of the image, % | draw ms | composite ms | both | processor ms | other build: draw ms | composite ms | both | processor ms | ratio |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= rows; r++) {
      name = order[r]
      printf "| %s | %s", name, share[name]
      for (which = 0; which < 2; which++) for (c = 7; c <= 10; c++) printf " | %.1f", median(name which c)
      printf " | **%.2f** |\n", median(name 1 10) / median(name 0 10)
    }
  }' "$lot/times" | tee "$lot/table"
[ -z "$write" ] || bench/fill.sh docs/speed.md near "$lot/table"
