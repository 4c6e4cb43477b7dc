#!/usr/bin/env bash
# What near intruders cost a frame by each compositing.quality, in turn: medians over runs of the processor time of all
# threads, and shares of that of `exact`.
#   bench/near.sh [--write] RUNS BUILD [WORD]...     WORDs: of bench_near's cases, those with all of them
# --write puts the table into docs/speed.md.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
[ $# -ge 2 ] || { sed -n 2,5p "$0" >&2; exit 64; }
runs=$1 build=$2
shift 2
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

for _ in $(seq "$runs"); do
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
    print "| aircraft | size | light | look | share of the image, % | `exact`: processor ms | `auto` | share | `draft` | share |"
    print "|---|---|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= rows; r++) {
      name = order[r]
      printf "| %s | %s | %.1f", name, share[name], median(name "exact")
      for (q = 1; q <= split("auto draft", qualities, " "); q++)
        printf " | %.1f | **%.2f**", median(name qualities[q]), median(name qualities[q]) / median(name "exact")
      print " |"
    }
  }' "$lot/times" | tee "$lot/table"
[ -z "$write" ] || bench/fill.sh docs/speed.md near "$lot/table"
