#!/usr/bin/env bash
# Accuracy and speed of the estimation of attitude: flights with exact truth, by case, and error against run time.
#   bench/ego_motion.sh [quick|draw|horizons] [BUILD]     default: build/release; some twenty minutes on two processors, of which
#                                                most goes into drawing the flights, once
#   quick     few small frames: only shows that it runs
#   draw      measures nothing: tables of the last run
#   horizons  instead: in how many frames of real clips the horizon is found, by rows read by eye (ego_motion/horizons.csv)
# Flights and tables (CSV) are left in BUILD/ego-motion.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=whole
case "${1:-}" in quick | draw | horizons) mode=$1 && shift ;; esac
build=${1:-build/release}
[ "$mode" != horizons ] || exec "$build/bench_ego_motion" horizons bench/ego_motion/horizons.csv
folder=$build/ego-motion
effort=()
[ "$mode" = quick ] && folder=$build/ego-motion-quick && effort=(quick)

if [ "$mode" != draw ]; then
  for what in cases sweep; do
    echo "measuring: $what" >&2
    "$build/bench_ego_motion" "$what" "$folder" "${effort[@]}"
  done
fi

awk -F, '
  NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
    print "| case | seed | gyro | slip a frame, px | drift in 10 s, largest, px | drift rms, px | error, mdeg | sd, mdeg | within 2 sd: X | Y | Z | ellipsoid | frames lost | run / decoding | offset of the log, ms | its drift, ppm |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"; next }
  function v(name) { return $at[name] }
  { printf "| %s | %s | %s | **%.3f** | **%.2f** | %.2f | %.1f | %.1f | %.2f | %.2f | %.2f | %.2f | %d | %.1f | %s | %s |\n",
      v("case"), v("seed"), v("gyro"), v("step_rms_px"), v("drift_max_px"), v("drift_rms_px"), v("error_mdeg"), v("sd_mdeg"),
      v("within_x"), v("within_y"), v("within_z"), v("within_ellipsoid"), v("lost"), v("run_s") / (v("decode_s") > 0 ? v("decode_s") : 1),
      v("gyro") == "yes" ? v("offset_ms") " +- " v("offset_sd_ms") : "", v("gyro") == "yes" ? v("drift_ppm") : "" }
' "$folder/cases.csv" | tee "$folder/cases.md"
echo
awk -F, '
  NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
    print "| variant | case | slip a frame, px | drift in 10 s, largest, px | ellipsoid | frames lost | processor time, s | run / decoding |"
    print "|---|---|---|---|---|---|---|---|"; next }
  { printf "| %s | %s | %.3f | %.2f | %.2f | %d | %.2f | %.1f |\n", $at["variant"], $at["case"], $at["step_rms_px"], $at["drift_max_px"],
      $at["within_ellipsoid"], $at["lost"], $at["run_s"], $at["run_s"] / ($at["decode_s"] > 0 ? $at["decode_s"] : 1) }
' "$folder/sweep.csv" | tee "$folder/sweep.md"
