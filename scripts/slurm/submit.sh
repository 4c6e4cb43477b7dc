#!/usr/bin/env bash
# Makes a dataset on a Slurm cluster: an array job, one shard a task, and after it a job that merges the index.
#   scripts/slurm/submit.sh RECIPE OUT SHARDS [options of sbatch ...]
# OUT must lie where all machines see it. SIGS names the program (default: build/release/sigs). Prints both jobs' numbers:
# "ARRAY MERGE". Submitting the same again continues where it was stopped.
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: $0 RECIPE OUT SHARDS [options of sbatch ...]" >&2
  exit 64
fi
here=$(cd "$(dirname "$0")" && pwd)
recipe=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
shards=$3
shift 3
sigs=${SIGS:-$here/../../build/release/sigs}
if [ ! -x "$sigs" ]; then
  echo "error: $sigs: no such program; build it or say where it is: SIGS=/path/to/sigs" >&2
  exit 66
fi
sigs=$(realpath "$sigs")
case $shards in
  '' | *[!0-9]* | 0)
    echo "error: SHARDS is \"$shards\"; it must be a number from 1 on" >&2
    exit 64
    ;;
esac
# Errors of the plan are reported here, not in a hundred logs. 65: some of its videos are impossible; the others are made.
status=0
"$sigs" dataset "$recipe" --out "$out" --dry-run >/dev/null || status=$?
[ "$status" -eq 0 ] || [ "$status" -eq 65 ] || exit "$status"
mkdir -p "$out/logs"
array=$(sbatch --parsable --job-name=sigs-dataset --array="1-$shards" --output="$out/logs/shard_%a.log" "$@" \
  "$here/shard.sbatch" "$sigs" "$recipe" "$out")
# afterany: where a shard failed, the merge lists what is missing.
merge=$(sbatch --parsable --job-name=sigs-merge --dependency="afterany:${array%%;*}" --output="$out/logs/merge.log" "$@" \
  "$here/merge.sbatch" "$sigs" "$recipe" "$out")
echo "${array%%;*} ${merge%%;*}"
