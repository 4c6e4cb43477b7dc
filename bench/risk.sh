#!/usr/bin/env bash
# Risk ratio: time, memory and processor use of 10^5 encounters, straight and of an encounter model; shards merged
# against one run; importance sampling against plain sampling.
#   bench/risk.sh [BUILD] [MODEL] [COUNT]   default: build/release, the shared uncorrelated model where it is there, 100000
set -euo pipefail
cd "$(dirname "$0")/.."
sigs=${1:-build/release}/sigs
model=${2:-../shared/data/encounters/models/uncor_1200only_fwme_v1p2.txt}
count=${3:-100000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/sensor.json" <<'END'
{"sigs_sensor_model": 1, "detector": "made", "frame_rate_hz": 10, "declare": {"hits": 3, "window": 5},
 "field_of_view_deg": {"left": -60, "right": 60, "down": -30, "up": 30},
 "detection": {"range_m": [300, 600, 1000, 1500], "probability": [0.99, 0.9, 0.5, 0.02], "shift": {"below_horizon": -1}},
 "correlation": {"encounter_share": 0.3, "fading_share": 0.3, "time_s": 1},
 "errors": {"bearing_sd_deg": 0.1, "elevation_sd_deg": 0.1}}
END
timed() {  # NAME COMMAND...
  local name=$1
  shift
  /usr/bin/time -f "$name: %e s, %U s of processor, %M KB" "$@" >"$work/out.txt"
  head -1 "$work/out.txt"
}
timed "straight, $count" "$sigs" risk "$work/sensor.json" --count "$count" --alert-rate 2 --json "$work/one.json"
[ ! -e "$model" ] || timed "encounter model, $count" "$sigs" risk "$work/sensor.json" --count "$count" --alert-rate 2 --intruder "$model"
timed "plain sampling, $count" "$sigs" risk "$work/sensor.json" --count "$count" --alert-rate 2 --plain-sampling
for i in 1 2 3; do
  timed "shard $i of 3" "$sigs" risk "$work/sensor.json" --count "$count" --alert-rate 2 --shard $i/3 --json "$work/$i.json"
done
"$sigs" risk --merge "$work"/[123].json --json "$work/merged.json" >/dev/null
cmp "$work/one.json" "$work/merged.json" && echo "merged shards: the same bytes as one run"
