#!/usr/bin/env bash
# Intervals of loss of well clear against brute force: 10,000 random pairs of flights, every 2 ms.
#   bench/encounter.sh [PAIRS] [BUILD]     default: 10000 build/release; less than a minute
set -euo pipefail
cd "$(dirname "$0")/.."
"${2:-build/release}/bench_encounter" "${1:-10000}"
