#!/usr/bin/env bash
# An export of a rig of six cameras, 1280x960, against six exports of one camera each: processor time and memory.
# Interleaved runs, medians: bench/rig.sh [RUNS] [BUILD] [FRAMES]; default 3, build/release, 100.
#   shared    all cameras have the sample clip, at six mounts
#   separate  each has a copy of it
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-3}
sigs=$PWD/${2:-build/release}/sigs
frames=${3:-100}
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

project() { # KIND
  local camera video comma=''
  echo '{"sigs": 1, "name": "six", "cameras": ['
  for camera in 0 1 2 3 4 5; do
    video=$PWD/assets/footage/sample.mp4
    if [ "$1" = separate ]; then
      video=$lot/copy$camera.mp4
      cp "$PWD/assets/footage/sample.mp4" "$video"
    fi
    echo "$comma{\"name\": \"camera$camera\", \"footage\": {\"video\": \"$video\", \"calibration\": \"$PWD/assets/calibrations/sample.xml\"},"
    echo "\"mount\": {\"position_m\": [0, 0.2, 0], \"attitude_deg\": {\"yaw\": $((camera * 10 - 25))}}}"
    comma=,
  done
  echo '], "camera": {"position_m": [0, 0, -150], "speed_mps": 22},'
  echo "\"intruders\": [{\"name\": \"airliner\", \"model\": {\"file\": \"$PWD/assets/models/airliner/airliner.obj\"},"
  echo '"trajectory": {"waypoints": [{"frame": 0, "position_m": [420, -130, -165]}, {"frame": 199, "position_m": [600, 140, -180]}]}}]}'
}

timed() { # KEY OPTIONS...
  /usr/bin/time -o "$lot/time" -f '%e %U %S %M' "$sigs" export "$lot/rig.json" --out "$lot/out" --force --frames "0-$((frames - 1))" \
    --progress none "${@:2}" >/dev/null 2>"$lot/said" || { cat "$lot/said" >&2; exit 1; }
  tail -1 "$lot/time" | awk -v key="$1" '{ print key, $1, $2 + $3, $4 / 1024 }' >>"$lot/$1.$run"
}

for kind in shared separate; do
  project "$kind" >"$lot/rig.json"
  for ((run = 0; run < runs; ++run)); do
    timed "$kind.rig"
    for camera in 0 1 2 3 4 5; do timed "$kind.single" --camera "camera$camera"; done
    for what in rig single; do # of six exports the sum of the times and the largest memory
      awk -v key="$kind $what" '{ wall += $2; cpu += $3; if ($4 > mb) mb = $4 } END { print key, wall, cpu, mb }' \
        "$lot/$kind.$what.$run" >>"$lot/times"
    done
  done
done

awk "$(cat bench/median.awk)"'
  { for (i = 3; i <= 5; i++) values[$1 $2 i] = values[$1 $2 i] " " $i }
  END {
    print "| footage | six exports: s | processor s | MB | one export: s | processor s | MB | ratio of s | of processor s |"
    print "|---|---|---|---|---|---|---|---|---|"
    for (n = 1; n <= 2; n++) {
      kind = n == 1 ? "shared" : "separate"; b = kind "single"; a = kind "rig"
      printf "| %s | %.1f | %.1f | %.0f | %.1f | %.1f | %.0f | %.2f | **%.2f** |\n", kind, median(b 3), median(b 4),
        median(b 5), median(a 3), median(a 4), median(a 5),
        median(a 3) / median(b 3), median(a 4) / median(b 4)
    }
  }' "$lot/times"
