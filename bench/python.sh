#!/usr/bin/env bash
# Frames a second through the Python module against `sigs export` (ffv1, no masks) of the same project, which also
# encodes and writes: ratios of medians of interleaved runs.
#   bench/python.sh [RUNS] [BUILD] [PROJECT]     default: 5 runs of build/release, projects/crossing
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-5}
build=$PWD/${2:-build/release}
project=${3:-projects/crossing/crossing.json}
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

RUNS=$runs LOT=$lot PYTHONPATH=$build/python /usr/bin/python3 - "$build/sigs" "$project" <<'PYTHON'
import os
import statistics
import subprocess
import sys
import time

import sigs

program, path = sys.argv[1:]
project = sigs.open(path)
numbers = project.frame_range


def export():
    command = [program, "export", path, "--out", os.environ["LOT"], "--force", "--codec", "ffv1", "--masks", "none"]
    subprocess.run([*command, "--progress", "none"], check=True, stdout=subprocess.DEVNULL)


def frames():
    for frame in project.frames():
        frame.planes


def frames_rgb():
    for frame in project.frames():
        frame.rgb, frame.truth


def render():
    for n in numbers:
        project.render(n).planes


def render_posed():
    middle = numbers[len(numbers) // 2]
    truth = project.render(middle).truth
    pose = [a + b for a, b in zip(truth.camera.position_m, truth.intruders[0].position_m)]
    for k, n in enumerate(numbers):
        project.render(middle, poses={0: ([pose[0], pose[1] + 0.01 * k, pose[2]], (0, 0, 90))}).planes


def waypoints():
    frames, positions_m = project.intruders[0].waypoints
    middle = numbers[len(numbers) // 2]
    for k, n in enumerate(numbers):
        project.intruders[0].waypoints = sigs.Waypoints(frames, positions_m + [0, 0.01 * k, 0])
        project.render(middle).planes
    project.intruders[0].waypoints = sigs.Waypoints(frames, positions_m)


ways = {
    "`sigs export`, FFV1 without masks": export,
    "`frames()`, planes": frames,
    "`frames()`, RGB and truth": frames_rgb,
    "`render(n)`, n rising": render,
    "`render`, one frame, another pose each time": render_posed,
    "`render`, one frame, other waypoints each time": waypoints,
}
seconds = {name: [] for name in ways}
for _ in range(int(os.environ["RUNS"])):
    for name, way in ways.items():
        start = time.perf_counter()
        way()
        seconds[name].append(time.perf_counter() - start)
medians = {name: statistics.median(all) for name, all in seconds.items()}
print("| | ms a frame | frames/s by those of `sigs export` |\n|---|---|---|")
for name, median in medians.items():
    print(f"| {name} | {1e3 * median / len(numbers):.1f} | {medians['`sigs export`, FFV1 without masks'] / median:.2f} |")
PYTHON
