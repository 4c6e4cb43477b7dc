#!/usr/bin/env bash
# What one frame costs: wall-clock time, processor time and resident memory at most of commands that work on a single frame.
#   bench/start.sh [--write] [RUNS] [BUILD] [OTHER_BUILD]     default: 7 runs of build/release
# --write puts the table into docs/speed.md.
# Medians of interleaved runs, for each sample project; with OTHER_BUILD both builds in turn and the ratios of the first
# to the second. A run before them, not counted, fills the driver's cache of shaders.
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
table=$(mktemp)
trap 'rm -f "$table"' EXIT
python3 - "$@" <<'PYTHON' | tee "$table"
import os, statistics, subprocess, sys, tempfile, time

runs = int(sys.argv[1]) if len(sys.argv) > 1 else 7
builds = sys.argv[2:4] or ["build/release"]
projects = ["crossing", "head-on", "two-intruders", "liveries"]


def commands(project, folder):
    file = f"projects/{project}/{project}.json"
    return {
        "frame": ["frame", file, "--frame", "150", "--out", folder, "--force"],
        "export": ["export", file, "--frames", "0-0", "--out", folder, "--force", "--progress", "none"],
        "check": ["check", file],
    }


def measured(command):
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = status
    if status != 0:
        sys.exit(f"error: {' '.join(command)} failed")
    return time.monotonic() - began, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


with tempfile.TemporaryDirectory() as folder:
    found = {}
    for turn in range(-1, runs):
        for project in projects:
            for name, arguments in commands(project, folder).items():
                for build in builds:
                    result = measured([f"{build}/sigs", *arguments])
                    if turn >= 0:
                        found.setdefault((project, name, build), []).append(result)

titles = [f"{what}{'' if i == 0 else ', other'}" for i in range(len(builds)) for what in ["s", "processor s", "MB"]]
print(f"| project | command | {' | '.join(titles)} |" + (" ratio of s | processor s | MB |" if len(builds) > 1 else ""))
print("|---" * (2 + len(titles) + (3 if len(builds) > 1 else 0)) + "|")
for project in projects:
    for name in ["frame", "export", "check"]:
        medians = [[statistics.median(column) for column in zip(*found[project, name, build])] for build in builds]
        cells = [f"{s:.2f} | {work:.2f} | {memory:.0f}" for s, work, memory in medians]
        if len(builds) > 1:
            cells.append(" | ".join(f"**{a / b:.2f}**" for a, b in zip(*medians)))
        print(f"| {project} | {name} | {' | '.join(cells)} |")
PYTHON

if [ -n "$write" ]; then
  bench/fill.sh docs/speed.md start "$table"
fi
