#!/usr/bin/env bash
# Error of `sigs appearance` against the truth and against run time, by frames used and image size: clips with known blur and noise, made by
# FFmpeg, the samples, whose haze and light are known, and made footage with known airlight and sun (bench_surroundings).
#   bench/appearance.sh [BUILD]     default: build/release; some three minutes on two processors
# Clips are left in BUILD/appearance.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
folder=$build/appearance
mkdir -p "$folder"
sigs=$build/sigs
found=$folder/found.json

# A checkerboard turned by 7 degrees that drifts, drawn eight times finer each way, blurred there, averaged over the pixels. Its transfer function is
# linear, so that blurring codes is blurring light. gblur's edges are those of six exponentials each way, into which a Gaussian 3 % narrower fits best;
# four times half the sigma come within 0.8 %.
board() { # SIGMA_PX WIDTH HEIGHT FILE
  local half
  half=$(awk "BEGIN {print 4 * $1}")
  local blur="gblur=sigma=$half:steps=6"
  ffmpeg -nostdin -v error -y -f lavfi -i "color=gray:s=$((8 * $2))x$((8 * $3)):r=5:d=1.6,format=gray,geq=lum='if(mod(floor((X*0.9925+Y*0.1219+37*N)/480)+floor((Y*0.9925-X*0.1219+23*N)/480)\,2)\,190\,70)'" \
    -vf "$blur,$blur,$blur,$blur,scale=$2:$3:flags=area,noise=alls=2:allf=t,format=gray" -color_trc linear -color_range tv -c:v ffv1 "$4"
}

# The sample at half size, blurred until nothing of its own noise is left, with FFmpeg's noise: 5 has an sd of 2.51 codes, 9 one of 4.79, measured on an even gray image.
noisy() { # STRENGTH WIDTH FILE [CLIP SEED]
  ffmpeg -nostdin -v error -y -i "assets/footage/${4:-sample}.mp4" -frames:v 60 \
    -vf "scale=$2:-2:flags=area,gblur=sigma=1.2,noise=c0s=$1:c0f=t:all_seed=${5:--1},format=yuv420p" -c:v ffv1 "$3"
}

project() { # CLIP CAMERA FILE
  echo "{\"sigs\": 1, \"name\": \"bench\", \"camera\": {\"position_m\": [0, 0, -150], \"speed_mps\": 22, $2}, \"footage\": {
    \"video\": \"$PWD/assets/footage/$1.mp4\", \"calibration\": \"$PWD/assets/calibrations/sample.xml\", \"own_body_mask\": \"$PWD/assets/footage/sample_own_body.png\"}}" >"$3"
}

values() { # TRUTH QUANTITY...: frames used, then "value +- sd (error)" of each; no error where TRUTH is -
  python3 - "$found" "$@" <<'END'
import json, sys
report, truth = json.load(open(sys.argv[1])), sys.argv[2]
def cell(name):
    q = next(q for q in report['quantities'] if q['name'] == name)
    if not q['is_known']: return 'not known'
    text = '%.3g +- %.2g' % (q['value'], q['sd'])
    return text if truth == '-' else text + ' (%+.0f %%)' % (100 * (q['value'] / float(truth) - 1))
print(' | '.join([str(report['frames_used'])] + [cell(name) for name in sys.argv[3:]]))
END
}

over_brightness() { # TRUTH: frames used, then the largest error of the noise between 0.2 and 0.8 of the brightness
  python3 - "$found" "$1" <<'END'
import json, sys
report, truth = json.load(open(sys.argv[1])), float(sys.argv[2])
dark, bright = (next(q for q in report['quantities'] if q['name'] == 'noise at ' + end)['value'] for end in ('black', 'white'))
errors = [((dark ** 2 * (1 - b) + bright ** 2 * b) ** 0.5 / truth - 1) * 100 for b in (0.2, 0.4, 0.6, 0.8)]
print('%d | %+.1f %%' % (report['frames_used'], max(errors, key=abs)))
END
}

timed() { # NAME VIDEO FILE EVERY: least processor time, user and system, of five runs each, by turns
  "$sigs" appearance "$3" --every "$4" --json >"$found" 2>/dev/null
  python3 - "$1" "$(values -)" "$2" "$sigs" appearance "$3" --every "$4" --json <<'END'
import resource, subprocess, sys
def seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
name, frames, video, ours = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
decode = ['ffmpeg', '-v', 'error', '-threads', '1', '-i', video, '-map', '0:v', '-f', 'null', '-']
pairs = [(seconds(ours), seconds(decode)) for _ in range(5)]
least, decoding = (min(pair[k] for pair in pairs) for k in (0, 1))
print('| %s | %s | %.2f | %.2f | %.2f |' % (name, frames, least, decoding, least / decoding))
END
}

echo "| checkerboard, sigma px | image | frames used | point spread found, px | sharpening, truth 0 |"
echo "|---|---|---|---|---|"
while read -r sigma width height; do
  board "$sigma" "$width" "$height" "$folder/board.mkv"
  for every in 8 2 1; do
    "$sigs" appearance "$folder/board.mkv" --every $every --json >"$found"
    sharp=$(values - sharpening)
    echo "| $sigma | ${width}x$height | $(values "$sigma" "point spread") | ${sharp#* | } |"
  done
done <<<"0.5 480 360
1.0 480 360
1.0 320 240
2.0 480 360"
echo
echo "| noise, sd | width, px | frames used | at black | at white | spread, px | persistence |"
echo "|---|---|---|---|---|---|---|"
for strength in 5 9; do
  truth=$([ $strength = 5 ] && echo 2.51 || echo 4.79)
  for width in 640 320; do
    noisy $strength $width "$folder/noisy.mkv"
    for every in 60 15 3; do
      "$sigs" appearance "$folder/noisy.mkv" --every $every --json >"$found"
      rest=$(values - "noise's spread" "noise's temporal correlation")
      echo "| $truth | $width | $(values $truth "noise at black" "noise at white") | ${rest#* | } |"
    done
  done
done
echo
echo "| held out: clip, seed | noise, sd | width, px | frames used | largest error from 0.2 to 0.8 of the brightness |"
echo "|---|---|---|---|---|"
for clip in table1_clear table1_clouds; do
  for seed in 71 72; do
    for strength in 5 9; do
      truth=$([ $strength = 5 ] && echo 2.51 || echo 4.79)
      for width in 640 320; do
        noisy $strength $width "$folder/noisy.mkv" $clip $seed
        for every in 15 3; do
          "$sigs" appearance "$folder/noisy.mkv" --every $every --json >"$found"
          echo "| $clip, $seed | $truth | $width | $(over_brightness $truth) |"
        done
      done
    done
  done
done
echo
"$build/bench_surroundings"
echo
echo "| footage with calibration and attitude | frames used | visibility, m; truth 34500 | exposure; truth 1.2 in a clear sky |"
echo "|---|---|---|---|"
level='"attitude_deg": {"roll": 0, "pitch": 0}'
for clip in sample table1_clear table1_vibration; do
  camera=$level
  [ $clip = table1_vibration ] && camera="\"attitude_file\": \"$PWD/assets/footage/table1_vibration_attitude.csv\""
  project $clip "$camera" "$folder/$clip.json"
  for every in 200 50 25 8; do
    "$sigs" appearance "$folder/$clip.json" --every $every --json >"$found" 2>/dev/null
    exposure=$(values 1.2 exposure)
    echo "| $clip | $(values 34500 visibility) | ${exposure#* | } |"
  done
done
echo
echo "| processor time, s | frames used | sigs appearance | ffmpeg -threads 1, the whole clip | ratio |"
echo "|---|---|---|---|---|"
sample=assets/footage/sample.mp4
for every in 200 50 25 0 4; do timed "sample.mp4, 1280x960, 200 frames" $sample $sample $every; done
timed "the same with calibration and attitude" $sample "$folder/sample.json" 0
ffmpeg -nostdin -v error -y -i $sample -vf scale=640:-2:flags=area -c:v libx264 -crf 18 "$folder/half.mp4"
timed "the same at 640x480" "$folder/half.mp4" "$folder/half.mp4" 0
timed "table1_clear.mp4, 1280x960, 190 frames" assets/footage/table1_clear.mp4 assets/footage/table1_clear.mp4 0
