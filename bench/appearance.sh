#!/usr/bin/env bash
# Error against run time of `sigs appearance`: clips with known blur and noise, made by FFmpeg, and a clip of the samples, by frames used
# and image size.
#   bench/appearance.sh [BUILD]     default: build/release; some two minutes on two processors
# Clips are left in BUILD/appearance.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
folder=$build/appearance
mkdir -p "$folder"
sigs=$build/sigs

# A checkerboard turned by 7 degrees that drifts, drawn eight times finer each way, blurred there, averaged over the pixels. Its transfer function is
# linear, so that blurring codes is blurring light.
board() { # SIGMA_PX FILE
  ffmpeg -v error -y -f lavfi -i "color=gray:s=3840x2880:r=5:d=1.6,format=gray,geq=lum='if(mod(floor((X*0.9925+Y*0.1219+37*N)/480)+floor((Y*0.9925-X*0.1219+23*N)/480)\,2)\,190\,70)'" \
    -vf "gblur=sigma=$(awk "BEGIN {print 8 * $1}"):steps=6,scale=480:360:flags=area,noise=alls=2:allf=t,format=gray" -color_trc linear -color_range tv -c:v ffv1 "$2"
}

# The sample at half size, blurred until nothing of its own noise is left, with FFmpeg's noise: 5 has an sd of 2.51 codes, 9 one of 4.79, measured on an even gray image.
noisy() { # STRENGTH SIZE FILE
  ffmpeg -v error -y -i assets/footage/sample.mp4 -frames:v 60 -vf "scale=$2:-2:flags=area,gblur=sigma=1.2,noise=c0s=$1:c0f=t,format=yuv420p" -c:v ffv1 "$3"
}

value() { # JSON QUANTITY: value +- sd
  python3 -c "
import json, sys
q = [q for q in json.load(open(sys.argv[1]))['quantities'] if q['name'] == sys.argv[2]][0]
print('%.3g +- %.2g' % (q['value'], q['sd']) if q['is_known'] else 'not known')" "$1" "$2"
}

echo "| checkerboard, sigma px | frames used | point spread found, px | sharpening |"
echo "|---|---|---|---|"
for sigma in 0.5 1.0 2.0; do
  board $sigma "$folder/board.mkv"
  for every in 8 2 1; do
    "$sigs" appearance "$folder/board.mkv" --every $every --json >"$folder/found.json"
    echo "| $sigma | $(grep -o '"frames_used": [0-9]*' "$folder/found.json" | grep -o '[0-9]*') | $(value "$folder/found.json" "point spread") | $(value "$folder/found.json" sharpening) |"
  done
done
echo
echo "| noise, sd | size | frames used | at black | at white | spread, px | persistence |"
echo "|---|---|---|---|---|---|---|"
for strength in 5 9; do
  for size in 640 320; do
    noisy $strength $size "$folder/noisy.mkv"
    for every in 60 15 3; do
      "$sigs" appearance "$folder/noisy.mkv" --every $every --json >"$folder/found.json"
      echo "| $([ $strength = 5 ] && echo 2.51 || echo 4.79) | $size | $(grep -o '"frames_used": [0-9]*' "$folder/found.json" | grep -o '[0-9]*') | $(value "$folder/found.json" "noise at black") | $(value "$folder/found.json" "noise at white") | $(value "$folder/found.json" "noise's spread") | $(value "$folder/found.json" "noise's persistence") |"
    done
  done
done
echo
echo "| clip | frames used | processor time, s | decoding alone (ffmpeg -threads 1), s |"
echo "|---|---|---|---|"
TIMEFORMAT="%U"
decoding=$( { time ffmpeg -v error -threads 1 -i assets/footage/sample.mp4 -map 0:v -f null - >/dev/null; } 2>&1)
for every in 200 50 25 8 4; do
  used=$( { time "$sigs" appearance assets/footage/sample.mp4 --every $every --json >"$folder/found.json"; } 2>&1)
  echo "| sample.mp4, 1280x960 | $(grep -o '"frames_used": [0-9]*' "$folder/found.json" | grep -o '[0-9]*') | $used | $decoding |"
done
