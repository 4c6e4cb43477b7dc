#!/usr/bin/env bash
# Seconds of `sigs dataset` for images for detectors: sampled frames of 40 clips with aircraft of four models in them.
#   bench/images.sh [IMAGES] [RUNS] [BUILD] [FOLDER]
# default: 1000 images, medians of 3 runs of build/release, clips ../shared/data/track. The clips' boxes of real aircraft
# (CLIP_gt.csv), where there are some, are avoided. Lenses are not known: 24 degrees are taken.
set -euo pipefail
cd "$(dirname "$0")/.."
images=${1:-1000}
runs=${2:-3}
sigs=$PWD/${3:-build/release}/sigs
folder=$(realpath "${4:-../shared/data/track}")
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

cat >"$lot/camera.xml" <<'XML'
<?xml version="1.0"?>
<opencv_storage>
<image_width>640</image_width><image_height>512</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt><data>1500 0 319.5 0 1500 255.5 0 0 1</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>5</rows><cols>1</cols><dt>d</dt><data>0 0 0 0 0</data></distortion_coefficients>
</opencv_storage>
XML

recipe() { # PLACEMENT
  local clip name comma='' boxes clips=0
  echo '{"sigs_dataset": 1, "name": "images", "seed": 3, "backgrounds": ['
  for clip in "$folder"/*.mp4; do
    ((clips++ < 40)) || break
    name=$(basename "$clip" .mp4)
    boxes=''
    [ ! -e "${clip%.mp4}_gt.csv" ] || boxes=", \"real_aircraft\": \"${clip%.mp4}_gt.csv\""
    echo "$comma{\"name\": \"$name\", \"footage\": {\"video\": \"$clip\", \"calibration\": \"$lot/camera.xml\"$boxes},"
    echo '"camera": {"position_m": [0, 0, -5000]}, "light": {"kind": "sun", "sun": {"azimuth_deg": 120, "elevation_deg": 40}}}'
    comma=,
  done
  echo '], "aircraft": ['
  comma=''
  for name in airliner:airplane light-aircraft:airplane helicopter:helicopter quadcopter:drone; do
    echo "$comma{\"name\": \"${name%:*}\", \"category\": \"${name#*:}\","
    echo "\"model\": {\"file\": \"$PWD/assets/models/${name%:*}/${name%:*}.obj\"}}"
    comma=,
  done
  echo "], \"videos\": [{\"images\": $images, \"placement\": \"$1\", \"per_image\": {\"choice\": [0, 1, 1, 2]},"
  echo '"camera": {"attitude_deg.pitch": {"uniform": [5, 50]}}}],'
  echo '"splits": {"train": 0.8, "val": 0.2, "keep_together": "background"}}'
}

TIMEFORMAT='%R %U %S'
for placement in anywhere sky; do
  recipe "$placement" >"$lot/$placement.json"
  for ((run = 0; run < runs; ++run)); do
    rm -rf "$lot/out"
    { time "$sigs" dataset "$lot/$placement.json" --out "$lot/out" --progress none >/dev/null 2>"$lot/said" ||
      { cat "$lot/said" >&2; exit 1; }; } 2>>"$lot/times.$placement"
  done
  sort -n "$lot/times.$placement" | awk -v placement="$placement" -v images="$images" '{ wall[NR] = $1; cpu[NR] = $2 + $3 }
    END { m = int((NR + 1) / 2); printf "%s: %d images in %.1f s, %.1f images/s, %.1f s of processor (median of %d)\n", placement, images, wall[m], images / wall[m], cpu[m], NR }'
done
"$sigs" dataset "$lot/sky.json" --out "$lot/out" --coverage
