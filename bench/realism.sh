#!/usr/bin/env bash
# Whether inserted aircraft can be told from real ones: realism/README.md.
#   bench/realism.sh [--init] [--matched] [--best] [BUILD]             the clips, at the defaults; some minutes on two processors
#   bench/realism.sh stills|trackers [--matched] [--best] [BUILD]
#   bench/realism.sh thermal --init [BUILD]  those of a thermal camera
#   bench/realism.sh lit --init [BUILD]     how bright the intruder is beside a real one, before and after `sigs appearance --lit-like`
#   --steps    trackers: what each equality of the real and the inserted target changes, of the last settings; some minutes more
#   --views N  of each inserted target, of which the one with the silhouette as large as the real one's is taken
#   --matched  also by the settings that `sigs appearance` finds in each clip
#   --init     also by the project that `sigs init` makes of each clip
#   --best     also by these with bench/realism/best.json over them, chosen by hand on the tuning clips; needs --matched
# Leaves tables, histograms and sheets in BUILD/realism, BUILD/realism-stills. The sheets show footage of others: they must not be
# committed.
set -euo pipefail
cd "$(dirname "$0")/.."
what=clips
case "${1:-}" in clips | stills | trackers | lit | thermal) what=$1 && shift ;; esac
matched= best= init= further=()
while [[ "${1:-}" == --* ]]; do
  case "$1" in
    --matched) matched=1 ;;
    --best) best=1 ;;
    --init) init=1 ;;
    --steps) further+=("$1") ;;
    --views) further+=("$1" "$2") && shift ;;
    *) echo "$1: no such option" >&2 && exit 2 ;;
  esac
  shift
done
build=${1:-build/release}
data=${SIGS_TEST_DATA:-../shared/data}
folder=$build/realism
[ $what = stills ] && folder=$build/realism-stills
[ $what = thermal ] && folder=$build/realism-thermal
mkdir -p "$folder/init"
options=(--shake "${further[@]}")
[ $what = clips ] || options+=("--$what")
[ $what != lit ] || options+=(--frames 2)
if [ -n "$init" ]; then
  for clip in "$data"/$([ $what = thermal ] && echo thermal/IR || echo track/V)_{AIRPLANE,HELICOPTER}_*.mp4; do
    to=$folder/init/$(basename "${clip%.*}").json
    [ -e "$to" ] || "$build/sigs" init "$clip" --out "$to" >/dev/null 2>"$to.log" || { cat "$to.log" >&2; exit 1; }
  done
  options+=(--settings-from "init=$folder/init")
fi
if [ -n "$matched" ]; then
  mkdir -p "$folder/matched"
  if [ $what = stills ]; then footage=("$data"/stills/aot/*.png "$data"/stills/skylink/skylink_[0235].jpeg); else footage=("$data"/track/V_{AIRPLANE,HELICOPTER}_*.mp4); fi
  number=0
  for clip in "${footage[@]}"; do
    to=$folder/matched/$(basename "${clip%.*}").json
    # The stills are named by their folder and their number (realism/clips.cpp).
    [ $what != stills ] || to=$folder/matched/$(basename "$(dirname "$clip")")_$((number++)).json
    [ -e "$to" ] || "$build/sigs" appearance "$clip" --out "$to" >"$to.txt" 2>&1 || { cat "$to.txt" >&2; exit 1; }
  done
  options+=(--settings-from "matched=$folder/matched")
fi
if [ -n "$best" ]; then options+=(--settings-from "best=$folder/matched,bench/realism/best.json"); fi
"$build/bench_realism" "$folder" "${options[@]}"
[ $what != lit ] || exit 0
if [ $what = trackers ]; then cat "$folder/trackers.md"; else cat "$folder/auc.md" "$folder/medians.md"; fi
