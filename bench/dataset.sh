#!/usr/bin/env bash
# Frames a second of `sigs dataset`, and its time against the sum of `sigs export` runs of the same projects.
#   bench/dataset.sh [RUNS] [BUILD] [PART] [RECIPE]
# default: 3 interleaved runs of build/release on part 1/5 of projects/table1/table1.json; PART all: every video.
# Medians. The dataset command also checks its inputs, makes checksums and waits for the disk; single exports do not.
#   bench/dataset.sh coverage [BUILD]    runs bench/dataset_coverage.sh: time to plan, coverage against labels
#   bench/dataset.sh shared videos|images SIGS_BEFORE ...    runs bench/dataset_shared.sh: what sharing saves
set -euo pipefail
cd "$(dirname "$0")/.."
[ "${1:-}" != coverage ] || exec bench/dataset_coverage.sh "${2:-build/release}"
[ "${1:-}" != shared ] || exec bench/dataset_shared.sh "${@:2}"
runs=${1:-3}
sigs=$PWD/${2:-build/release}/sigs
part=${3:-1/5}
recipe=${4:-projects/table1/table1.json}
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT
shard=()
[ "$part" = all ] || shard=(--shard "$part")

dataset() { # OUT OPTIONS...
  local out=$1
  shift
  "$sigs" dataset "$recipe" --out "$out" "${shard[@]}" --progress none "$@" >/dev/null 2>"$lot/said" ||
    { cat "$lot/said" >&2; exit 1; }
}

# Its projects are exported one by one; their paths are relative to that folder.
dataset "$lot/first"
frames=$(grep -ho '"frames": [0-9]*' "$lot"/first/*/entry.json | awk '{ sum += $2 } END { print sum }')
single() {
  local entry name
  for entry in "$lot"/first/*/entry.json; do
    name=$(basename "$(dirname "$entry")")
    "$sigs" export "$lot/first/$name/$name.json" --out "$lot/single" --progress none >/dev/null 2>"$lot/said" ||
      { cat "$lot/said" >&2; exit 1; }
  done
}

TIMEFORMAT='%R %U %S'
timed() { # KEY COMMAND...
  local key=$1 times
  shift
  rm -rf "$lot/out" "$lot/single"
  times=$({ time "$@" 2>/dev/null; } 2>&1) || { cat "$lot/said" >&2; exit 1; }
  echo "$key $times" >>"$lot/times"
}

for _ in $(seq "$runs"); do
  timed single single
  timed jobs-1 dataset "$lot/out" --jobs 1
  timed jobs-2 dataset "$lot/out" --jobs 2
  timed kept dataset "$lot/first" --resume
done

awk -v frames="$frames" -v cores="$(nproc)" "$(cat bench/median.awk)"'
  { values[$1 " wall"] = values[$1 " wall"] " " $2; values[$1 " work"] = values[$1 " work"] " " ($3 + $4) }
  END {
    printf "%d frames, %d cores\n\n", frames, cores
    print "| run | s | frames/s | against single exports | processor s |"
    print "|---|---|---|---|---|"
    name["single"] = "`sigs export`, one after the other"
    name["jobs-1"] = "`sigs dataset --jobs 1`"
    name["jobs-2"] = "`sigs dataset --jobs 2`"
    name["kept"] = "`sigs dataset --resume`, all kept"
    count = split("single jobs-1 jobs-2 kept", order, " ")
    for (i = 1; i <= count; i++) {
      key = order[i]; wall = median(key " wall")
      printf "| %s | %.2f | %.1f | %.2f | %.2f |\n", name[key], wall, frames / wall, wall / median("single wall"), median(key " work")
    }
  }' "$lot/times"
