#!/usr/bin/env bash
# What each stage of the footage's look costs: milliseconds that drawing and compositing take a frame, with the stage
# alone and with all of them, as medians over interleaved runs, and their ratio to a frame without any.
#   bench/look.sh [RUNS] [FRAMES]     default: 5 runs of frames 60-99 of the crossing project, an airliner of some 60 px
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-5}
frames=${2:-60-99}
sigs=${SIGS:-build/release/sigs}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

base="compositing.blur_px_per_m=0 appearance.point_spread_px=0"
tones="appearance.black=0.02 appearance.saturation=0.7"
haze="appearance.haze.visibility_m=8000"
motion="camera.exposure_s=0.01"
spread="appearance.point_spread_px=0.45"
sharpening="appearance.sharpening=1"
chroma="appearance.chroma_spread_px=1.2"
grain="appearance.grain.sd_dark=2 appearance.grain.sd_bright=3 appearance.grain.sd_chroma=2 appearance.grain.spread_px=0.8 appearance.grain.persistence=0.4"
cases=("none|" "tones|$tones" "haze|$haze" "motion|$motion" "spread|$spread" "sharpening|$sharpening"
  "chroma|$chroma" "grain|$grain" "all|$tones $haze $motion $spread $sharpening $chroma $grain" "paper_blur|compositing.blur_px_per_m=0.002")

for _ in $(seq "$runs"); do
  for one in "${cases[@]}"; do
    settings=()
    for setting in $base ${one#*|}; do settings+=(--set "$setting"); done
    "$sigs" export projects/crossing/crossing.json --out "$out" --force --frames "$frames" --jobs 1 "${settings[@]}" \
      --times --progress none 2>&1 >/dev/null |
      sed -nE "s|.*draw ([0-9.]+) ms, composite ([0-9.]+) ms.*|${one%%|*} \1 \2|p"
  done
done | awk '
  function median(list, count,   i, j, t, v) {
    split(list, v, " ")
    for (i = 1; i <= count; i++) for (j = i + 1; j <= count; j++) if (v[j] + 0 < v[i] + 0) { t = v[i]; v[i] = v[j]; v[j] = t }
    return count % 2 ? v[(count + 1) / 2] : (v[count / 2] + v[count / 2 + 1]) / 2
  }
  { if (!($1 in n)) order[++keys] = $1; n[$1]++; draw[$1] = draw[$1] " " $2; composite[$1] = composite[$1] " " $3; both[$1] = both[$1] " " ($2 + $3) }
  END {
    printf "%-12s %9s %13s %8s %6s\n", "stage", "draw ms", "composite ms", "both ms", "ratio"
    for (k = 1; k <= keys; k++) {
      name = order[k]
      m = median(both[name], n[name])
      if (k == 1) first = m
      printf "%-12s %9.2f %13.2f %8.2f %6.2f\n", name, median(draw[name], n[name]), median(composite[name], n[name]), m, m / first
    }
  }'
