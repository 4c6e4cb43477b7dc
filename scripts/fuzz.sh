#!/usr/bin/env bash
# Fuzzes the readers of all files that come from outside (tests/fuzz/README.md): builds them with clang, libFuzzer,
# AddressSanitizer and UndefinedBehaviorSanitizer in build/fuzz, and runs each target for SECONDS.
#   scripts/fuzz.sh                    every target for 20 s
#   scripts/fuzz.sh 600 model video    these for 10 minutes each
# FUZZ_JOBS targets run at a time (default: one for each processor). Inputs that were worth keeping stay in
# build/fuzz/corpus for the next run, logs lie in build/fuzz/logs. Exit status 1: something was found; it lies in
# build/fuzz/finds and can be tried again by build/fuzz/fuzz_TARGET FILE.
set -euo pipefail
source "$(dirname "$0")/setup.sh"

seconds=${1:-20}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "error: $seconds is no number of seconds" >&2; exit 64; }
shift || true
all=(project calibration model image text_log binary_log results truth recipe recorded_path encounter encounter_model sensor_model video)
targets=("${@:-${all[@]}}")
for target in "${targets[@]}"; do
  [[ " ${all[*]} " == *" $target "* ]] || { echo "error: $target: no such target; there are ${all[*]}" >&2; exit 64; }
done

sigs_install programs fuzz
build=$PWD/build/fuzz
[ -e "$build/CMakeCache.txt" ] || cmake -G Ninja -S . -B "$build" -DSIGS_FUZZ=ON -DSIGS_UNITY=ON -DSIGS_EDITOR=OFF \
  -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
  -DCMAKE_COMPILE_WARNING_AS_ERROR="${SIGS_WERROR:-OFF}" >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target "${targets[@]/#/fuzz_}"
mkdir -p "$build"/{logs,finds}
python3 tests/fuzz/seeds.py "$build/seeds" ../shared/data

SIGS_FUZZ_FOLDER=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")/sigs-fuzz-XXXXXX")
export SIGS_FUZZ_FOLDER
trap 'rm -rf "$SIGS_FUZZ_FOLDER"' EXIT

# An input of 64 KiB that takes 10 s, 1.25 GiB in one piece (the largest image has 1 GiB) or 2 GiB together is a find.
fuzz() {
  local target=$1 log=$build/logs/$1.log
  mkdir -p "$build/corpus/$target" "$build/seeds/$target"
  local options=(-max_total_time="$seconds" -max_len=65536 -timeout=10 -malloc_limit_mb=1280 -rss_limit_mb=2048
    -print_final_stats=1 -artifact_prefix="$build/finds/$target-")
  [ ! -e "tests/fuzz/dictionaries/$target.dict" ] || options+=(-dict="tests/fuzz/dictionaries/$target.dict")
  local TIMEFORMAT='%U %S' status=0 cpu
  cpu=$({ time "$build/fuzz_$target" "${options[@]}" "$build/corpus/$target" "$build/seeds/$target" \
    "tests/fuzz/cases/$target" >"$log" 2>&1; } 2>&1) || status=$?
  awk -v target="$target" -v cpu="$cpu" -v status="$status" '
    / cov: / { for (i = 1; i < NF; ++i) if ($i == "cov:") coverage = $(i + 1) }
    /stat::number_of_executed_units/ { executions = $2 }
    END { split(cpu, t, " ")
          printf "%-16s %9d executions  %5d edges  %4.0f s of processor time  %s\n", target, executions, coverage, t[1] + t[2],
                 status == 0 ? "nothing found" : "FOUND something" }' "$log"
  [ "$status" -eq 0 ] || grep -m 3 -E "^SUMMARY|broken promise|runtime error|Test unit written" "$log" || true
  return "$status"
}

jobs=${FUZZ_JOBS:-$(nproc)}
found=0
for target in "${targets[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || found=1; done
  fuzz "$target" &
done
while [ "$(jobs -p | wc -l)" -gt 0 ]; do wait -n || found=1; done
exit "$found"
