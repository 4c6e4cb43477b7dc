#!/usr/bin/env bash
# Encounter models: speed of drawing, a million first and further seconds of each model; and the agreement of as many draws with the exact
# marginals, by the unit test.
#   bench/encounter_model.sh [BUILD] [FOLDER]     default: build/release, ../shared/data/encounters/models; some 20 s
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
folder=${2:-../shared/data/encounters/models}
"$build/bench_encounter_model" 1000000 "$folder"/*_v*.txt
"$build/test_encounter_model" --test-case="*million*,*read without the engine*" --no-version
