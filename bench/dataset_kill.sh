#!/usr/bin/env bash
# A dataset that is killed again and again (SIGKILL) and resumed, against one made in a single run.
#   bench/dataset_kill.sh [BUILD] [KILLS] [RECIPE]     default: build/release, 10, projects/table1/table1.json
# The times are random, with a fixed seed, over the duration of the single run. Ends with 1 where anything differs.
set -euo pipefail
cd "$(dirname "$0")/.."
sigs=$PWD/${1:-build/release}/sigs
kills=${2:-10}
recipe=${3:-projects/table1/table1.json}
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

make() { # OUT OPTIONS...
  local out=$1
  shift
  "$sigs" dataset "$recipe" --out "$out" --progress none "$@" >/dev/null 2>"$lot/said" || { cat "$lot/said" >&2; exit 1; }
}
checksum() { sha256sum "$lot/$1/SHA256SUMS" | cut -d' ' -f1; }
complete() { find "$lot/killed" -mindepth 2 -maxdepth 2 -name entry.json -not -path '*/.part/*' 2>/dev/null | wc -l; }

begin=$(date +%s.%N)
make "$lot/whole"
took=$(awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN { print b - a }')
videos=$(find "$lot/whole" -mindepth 2 -maxdepth 2 -name entry.json | wc -l)
echo "in one run: $videos videos, $(printf %.0f "$took") s, checksum $(checksum whole)"

RANDOM=1
killed=0
for _ in $(seq "$kills"); do
  wait_s=$(awk -v t="$took" -v n="$kills" -v r="$RANDOM" 'BEGIN { printf "%.3f", t / n * 2 * r / 32768 }')
  "$sigs" dataset "$recipe" --out "$lot/killed" --resume --progress none >/dev/null 2>"$lot/said" &
  run=$!
  sleep "$wait_s"
  if ! kill -KILL "$run" 2>/dev/null; then
    wait "$run" || { cat "$lot/said" >&2; exit 1; }
    echo "complete before it could be killed once more"
    break
  fi
  status=0
  wait "$run" 2>/dev/null || status=$?
  [ "$status" -eq 137 ] || { cat "$lot/said" >&2; exit 1; }
  killed=$((killed + 1))
  echo "kill $killed after $wait_s s: $(complete) of $videos videos complete"
done
make "$lot/killed" --resume
echo "killed $killed times and resumed: checksum $(checksum killed)"

(cd "$lot/killed" && sha256sum --check --strict --quiet SHA256SUMS)
diff -r "$lot/whole" "$lot/killed" || exit 1
echo "identical: every file of the two folders"
