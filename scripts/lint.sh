#!/usr/bin/env bash
# Refuses what clang warns of, in every source, and what the checks of .clang-tidy find in the engine and the programs.
#   scripts/lint.sh            everything
#   scripts/lint.sh export     only targets in whose folder or name "export" is found
# Several sources are read at a time (SIGS_UNITY), so that the headers of OpenCV are read once for all of them. What
# only the fuzzers need is compiled with the same warnings by scripts/fuzz.sh.
set -euo pipefail
pattern=${1:-.}
source "$(dirname "$0")/setup.sh"

sigs_install programs tests lint
cmake --preset lint >/dev/null
cmake --build --preset lint --parallel "$(nproc)" --target sigs_precompiled_fast sigs_precompiled_light \
  sigs_precompiled_test engine/render/generated/render/shaders.h >/dev/null

# check FOLDERS COMMAND...: calls the command with each source of these folders, then fails where one of the calls failed.
check() {
  sed -n "s#^ *\"file\": \"$PWD/\(.*\)\",*\$#\1#p" build/lint/compile_commands.json | grep -v /sigs_precompiled |
    grep -E "^(build/lint/)?($1)/" | { grep -E -e "$pattern" || true; } |
    xargs -r -P "$(nproc)" -n 1 "${@:2}" -p build/lint 2>&1 |
    { grep --line-buffered -vE '^[0-9]+ warnings? (generated|treated as errors?)' || true; }
}

failed=no
check 'engine|cli|editor|python' clang-tidy-14 --quiet || failed=yes
# The checks would take three times as long as reading these.
check 'tests|bench|assets' clang-check-14 --extra-arg=-Werror || failed=yes
[ $failed = no ] || { echo "lint.sh: see above; .clang-tidy has the list of checks" >&2; exit 1; }
