#!/usr/bin/env bash
# From a fresh Debian 12 or Ubuntu 24.04 machine to tested: installs what is missing, builds everything and runs
# every test.
# Tests of real footage run where SIGS_TEST_DATA (default: ../shared/data) is there, and say SKIPPED where it is not.
#   scripts/test.sh          the release build
#   scripts/test.sh asan     with AddressSanitizer and UndefinedBehaviorSanitizer
set -euo pipefail
preset=${1:-release}
source "$(dirname "$0")/setup.sh"

sigs_install programs tests
sigs_build "$preset" -DSIGS_TESTS=ON -DSIGS_BENCH=ON
# Mesa's compiler keeps memory until the process ends; leaks of the engine are found in the tests of single modules.
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan.supp:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"
ctest --preset "$preset" --parallel "$(nproc)"
