#!/usr/bin/env bash
# Error of `sigs appearance` against the truth and against run time, by frames used and image size: clips with known blur and noise, made by
# FFmpeg, the samples, whose haze and light are known, and made footage with known airlight and sun (bench_surroundings).
#   bench/appearance.sh [BUILD]     default: build/release; some three minutes on two processors
#   bench/appearance.sh time [--write] [RUNS] [BUILD] [CLIP...]     wall-clock and processor time of `sigs appearance` and `sigs mask` beside
#       decoding the same frames. Medians of 5 interleaved runs on the sample clips and those of ../shared/data; --write puts the table into
#       docs/speed.md.
# Clips are left in BUILD/appearance.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=errors
write=
if [ "${1:-}" = time ]; then
  mode=time && shift
  if [ "${1:-}" = --write ]; then write=1 && shift; fi
  runs=${1:-5}
  [ $# -gt 0 ] && shift
fi
build=${1:-build/release}
[ $# -gt 0 ] && shift
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

# Decoding the same frames: FFmpeg decodes the clip from its first frame to the last one that the command reads, with its usual threads, and drops
# them. `sigs mask` reads all frames up to own_body.frames, 1500. `sigs appearance` reads the middles of 24 equal parts and the frame after each
# (appearance.cpp); those between are decoded to reach them, from the last keyframe on.
times() { # CLIP...
  python3 - "$runs" "$sigs" "$folder" "$@" <<'END'
import os, re, statistics, subprocess, sys, time
runs, sigs, folder, clips = int(sys.argv[1]), sys.argv[2], sys.argv[3], sys.argv[4:]
def measured(command):
    began = time.monotonic()
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 65):  # 65: a mask that cannot be decided
        sys.exit('error: %s failed' % ' '.join(command))
    return time.monotonic() - began, used.ru_utime + used.ru_stime
def decoding(clip, frames):
    return ['ffmpeg', '-nostdin', '-v', 'error', '-i', clip, '-map', '0:v:0', '-frames:v', str(frames), '-fps_mode', 'passthrough', '-f', 'null', '-']
print('| clip | frames | decoding: s | processor s | `appearance`: s | ratio | processor s | ratio | `mask`: s | ratio | processor s | ratio |')
print('|' + '---|' * 12)
for clip in clips:
    info = subprocess.run([sigs, 'info', clip], capture_output=True, text=True, check=True).stdout
    count = int(re.search(r'frames: (\d+)', info).group(1))
    samples = min(24, max(1, count - 1))
    reached = min(count, (2 * samples - 1) * (count - 1) // (2 * samples) + 2)
    commands = {'appearance': [sigs, 'appearance', clip, '--json'], 'decoding for appearance': decoding(clip, reached),
                'mask': [sigs, 'mask', clip, '--out', folder + '/mask.png', '--force'], 'decoding for mask': decoding(clip, min(count, 1500))}
    times = [{name: measured(command) for name, command in commands.items()} for _ in range(runs + 1)][1:]  # the first reads the files
    cell = lambda name, k: statistics.median(run[name][k] for run in times)
    ratio = lambda name, k: statistics.median(run[name][k] / run['decoding for ' + name][k] for run in times)
    ours = ' | '.join('%.2f | **%.2f** | %.2f | **%.2f**' % (cell(name, 0), ratio(name, 0), cell(name, 1), ratio(name, 1)) for name in ('appearance', 'mask'))
    size = re.search(r'\d+x\d+', info).group(0)
    print('| %s, %s | %d | %.2f | %.2f | %s |' % (os.path.basename(clip), size, count, cell('decoding for mask', 0), cell('decoding for mask', 1), ours), flush=True)
END
}

if [ $mode = time ]; then
  clips=("$@")
  if [ ${#clips[@]} = 0 ]; then
    sample=assets/footage/sample.mp4
    for width in 320 640; do ffmpeg -nostdin -v error -y -i $sample -vf scale=$width:-2:flags=area -c:v libx264 -crf 18 "$folder/sample-$width.mp4"; done
    clips=("$folder"/sample-{320,640}.mp4 $sample assets/footage/table1_{clear,clouds,vibration}.mp4)
    for clip in ../shared/data/{video/*.{avi,mp4},track/V_{AIRPLANE_001,AIRPLANE_044,HELICOPTER_045,DRONE_004,BIRD_002}.mp4,thermal/IR_AIRPLANE_00[24].mp4}; do
      if [ -e "$clip" ]; then clips+=("$clip"); fi
    done
  fi
  times "${clips[@]}" | tee "$folder/times.md"
  if [ -n "$write" ]; then bench/fill.sh docs/speed.md appearance "$folder/times.md"; fi
  exit
fi

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
