#!/usr/bin/env bash
# Compares whole exports of two builds, on realistic cases: the gain of an optimization over its plain
# form, where one build has the one and the other build the other.
#   bench/machinery.sh BUILD PLAIN_BUILD [RUNS] [FRAMES] [CASE...]     default: 5 interleaved runs, frames 0-39, all cases
# FFV1 with masks and XML labels, as `sigs export` makes them. Medians; "user" is processor time of all threads, which a
# busy machine disturbs less than the clock. "compose" is drawing and compositing, ms a frame. The last column names the
# files that differ between the two. docs/decisions/0001-machinery.md has the results.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ $# -lt 2 ]; then
  sed -n '2,8s/^# //p' "$0" >&2
  exit 64
fi
builds=("$1" "$2")
runs=${3:-5}
frames=${4:-0-39}
shift $(($# < 4 ? $# : 4))
here=$PWD
data=$here/../shared/data
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

sample=assets/footage/sample.mp4
lens=$here/assets/calibrations/sample.xml
light_aircraft="$here/assets/models/light-aircraft/light-aircraft.obj +x +z"

# One intruder on a straight path from A to B (camera at 0 0 -150, 22 m/s ahead), or through a place between them.
project() { # NAME CLIP CALIBRATION "MODEL FORWARD UP" LAST_FRAME A B [FRAME PLACE]
  local model forward up between=
  read -r model forward up <<<"$4"
  [ $# -gt 7 ] && between="{\"frame\": $8, \"position_m\": [$9]},"
  cat >"$lot/$1.json" <<EOF
{"sigs": 1, "name": "$1", "footage": {"video": "$2", "calibration": "$3"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0},
 "intruders": [{"name": "intruder", "model": {"file": "$model", "forward": "$forward", "up": "$up"},
   "trajectory": {"waypoints": [{"frame": 0, "position_m": [$6]}, $between {"frame": $5, "position_m": [$7]}]}}]}
EOF
}

scaled() { # NAME SIZE FRAMES
  ffmpeg -v error -i "$sample" -an -frames:v "$3" -vf "scale=$2" -c:v libx264 -preset veryfast -crf 18 "$lot/$1.mp4"
}

yaml() { # NAME WIDTH HEIGHT FOCAL COEFFICIENTS COUNT FISHEYE
  cat >"$lot/$1.yml" <<EOF
%YAML:1.0
---
image_width: $2
image_height: $3
fisheye_model: $7
camera_matrix: !!opencv-matrix {rows: 3, cols: 3, dt: d, data: [$4, 0, $(($2 / 2)), 0, $4, $(($3 / 2)), 0, 0, 1]}
distortion_coefficients: !!opencv-matrix {rows: 1, cols: $6, dt: d, data: [$5]}
EOF
}

yaml fisheye 1280 960 400 "-0.01, 0.002, -0.0003, 0.00001" 4 1
yaml tangential 640 480 300 "-0.2, 0.05, 0.03, -0.02, 0.0" 5 0
past="105, 0, -158"
project near "$here/$sample" "$lens" "$light_aircraft" 199 "60, -25, -155" "190, 14, -160" 100 "$past"
project near-tangential "$lot/vga.mp4" "$lot/tangential.yml" "$light_aircraft" 199 "60, -25, -155" "190, 14, -160" 100 "$past"
project near-4k "$lot/4k.mp4" "$lens" "$light_aircraft" 39 "40, -8, -153" "70, 8, -153"
project fisheye "$here/$sample" "$lot/fisheye.yml" "$light_aircraft" 199 "60, -60, -180" "230, 60, -180"

cases=(head-on crossing two-intruders head-on-classic crossing-plain head-on-blurred crossing-blurred
  near near-tangential near-4k fisheye)
if [ -d "$data/models/cessna172p-hires" ]; then
  cessna="$data/models/cessna172p-hires/cessna172p-hires.obj -x +y"
  project many-triangles "$here/$sample" "$lens" "$cessna" 199 "100, 15, -160" "275, 15, -160"
  cases+=(many-triangles)
fi
[ $# -gt 0 ] && cases=("$@")
case " ${cases[*]} " in *4k*) scaled 4k 3840:2880 40 ;; esac
case " ${cases[*]} " in *tangential*) scaled vga 640:480 200 ;; esac

arguments() { # CASE
  case $1 in
    head-on | crossing | two-intruders) echo "projects/$1/$1.json" ;;
    *-classic) echo "projects/${1%-classic}/${1%-classic}.json --method classic" ;;
    *-plain) echo "projects/${1%-plain}/${1%-plain}.json --method plain" ;;
    *-blurred) echo "projects/${1%-blurred}/${1%-blurred}.json --set compositing.blur_px_per_m=0.05" ;;
    *) echo "$lot/$1.json" ;;
  esac
}

TIMEFORMAT='%R %U'
exported() { # CASE WHICH: prints wall, user, compose
  local times
  # shellcheck disable=SC2046
  times=$({ time "${builds[$2]}/sigs" export $(arguments "$1") --out "$lot/out-$2" --force --frames "$frames" --times \
    --progress none >/dev/null 2>"$lot/said"; } 2>&1) || { cat "$lot/said" >&2; exit 1; }
  echo "$times $(sed -nE 's|.*draw ([0-9.]+) ms, composite ([0-9.]+) ms.*|\1 \2|p' "$lot/said" | awk '{ print $1 + $2 }')"
}

for name in "${cases[@]}"; do
  rm -rf "$lot"/out-*
  for run in $(seq "$runs"); do
    for which in $((run % 2)) $(((run + 1) % 2)); do
      echo "$name $which $(exported "$name" "$which")"
    done
  done
  differ=$(diff -rq "$lot/out-0" "$lot/out-1" | sed -nE 's|^Files [^ ]*/([^ /]+) and .*|\1|p' | tr '\n' ' ') || true
  echo "$name differs ${differ:-none}"
done | awk '
  function median(key,   n, i, j, t, v) {
    n = split(values[key], v, " ")
    for (i = 1; i <= n; i++) for (j = i + 1; j <= n; j++) if (v[j] + 0 < v[i] + 0) { t = v[i]; v[i] = v[j]; v[j] = t }
    return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
  }
  BEGIN {
    print "| case | wall s | plain | ratio | user s | plain | ratio | compose ms | plain | ratio | files that differ |"
    print "|---|---|---|---|---|---|---|---|---|---|---|"
  }
  $2 != "differs" { for (c = 3; c <= 5; c++) values[$1 $2 c] = values[$1 $2 c] " " $c; next }
  {
    printf "| %s", $1
    for (c = 3; c <= 5; c++) {
      base = median($1 0 c); plain = median($1 1 c)
      printf " | %.2f | %.2f | **%.2f**", base, plain, (base > 0 ? plain / base : 0)
    }
    printf " |"
    for (c = 3; c <= NF; c++) printf " %s", $c
    print " |"
    fflush()
  }'
