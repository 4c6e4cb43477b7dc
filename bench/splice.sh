#!/usr/bin/env bash
# The codec `source`, which copies groups of pictures without an intruder.
#   bench/splice.sh kinds [BUILD] [FOLDER]          clips of thirty encoders: which frames keep every sample, which packets
#                                                   their bytes; FFmpeg decodes the results with its strictest settings, and
#                                                   GStreamer where it is installed
#   bench/splice.sh time [RUNS] [BUILD] [MINUTES]   a long clip (1920x1080, H.264) with 20 s of encounter: time and processor
#                                                   time against FFmpeg's transcode and the export as h264, interleaved;
#                                                   then the samples and packets outside the encoded groups
# The clips are made of ../shared/data/video/air_karma_gopro_coast.mp4, or of the sample footage where that is not there.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=${1:?kinds or time}
here=$PWD
real=$here/../shared/data/video/air_karma_gopro_coast.mp4
[ -e "$real" ] || real=$here/assets/footage/sample.mp4
ff() { ffmpeg -v error -nostdin -y "$@"; }

# An airliner that crosses the view between two frames and is far to the side before and after.
project() { # NAME CLIP FROM TO [turned]
  local size width height last
  size=$(ffprobe -v error -select_streams v:0 -show_entries stream=width,height -of csv=p=0:nk=1 "$2" | awk "NR == 1")
  IFS=, read -r width height _ <<<"$size"
  [ "${5:-}" = turned ] && { local swap=$width; width=$height; height=$swap; }
  last=$(($(frames_of "$2") - 1))
  cat >"$lot/$1.xml" <<XML
<?xml version="1.0"?>
<opencv_storage>
<image_width>$width</image_width><image_height>$height</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
<data>$width. 0. $((width / 2)). 0. $width. $((height / 2)). 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>5</rows><cols>1</cols><dt>d</dt><data>0. 0. 0. 0. 0.</data></distortion_coefficients>
</opencv_storage>
XML
  cat >"$lot/$1.json" <<JSON
{"sigs": 1, "name": "$1", "footage": {"video": "$2", "calibration": "$lot/$1.xml"},
 "camera": {"position_m": [0, 0, -150]},
 "intruders": [{"name": "airliner",
   "model": {"file": "$here/assets/models/airliner/airliner.obj", "forward": "+x", "up": "+z"},
   "trajectory": {"waypoints": [
     {"frame": 0, "position_m": [300, -9000, -160]}, {"frame": $3, "position_m": [300, -185, -160]},
     {"frame": $4, "position_m": [300, 185, -160]}, {"frame": $last, "position_m": [300, 9000, -160]}]}}]}
JSON
}

frames_of() {
  ffprobe -v error -select_streams v:0 -count_packets -show_entries stream=nb_read_packets -of csv=p=0:nk=1 "$1" | awk -F, "NR == 1 { print \$1 }"
}

# A line for each decoded frame: its time and the checksum of its samples.
samples_of() {
  ff -xerror -err_detect explode -noautorotate -i "$1" -map 0:v:0 -fps_mode passthrough -f framemd5 - |
    awk -F', *' '!/^#/ { print $3, $6 }' | sort -n
}

packets_of() {
  ffprobe -v error -select_streams v:0 -show_packets -show_data_hash md5 -show_entries packet=data_hash -of csv=p=0:nk=1 "$1" | sort
}

# "120..179": the frames whose samples differ; then packets with the same bytes.
compared() { # CLIP RESULT
  samples_of "$1" >"$lot/a"
  samples_of "$2" >"$lot/b"
  awk -v packets="$(comm -12 <(packets_of "$1") <(packets_of "$2") | wc -l)" '
    BEGIN { n = m = 0 }
    NR == FNR { was[n++] = $2; next }
    { if ($2 != was[m]) { if (first == "") first = m; last = m; ++differ }; ++m }
    END { printf "%d | %s | %d | %d", m, m != n ? "LOST FRAMES" : differ ? first ".." last : "none", differ, packets }' \
    "$lot/a" "$lot/b"
}

make_kinds() {
  local in=(-i "$lot/base.mkv") x265=log-level=none
  ff -i "$real" -an -frames:v 300 -vf scale=640:360,format=yuv420p -c:v ffv1 -map_metadata -1 -write_tmcd 0 "$lot/base.mkv"
  cd "$lot/clips"
  cp "$real" "00 GoPro, telemetry.mp4"
  ff "${in[@]}" -c:v libx264 "01 x264 medium.mp4"
  ff "${in[@]}" -c:v libx264 -preset ultrafast -g 30 "02 x264 ultrafast.mp4"
  ff "${in[@]}" -c:v libx264 -preset slower -g 48 "03 x264 slower.mp4"
  ff "${in[@]}" -c:v libx264 -profile:v baseline -g 25 "04 x264 baseline.mp4"
  ff "${in[@]}" -c:v libx264 -g 30 -x264-params open-gop=1 "05 x264, open groups.mp4"
  ff "${in[@]}" -c:v libx264 -g 60 -x264-params intra-refresh=1 "06 x264, intra refresh.mp4"
  ff "${in[@]}" -c:v libx264 -g 1 -crf 22 "07 x264, all intra.mov"
  ff "${in[@]}" -c:v libx264 -pix_fmt yuv420p10le -g 30 "08 x264, 10 bits.mkv"
  ff "${in[@]}" -c:v libx264 -pix_fmt yuv422p -g 30 "09 x264, 4:2:2.mp4"
  ff "${in[@]}" -c:v libx264 -pix_fmt yuv444p -g 30 "10 x264, 4:4:4.mkv"
  ff "${in[@]}" -c:v libx264 -g 30 -vf scale=out_range=pc,format=yuvj420p "11 x264, full range.mp4"
  ff "${in[@]}" -c:v libx264 -flags +ildct+ilme -x264-params tff=1 "12 x264, interlaced.mp4"
  ff "${in[@]}" -c:v libx264 -g 30 -vf "select='not(eq(mod(n,7),3))*not(between(mod(n,50),20,24))'" -fps_mode passthrough \
    -video_track_timescale 90000 "13 x264, varying rate.mp4"
  ff -i "13 x264, varying rate.mp4" -c copy -metadata:s:v:0 rotate=90 "14 phone: turned, varying rate.mov"
  ff "${in[@]}" -f lavfi -i sine=440:duration=10 -c:v libx264 -g 30 -c:a aac -timecode 01:00:00:00 "15 x264, sound, time code.mov"
  ff -ss 1.5 -i "15 x264, sound, time code.mov" -map 0:v -map 0:a -c copy "16 x264, edit list.mp4"
  printf '1\n00:00:00,000 --> 00:00:01,000\n<font size="28">FrameCnt: 1, DiffTime: 33ms\n[iso: 100] [shutter: 1/500.0]</font>\n\n' >"$lot/dji.srt"
  ff "${in[@]}" -i "$lot/dji.srt" -map 0:v -map 1:s -c:v libx264 -profile:v main -g 30 -bf 0 -c:s mov_text "17 DJI: H.264 with subtitles.mp4"
  ff "${in[@]}" -c:v libx265 -g 30 -x265-params $x265 "18 x265, open groups.mp4"
  ff "${in[@]}" -c:v libx265 -g 30 -x265-params $x265:open-gop=0 -tag:v hvc1 "19 x265, closed groups.mp4"
  ff "${in[@]}" -c:v libx265 -pix_fmt yuv420p10le -g 30 -x265-params $x265:bframes=0:open-gop=0 "20 x265, 10 bits.mkv"
  ff "${in[@]}" -c:v libx265 -g 30 -x265-params $x265:open-gop=0:repeat-headers=1 -tag:v hev1 "21 x265, sets in the stream.mp4"
  ff "${in[@]}" -c:v mjpeg -q:v 4 -pix_fmt yuvj420p "22 MJPEG.avi"
  ff "${in[@]}" -c:v mjpeg -q:v 3 -pix_fmt yuvj422p "23 MJPEG 4:2:2.mov"
  ff "${in[@]}" -c:v ffv1 -level 3 -g 1 -slices 4 -slicecrc 1 "24 FFV1.mkv"
  ff "${in[@]}" -c:v ffv1 "25 FFV1, version 0.mkv"
  ff "${in[@]}" -c:v prores_ks -profile:v hq "26 ProRes HQ.mov"
  ff "${in[@]}" -c:v libx264 -g 30 "27 x264 in a transport stream.ts"
  ff "${in[@]}" -c:v libvpx-vp9 -b:v 1M -cpu-used 8 -deadline realtime "28 VP9.webm"
  ff "${in[@]}" -c:v mpeg4 -q:v 4 "29 MPEG-4.avi"
  cd "$here"
}

kinds() {
  sigs=$here/${1:-build/release}/sigs
  lot=${2:-$(mktemp -d)}
  [ -n "${2:-}" ] || trap 'rm -rf "$lot"' EXIT
  mkdir -p "$lot/clips"
  make_kinds
  echo "| clip | frames | that differ from the footage | so many | packets with the footage's bytes | GStreamer | said |"
  echo "|---|---|---|---|---|---|---|"
  for clip in "$lot"/clips/*; do
    local name=${clip##*/} id turned= said result outcome gst=
    id=p${name%% *}
    [[ $name == *turned* ]] && turned=turned
    project "$id" "$clip" 130 165 $turned
    if said=$("$sigs" export "$lot/$id.json" --out "$lot/out" --force --codec source --masks none --labels none \
      --progress none 2>&1 >"$lot/written"); then
      result=$(head -1 "$lot/written")
      outcome=$(compared "$clip" "$result")
      gst="not installed"
      if command -v gst-launch-1.0 >/dev/null; then
        gst=$(gst-launch-1.0 -q filesrc location="$result" ! decodebin ! fakesink 2>&1 | head -1)
      fi
      echo "| $name | $outcome | ${gst:-no error} | $(sed -n 's/^warning: .*mp4: //p; s/^warning: .*mov: //p' <<<"$said" | tr '\n' ' ') |"
    else
      echo "| $name | refused | | | | | $(sed -n "s/^error: .*cannot be used: //p" <<<"$said" | sed "s|$lot/clips/||") |"
    fi
  done
}

TIMEFORMAT='%R %U %S'
timed() { # NAME COMMAND...
  local name=$1 seconds
  shift
  seconds=$({ time "$@" >/dev/null 2>"$lot/said"; } 2>&1) || { cat "$lot/said" >&2; exit 1; }
  awk -v name="$name" '{ printf "%s %.2f %.2f\n", name, $1, $2 + $3 }' <<<"$seconds" >>"$lot/times"
}

median() { # NAME COLUMN
  awk -v name="$1" -v column="$2" '$1 == name { print $column }' "$lot/times" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'
}

time_it() {
  local runs=${1:-3} minutes=${3:-10} frames name
  sigs=$here/${2:-build/release}/sigs
  lot=$(mktemp -d)
  trap 'rm -rf "$lot"' EXIT
  ff -i "$real" -an -map_metadata -1 -vf scale=1920:1080,format=yuv420p -c:v libx264 -crf 20 -g 30 -bf 2 "$lot/once.mp4"
  frames=$((minutes * 1800))
  ff -stream_loop -1 -i "$lot/once.mp4" -c copy -frames:v "$frames" "$lot/long.mp4"
  project long "$lot/long.mp4" $((frames / 2)) $((frames / 2 + 600))
  local settings=(--out "$lot/out" --force --masks none --progress none)
  for ((run = 0; run < runs; ++run)); do
    timed source "$sigs" export "$lot/long.json" "${settings[@]}" --codec source
    timed h264 "$sigs" export "$lot/long.json" "${settings[@]}" --codec h264
    timed ffmpeg ffmpeg -v error -nostdin -y -i "$lot/long.mp4" -an -c:v libx264 -crf 18 -g 60 \
      -x264-params threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1 "$lot/transcoded.mp4"
  done
  echo "| $frames frames, $runs runs | s | processor s | source takes |"
  echo "|---|---|---|---|"
  for name in source h264 ffmpeg; do
    awk -v name="$name" -v s="$(median "$name" 2)" -v p="$(median "$name" 3)" -v own="$(median source 3)" -v wall="$(median source 2)" \
      'BEGIN { printf "| %s | %.1f | %.1f | %.3f of the time, %.3f of the processor time |\n", name, s, p, wall / s, own / p }'
  done
  timed source "$sigs" export "$lot/long.json" "${settings[@]}" --codec source
  echo "frames | that differ | so many | packets with the footage's bytes: $(compared "$lot/long.mp4" "$lot/out/long.mp4")"
}

case $mode in
kinds) kinds "${@:2}" ;;
time) time_it "${@:2}" ;;
*) echo "splice.sh: kinds or time" >&2 && exit 2 ;;
esac
