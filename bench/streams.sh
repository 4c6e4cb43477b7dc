#!/usr/bin/env bash
# Frames a second of an export into a file and into pipes, and of footage in images against the same in a video.
#   bench/streams.sh [RUNS] [FRAMES] [BUILD]     default: 3 interleaved runs of 200 frames, build/release
# The clip is the sample footage (1280x960, H.264) with one intruder of about 60 px, without masks and labels.
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-3}
frames=${2:-200}
sigs=$PWD/${3:-build/release}/sigs
here=$PWD
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT
last=$((frames - 1))

cat >"$lot/p.json" <<JSON
{"sigs": 1, "name": "p",
 "footage": {"video": "$here/assets/footage/sample.mp4", "last_frame": $last,
             "calibration": "$here/assets/calibrations/sample.xml"},
 "intruders": [{"name": "light-aircraft",
   "model": {"file": "$here/assets/models/light-aircraft/light-aircraft.obj", "forward": "+x", "up": "+z"},
   "trajectory": {"waypoints": [{"frame": 0, "position_m": [80, 15, -165]}, {"frame": $last, "position_m": [80, -15, -165]}]}}]}
JSON
for kind in png jpeg; do
  "$sigs" export "$lot/p.json" --out "$lot/$kind" --codec "$kind" --masks none --labels none --progress none >/dev/null 2>&1
done

TIMEFORMAT=%R
timed() { # NAME SHELL
  local seconds
  seconds=$({ time bash -c "$2" >/dev/null 2>"$lot/said"; } 2>&1) || { cat "$lot/said" >&2; exit 1; }
  echo "$1;$seconds" >>"$lot/times"
}
plain="--masks none --labels none --progress none"
for ((run = 0; run < runs; ++run)); do
  rm -rf "$lot/out"
  timed "file, ffv1" "'$sigs' export '$lot/p.json' --out '$lot/out' --force $plain"
  timed "file, y4m" "'$sigs' export '$lot/p.json' --out '$lot/out' --force $plain --container y4m"
  timed "pipe, nut with ffv1" "'$sigs' export '$lot/p.json' --out - --progress none | cat >/dev/null"
  timed "pipe, nut with raw" "'$sigs' export '$lot/p.json' --out - --codec raw --progress none | cat >/dev/null"
  timed "pipe, y4m" "'$sigs' export '$lot/p.json' --out - --container y4m --progress none | cat >/dev/null"
  timed "pipe, y4m, and labels" \
    "'$sigs' export '$lot/p.json' --out - --container y4m --progress none --labels-fd 3 3> >(cat >/dev/null) | cat >/dev/null"
  for kind in png jpeg; do
    timed "pipe, y4m or nut, footage in $kind images" "'$sigs' export '$lot/p.json' --set footage.video='$lot/$kind/p' \
      --set footage.frame_rate=25 --out - --codec raw --progress none | cat >/dev/null"
  done
done

sort -t';' -k1,1 -k2,2n -s "$lot/times" | awk -F';' -v frames="$frames" -v order="$(cut -d';' -f1 "$lot/times" | awk '!seen[$0]++' | paste -sd';')" '
  { seconds[$1, ++count[$1]] = $2 }
  function median(name) { return (seconds[name, int((count[name] + 1) / 2)] + seconds[name, int(count[name] / 2) + 1]) / 2 }
  END {
    print "| way | frames/s, median | of the file |"
    print "|---|---|---|"
    n = split(order, names, ";")
    for (i = 1; i <= n; ++i)
      printf "| %s | %.1f | %.2f |\n", names[i], frames / median(names[i]), median(names[1]) / median(names[i])
  }'
