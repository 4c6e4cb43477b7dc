#!/usr/bin/env bash
# From a fresh Debian 12 or Ubuntu 24.04 machine to tested: installs what is missing, builds everything and runs
# every test.
# Tests of real footage run where SIGS_TEST_DATA (default: ../shared/data) is there, and say SKIPPED where it is not.
#   scripts/test.sh          the release build
#   scripts/test.sh asan     with AddressSanitizer and UndefinedBehaviorSanitizer
#   scripts/test.sh tsan     with ThreadSanitizer: the modules that start threads, and the preview
set -euo pipefail
preset=${1:-release}
source "$(dirname "$0")/setup.sh"

sigs_install programs tests
if [ "$preset" = tsan ]; then
  areas=(base video occlusion ego_motion frame export evaluation dataset editor_preview editor_own_body_job
    editor_ego_motion_job editor_first_project_job editor_scoring)
  sigs_build tsan -DSIGS_TESTS=ON -- "${areas[@]/#/test_}"
  # Libraries of others are not instrumented: what happens between their own threads cannot be seen. With
  # LP_NUM_THREADS=0 Mesa draws on the thread that asks for it; OpenCV's loops do so too (base/threads.cpp).
  export LP_NUM_THREADS=0 TSAN_OPTIONS="ignore_noninstrumented_modules=1${TSAN_OPTIONS:+:$TSAN_OPTIONS}"
  # Ten minutes and more each, with the threads of other tests.
  too_slow='^(occlusion: paper|frame: look_truth)$'
  exec ctest --preset tsan --parallel "$(nproc)" --tests-regex "^($(IFS='|'; echo "${areas[*]}")): " --exclude-regex "$too_slow"
fi
sigs_build "$preset" -DSIGS_TESTS=ON -DSIGS_BENCH=ON
# Mesa's compiler keeps memory until the process ends; leaks of the engine are found in the tests of single modules.
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan.supp:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"
ctest --preset "$preset" --parallel "$(nproc)"
