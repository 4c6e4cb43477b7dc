#!/usr/bin/env bash
# Which lines of the engine the tests reach, counted by GCC: prints them by module, writes every file's lines to
# build/coverage/report/index.html, and fails where a test fails or less than 90 % of the engine's lines are reached.
# The window and its tests are left out, and tests that only read the source tree, start installed programs, or take from
# programs what they need to write their counts: descriptors, disk, time.
set -euo pipefail
source "$(dirname "$0")/setup.sh"

sigs_install programs tests coverage
sigs_build coverage
find build/coverage -name '*.gcda' -delete
status=0
left_out='^(docs|install|layering|python|slurm|faults|cli_adverse|cli_files): |: dataset_kill$'
# What the counting says is not the program's: tests look at its stderr.
GCOV_ERROR_FILE=$PWD/build/coverage/gcov.log ctest --preset coverage --parallel "$(nproc)" --exclude-regex "$left_out" || status=$?

report=build/coverage/report
mkdir -p "$report"
# Lines are skipped whose counts contradict each other, since threads may count at the same time.
gcovr --root . --filter engine/ build/coverage/engine --gcov-ignore-parse-errors -j "$(nproc)" --json-summary "$report/summary.json" \
  --html-details "$report/index.html" >"$report/gcovr.log" 2>&1
python3 - "$report/summary.json" <<'END' || status=1
import collections, json, sys
total, reached = collections.Counter(), collections.Counter()
for file in json.load(open(sys.argv[1]))["files"]:
    for name in (file["filename"].split("/")[1], "the engine"):
        total[name] += file["line_total"]
        reached[name] += file["line_covered"]
for name in sorted(total, key=lambda name: (name == "the engine", name)):
    print(f"{name:20} {reached[name]:6} of {total[name]:6} lines  {100 * reached[name] / total[name]:5.1f} %")
sys.exit(reached["the engine"] < 0.9 * total["the engine"])
END
exit "$status"
