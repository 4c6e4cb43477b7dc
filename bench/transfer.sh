#!/usr/bin/env bash
# Whether detectors trained on inserted aircraft find real ones: bench/transfer/README.md. Takes some 75 minutes of two cores.
#   bench/transfer.sh [FOLDER] [BUILD] [CLIPS]
#   bench/transfer.sh /tmp/transfer-thermal build/release ../shared/data/thermal
# default: /tmp/transfer (what is there is kept), build/release, ../shared/data/track. Needs python3-torch, python3-numpy
# and python3-pil.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-/tmp/transfer}
sigs=$PWD/${2:-build/release}/sigs
clips=$(realpath "${3:-../shared/data/track}")
transfer() { nice /usr/bin/python3 bench/transfer/transfer.py "$@"; }
export -f transfer
transfer make "$folder" "$sigs" "$clips"
transfer list "$folder" | tr '\t' '\n' | xargs -d '\n' -n 2 -P 2 bash -c 'transfer train "$0" "$1" "$2"' "$folder"
transfer report "$folder"
