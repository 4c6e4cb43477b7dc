#!/usr/bin/env bash
# Slip of an intruder that is fixed in the world against the background of real clips, with the camera's attitude from the
# footage and without: tables, strips of enlarged frames, the figure of the documentation.
#   bench/world_lock.sh [--write] [--images FOLDER] [BUILD]     default: build/release; some ten minutes on two processors
#   bench/world_lock.sh --init [BUILD]     instead: projects as `sigs init` makes them, with their lock and without; exit
#                                          status 1 where a clip is worse with it. Five minutes
#   --write          draws docs/images/camera-motion-lock.png anew, from our own footage
#   --images FOLDER  strips of the real clip `coast`, into FOLDER (not to be committed: the footage is not ours)
# Tables (CSV), the estimates and slip.md are left in BUILD/world-lock.
set -euo pipefail
cd "$(dirname "$0")/.."
write= images= init=
[ "${1:-}" = --init ] && init=1 && shift
[ "${1:-}" = --write ] && write=1 && shift
[ "${1:-}" = --images ] && images=$2 && shift 2
build=${1:-build/release}
folder=$build/world-lock
if [ -n "$init" ]; then
  folder=$build/world-lock-init
  "$build/bench_world_lock" "$folder" --init >&2
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
      print "| clip | slip a frame, rms px: no lock | init | largest: no lock | init | off in up to 10 s, rms px: no lock | init | |"
      print "|---|---|---|---|---|---|---|---|"; next }
    function v(name) { return $at[name] }
    v("frames") == 0 { next }
    v("camera") == "init without lock" { step = v("step_rms_px"); most = v("step_max_px"); off = v("offset_rms_px"); next }
    { worse = v("step_rms_px") > 1.001 * step || v("offset_rms_px") > 1.001 * off
      bad += worse
      printf "| %s | %.3f | %.3f | %.2f | %.2f | %.2f | %.2f | %s |\n", v("clip"), step, v("step_rms_px"), most, v("step_max_px"), off,
        v("offset_rms_px"), worse ? "worse" : v("offset_rms_px") == off ? "no lock" : "" }
    END { exit bad > 0 }
  ' "$folder/slip.csv" | tee "$folder/slip.md"
  exit
fi
if [ -n "$images" ]; then "$build/bench_world_lock" "$folder" --images "$images"; fi
if [ -n "$write" ]; then "$build/bench_world_lock" "$folder" --figure docs/images/camera-motion-lock.png; fi
"$build/bench_world_lock" "$folder" >&2
awk -F, '
  NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
    print "| clip | camera by | frames | lost | slip a frame rms, px | largest | trembling rms, px | off in up to 10 s, rms, px | largest | beyond parallax rms, px | largest | followed for, s | reference, px | growth, % a second | lens |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"; next }
  function v(name) { return $at[name] }
  { printf "| %s | %s | %d | %d | **%.3f** | %.2f | %.3f | **%.2f** | %.1f | %.2f | %.1f | %.1f | %.3f | %.1f | %s |\n", v("clip"), v("camera"),
      v("frames"), v("lost"), v("step_rms_px"), v("step_max_px"), v("tremble_rms_px"), v("offset_rms_px"), v("offset_max_px"),
      v("beyond_rms_px"), v("beyond_max_px"), v("longest_s"), v("reference_sd_px"), v("growth_percent_per_s"), v("lens") }
' "$folder/slip.csv" | tee "$folder/slip.md"
