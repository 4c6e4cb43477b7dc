#!/usr/bin/env bash
# How well a lens is found without a board (docs/calibrating-without-a-board.md): tracks made in closed form, by lens and
# motion; then what is found in clips.
#   bench/autocalibration.sh [BUILD] [CLIP]...     default: build/release, no clips; some minutes
#   SEEDS="1 3"                                      first and last seed of the made tracks; 11 to 13 are held out
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
shift || true
read -r first last <<< "${SEEDS:-11 13}"
"$build/bench_autocalibration" made "$first" "$last"
[ $# -eq 0 ] || "$build/bench_autocalibration" clips "$@"
