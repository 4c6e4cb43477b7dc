#!/usr/bin/env bash
# Milliseconds a frame spends at each stage of an export, as medians over interleaved runs.
#   bench/stages.sh [RUNS] [FRAMES]     default: 5 runs of frames 0-99, all sample projects and methods
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-5}
frames=${2:-0-99}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

for _ in $(seq "$runs"); do
  for project in crossing head-on two-intruders; do
    for method in direct classic plain; do
      build/release/sigs export "projects/$project/$project.json" --out "$out" --force --frames "$frames" \
        --method "$method" --times --progress none 2>&1 >/dev/null |
        sed -nE "s|.*, ([0-9.]+) frames/s; per frame: decode ([0-9.]+) ms, draw ([0-9.]+) ms, composite ([0-9.]+) ms, encode ([0-9.]+) ms.*|$project $method \1 \2 \3 \4 \5|p"
    done
  done
done | sort -k1,1 -k2,2 | awk '
  function median(list, count,   i, j, t, v) {
    split(list, v, " ")
    for (i = 1; i <= count; i++) for (j = i + 1; j <= count; j++) if (v[j] + 0 < v[i] + 0) { t = v[i]; v[i] = v[j]; v[j] = t }
    return count % 2 ? v[(count + 1) / 2] : (v[count / 2] + v[count / 2 + 1]) / 2
  }
  { key = $1 " " $2; n[key]++; for (c = 3; c <= 7; c++) values[key, c] = values[key, c] " " $c; if (!(key in seen)) { seen[key] = 1; order[++keys] = key } }
  END {
    printf "%-14s %-8s %9s %10s %9s %13s %10s\n", "project", "method", "frames/s", "decode ms", "draw ms", "composite ms", "encode ms"
    for (k = 1; k <= keys; k++) {
      split(order[k], name, " ")
      printf "%-14s %-8s %9.1f %10.2f %9.2f %13.2f %10.2f\n", name[1], name[2], median(values[order[k], 3], n[order[k]]),
        median(values[order[k], 4], n[order[k]]), median(values[order[k], 5], n[order[k]]), median(values[order[k], 6], n[order[k]]), median(values[order[k], 7], n[order[k]])
    }
  }'
