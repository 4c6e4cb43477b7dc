#!/usr/bin/env bash
# From a fresh Debian 12 or Ubuntu 24.04 machine to an exported encounter: installs what the programs need, builds the
# two of them and nothing else, exports a sample project and prints the paths of the results. Needs no display.
set -euo pipefail
source "$(dirname "$0")/setup.sh"

sigs_install programs
sigs_build release -DSIGS_TESTS=OFF -DSIGS_BENCH=OFF -- sigs sigs-editor

out=out/demo
build/release/sigs export projects/head-on/head-on.json --out "$out" --force --times
build/release/sigs export projects/head-on/head-on.json --out "$out" --force --codec h264 --masks none --labels none
build/release/sigs frame projects/head-on/head-on.json --frame 150 --out "$out" --force >/dev/null

cat <<END

Done. In $PWD/$out:
  head-on.mkv        the encounter, lossless (FFV1)
  head-on.mp4        the same, for any player (H.264)
  head-on.masks.mkv  where the intruder is, and how opaque
  head-on.xml        the truth: position, distance, attitude, boxes of every frame
  frame_150.png      one frame to look at
END
