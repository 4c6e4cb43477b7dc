#!/usr/bin/env bash
# The tests of faults (docs/reliability.md) with each fault tried so often for each command.
#   bench/kills.sh [TRIES] [BUILD] [TEST...]    default: 10, build/release, kill; tests are the files of tests/faults
#                                               without _test.cpp, and `editor`: kills while it saves
# Prints what each test counted. Ends with 1 where anything was lost, half-written or left behind.
set -euo pipefail
cd "$(dirname "$0")/.."
export SIGS_TEST_FAULTS=${1:-10}
build=${2:-build/release}
shift $(($# < 2 ? $# : 2))
failed=
for test in "${@:-kill}"; do
  echo "$test:"
  program=$build/test_faults file="*/faults/${test}_test.cpp"
  [ "$test" != editor ] || program=$build/test_editor_ui_test file='*/ui_test/faults_test.cpp'
  "$program" --source-file="$file" | grep -E 'MESSAGE|ERROR|logged|SKIPPED|test cases' || failed=1
  [ "${PIPESTATUS[0]}" -eq 0 ] || failed=1
done
[ -z "$failed" ]
