#!/usr/bin/env bash
# How an export's time and memory grow with frames and with intruders, on a looped clip of 320x240.
#   bench/growth.sh [--write] [BUILD] [FRAMES...]     default: build/release, 500 5000 50000 frames
# --write puts the tables into docs/speed.md. Memory is the maximum resident size (VmHWM).
set -euo pipefail
cd "$(dirname "$0")/.."
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
sigs=$PWD/${1:-build/release}/sigs
shift || true
counts=("${@:-500}")
[ $# -gt 0 ] || counts=(500 5000 50000)
here=$PWD
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

source bench/looped_clip.sh
small_clip

TIMEFORMAT='%R %U %S'
# Prints wall-clock, user and system seconds and the maximum resident kilobytes.
measured() { # NAME
  local times
  times=$({ time {
    "$sigs" export "$lot/$1.json" --out "$lot/out" --force --codec h264 --masks video --progress none >"$lot/said" 2>&1 &
    local running=$! most=0 line
    while line=$(grep VmHWM "/proc/$running/status" 2>/dev/null); do
      most=$(awk '{ print $2 }' <<<"$line")
      sleep 0.2
    done
    wait "$running" || { cat "$lot/said" >&2; exit 1; }
    echo "$most" >"$lot/most"
  } 2>&3; } 3>&2 2>&1)
  echo "$times $(cat "$lot/most")"
}

{
  echo "| frames | ms a frame | processor ms a frame | resident at most, MB | of that at ${counts[0]} |"
  echo "|---|---|---|---|---|"
  first=
  for frames in "${counts[@]}"; do
    looped "$frames"
    looped_project "long-$frames" "$frames" 1
    read -r wall user system most < <(measured "long-$frames")
    first=${first:-$most}
    awk -v n="$frames" -v wall="$wall" -v work="$user $system" -v most="$most" -v first="$first" 'BEGIN {
      split(work, w, " ")
      printf "| %d | %.2f | %.2f | %.0f | %.3f |\n", n, 1000 * wall / n, 1000 * (w[1] + w[2]) / n, most / 1024, most / first }'
  done
} | tee "$lot/frames.table"
echo
{
  echo "| intruders | ms a frame | processor ms a frame | ms a frame for each more |"
  echo "|---|---|---|---|"
  looped 500
  before=
  for intruders in 1 2 4 8; do
    looped_project "many-$intruders" 500 "$intruders"
    read -r wall user system most < <(measured "many-$intruders")
    awk -v k="$intruders" -v wall="$wall" -v work="$user $system" -v before="$before" 'BEGIN {
      split(work, w, " "); n = split(before, b, " "); ms = 2 * (w[1] + w[2])
      printf "| %d | %.2f | %.2f | %s |\n", k, 2 * wall, ms, n ? sprintf("%.2f", (ms - b[2]) / (k - b[1])) : "" }'
    before="$intruders $(awk -v u="$user" -v s="$system" 'BEGIN { print 2 * (u + s) }')"
  done
} | tee "$lot/intruders.table"

if [ -n "$write" ]; then
  bench/fill.sh docs/speed.md frames "$lot/frames.table"
  bench/fill.sh docs/speed.md intruders "$lot/intruders.table"
fi
