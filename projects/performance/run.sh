#!/usr/bin/env bash
# From a recipe to the performance of a sensor and its risk ratio: dataset, a plain detector, report, risk, and the check
# of the sensor model against the images. Needs a build (scripts/setup.sh, cmake) and python3-opencv.
#   projects/performance/run.sh [FOLDER [VIDEOS]]   FOLDER: out/performance; VIDEOS: only the first so many of 200
#   NETWORK=1 trains a small network as well and lets it look at the first 40 videos (python3-torch; some 20 minutes)
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:-out/performance}
sigs=${SIGS:-build/release/sigs}
python=${PYTHON:-python3}
here=projects/performance
recipe=$here/performance.json
mkdir -p "$out"
if [ $# -gt 1 ]; then
  recipe=$here/.some.json
  sed "s/\"videos\": 200/\"videos\": $2/" $here/performance.json >$recipe
  trap 'rm -f $here/.some.json' EXIT
fi

"$sigs" dataset $recipe --out "$out/dataset" --resume
"$sigs" dataset "$out/dataset" --data-sheet --force
"$python" $here/detect.py "$out"/dataset/*/*.mp4 assets/footage/sample.mp4 assets/footage/table1_clear.mp4 \
  assets/footage/table1_clouds.mp4 --out "$out/plain" --keep
evaluate=("$sigs" evaluate performance "$out/dataset" --results "$out/plain" --empty assets/footage/sample.mp4
  assets/footage/table1_clear.mp4 assets/footage/table1_clouds.mp4 --own-speed 22 --force)
"${evaluate[@]}" --out "$out/report" >/dev/null
"$sigs" risk "$out/report/sensor.json" --own-speed 22 --climb-rate 8 --alert-rate 2 --until 0.05 --force \
  --json "$out/risk.json" >/dev/null
"$sigs" risk "$out/report/sensor.json" --labels "$out/dataset" --results "$out/plain" --climb-rate 8 --count 20000 \
  --force --json "$out/loop.json" >"$out/loop.txt"
"$sigs" dataset "$out/dataset" --domain $here/domain.json --force --json "$out/coverage.json" >/dev/null
"${evaluate[@]}" --out "$out/report" --risk "$out/risk.json" --coverage "$out/coverage.json"
cat "$out/loop.txt"

[ "${NETWORK:-}" = 1 ] || exit 0
example=python/examples/train_detector.py
"$sigs" dataset $here/images.json --out "$out/images" --resume
[ -e "$out/network.pt" ] || "$python" $example train "$out/images/labels/coco/all.json" --images "$out/images" \
  --out "$out/network.pt" --steps 1500
labels=() found=() plain=()
for labels_file in $(ls "$out"/dataset/encounter-*/*.xml | head -40); do
  name=$(basename "$labels_file" .xml)
  labels+=("$labels_file")
  found+=("$out/network/$name.csv")
  plain+=("$out/plain/$name.csv")
done
[ -e "${found[-1]}" ] || "$python" $example watch "${labels[@]/%.xml/.mp4}" --weights "$out/network.pt" --out "$out/network" --score 0.5
for results in found plain; do
  declare -n files=$results
  "$sigs" evaluate performance "${labels[@]}" --results "${files[@]}" --calibration assets/calibrations/sample.xml \
    --own-speed 22 --force --out "$out/report-$results"
done
