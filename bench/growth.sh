#!/usr/bin/env bash
# How time and memory grow with intruders, waypoints, triangles, pixels and frames.
#   bench/growth.sh [--write] [--only DIMENSION] [BUILD]     default: build/release; about four minutes on two cores
# For each size: `sigs check`, `sigs frame`, and an export of one frame and of several (H.264, masks and labels). Between
# one row and the next stands the exponent of growth, from processor seconds: 1 is linear. It is an error where one is
# above 1.15: the rest is noise of the machine. --write puts the table into docs/speed.md.
set -euo pipefail
cd "$(dirname "$0")/.."
write= only=
while [ $# -gt 0 ]; do
  case $1 in
    --write) write=1 ;;
    --only) only=$2; shift ;;
    *) break ;;
  esac
  shift
done
sigs=$PWD/${1:-build/release}/sigs
aircraft=$PWD/assets/models/light-aircraft/light-aircraft.obj
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT
readonly kBound=1.15 kFrames=9 kClip=60

source bench/scaled_sample.sh

# Footage and lens: the sample, scaled to the width and cut to the height.
clip() { # WIDTH HEIGHT FRAMES
  local name=$lot/$1x$2-$3
  [ ! -e "$name.mp4" ] || return 0
  ffmpeg -v error -stream_loop -1 -i assets/footage/sample.mp4 -an -frames:v "$3" -vf "scale=$1:-2,crop=$1:$2" -c:v libx264 \
    -preset ultrafast -crf 20 -pix_fmt yuv420p "$name.mp4"
  scaled_lens "$1" "$2" >"$name.xml"
}

# An ellipsoid of that many triangles, 10 m long; textured: with an image of 1024x1024 all round.
ellipsoid() { # TRIANGLES textured|smooth
  local name=$lot/$1-$2
  [ ! -e "$name.obj" ] || return 0
  [ -e "$lot/skin.png" ] || ffmpeg -v error -f lavfi -i testsrc2=size=1024x1024 -frames:v 1 "$lot/skin.png"
  printf 'newmtl skin\nKd 0.8 0.8 0.8\n%s\n' "$([ "$2" = smooth ] || echo "map_Kd skin.png")" >"$name.mtl"
  awk -v count="$1" -v mtl="$1-$2.mtl" 'BEGIN {
    rings = int(sqrt(count / 4)); around = 2 * rings; pi = atan2(0, -1)
    print "mtllib " mtl
    for (j = 0; j <= rings; ++j) for (i = 0; i <= around; ++i) {
      a = pi * j / rings; b = 2 * pi * i / around
      x = cos(a); y = sin(a) * cos(b); z = sin(a) * sin(b)
      printf "v %.6f %.6f %.6f\nvt %.6f %.6f\n", 5 * x, 2 * y, 1 * z, i / around, j / rings
      length_ = sqrt((x / 5) ^ 2 + (y / 2) ^ 2 + z ^ 2)
      printf "vn %.6f %.6f %.6f\n", x / 5 / length_, y / 2 / length_, z / length_
    }
    print "usemtl skin"
    for (j = 0; j < rings; ++j) for (i = 0; i < around; ++i) {
      p = j * (around + 1) + i + 1; q = p + around + 1
      printf "f %d/%d/%d %d/%d/%d %d/%d/%d\n", p, p, p, q, q, q, p + 1, p + 1, p + 1
      printf "f %d/%d/%d %d/%d/%d %d/%d/%d\n", p + 1, p + 1, p + 1, q, q, q, q + 1, q + 1, q + 1
    } }' >"$name.obj"
}

# Intruders side by side with the camera's velocity, so each keeps its size; each flies a gentle wave through its
# waypoints, which need not lie at whole frames.
project() { # NAME CLIP FRAMES INTRUDERS WAYPOINTS MODEL
  {
    printf '{"sigs": 1, "name": "%s", "footage": {"video": "%s.mp4", "calibration": "%s.xml"},\n' "$1" "$lot/$2-$3" "$lot/$2-$3"
    printf '"camera": {"position_m": [0, 0, -150], "speed_mps": 22.0}, "intruders": ['
    awk -v intruders="$4" -v waypoints="$5" -v last="$(($3 - 1))" -v model="$6" 'BEGIN {
      for (k = 1; k <= intruders; ++k) {
        y = 12 * (k % 2 ? 1 : -1) * int(k / 2 + 0.5) % 100; z = -165 - 8 * (k % 5)
        printf "%s{\"name\": \"number-%d\", \"model\": {\"file\": \"%s\", \"forward\": \"+x\", \"up\": \"+z\"}, ", (k > 1 ? "," : ""), k, model
        printf "\"trajectory\": {\"waypoints\": ["
        for (i = 0; i < waypoints; ++i) {
          at = last * i / (waypoints - 1)
          printf "%s{\"frame\": %.7g, \"position_m\": [%.7f, %.7f, %d]}", (i ? ", " : ""), at, 80 + 22 * at / 25, y + 2 * sin(at / 9), z
        }
        printf "]}}"
      } }'
    echo ']}'
  } >"$lot/$1.json"
}

# Runs the program: wall-clock and processor seconds, and the maximum resident kilobytes.
measured() { # ARGUMENT...
  /usr/bin/time -q -f '%e %U %S %M' -o "$lot/time" "$sigs" "$@" >"$lot/said" 2>&1 || { cat "$lot/said" >&2; exit 1; }
  awk '{ print $1, $2 + $3, $4 }' "$lot/time"
}

# row DIMENSION SIZE NAME [FRAMES]: appends dimension, size, how many frames more the second export has, and for check,
# frame, an export of one frame and one of several: seconds, processor seconds, kilobytes.
row() {
  local check one many frame more=${4:-$kFrames}
  check=$(measured check "$lot/$3.json")
  frame=$(measured frame "$lot/$3.json" --frame 20 --out "$lot/frame" --force)
  one=$(measured export "$lot/$3.json" --out "$lot/out" --force --codec h264 --masks video --progress none --frames 20-20)
  many=$(measured export "$lot/$3.json" --out "$lot/out" --force --codec h264 --masks video --progress none --frames "20-$((20 + more))")
  echo "$1 $2 $more $check $frame $one $many" >>"$lot/rows"
}

wants() { [ -z "$only" ] || [ "$only" = "$1" ]; }
readonly kSmall=320x240
clip 320 240 $kClip
if wants intruders; then
  for count in 1 4 16 64; do
    project many $kSmall $kClip "$count" 2 "$aircraft"
    row intruders "$count" many
  done
fi
if wants waypoints; then
  for count in 10 100 1000 10000 100000; do
    project flown $kSmall $kClip 1 "$count" "$aircraft"
    row waypoints "$count" flown
  done
fi
for skin in smooth textured; do
  wants "$skin" || continue
  for count in 1000 10000 100000 1000000; do
    ellipsoid "$count" $skin
    project shaped $kSmall $kClip 1 2 "$lot/$count-$skin.obj"
    row "$skin" "$count" shaped
  done
done
if wants frames; then
  for count in 100 1000 4000; do
    clip 320 240 $((count + 60))
    project long $kSmall $((count + 60)) 1 2 "$aircraft"
    row frames "$count" long "$count"
  done
fi
if wants pixels; then
  for size in 320x240 640x480 1280x960 3840x2160 7680x4320; do
    clip "${size%x*}" "${size#*x}" $kClip
    project large "$size" $kClip 1 2 "$aircraft"
    row pixels "$size" large
    [ "$size" = $kSmall ] || rm "$lot/$size-$kClip.mp4"
  done
fi

# Columns of a row: 4-6 check, 7-9 frame, 10-12 export of one frame, 13-15 of $3 more.
awk -v bound=$kBound -v failed="$lot/failed" '
  function size_of(text, parts) { return split(text, parts, "x") == 2 ? parts[1] * parts[2] : text }
  # clear: the least that is judged; below it the hundredths of the clock decide.
  function exponent(now, before, clear, e) {
    if (!growth || before <= 0 || now <= 0) return ""
    e = log(now / before) / log(growth)
    if (e > bound && before >= clear) print dimension, size, sprintf("%.2f", e) >failed
    return sprintf("%.2f", e)
  }
  BEGIN {
    print "| what | size | check, processor s | exponent | frame | exponent | start of an export | exponent | processor ms a frame | exponent | MB | exponent |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|"
  }
  {
    size = $2; number = size_of(size); each = ($14 - $11) / $3
    growth = dimension == $1 ? number / last : 0
    dimension = $1
    printf "| %s | %s | %.2f | %s | %.2f | %s | %.2f | %s | %.1f | %s | %.0f | %s |\n", $1, size,
      $5, exponent($5, check, 0.1), $8, exponent($8, frame, 0.1), $11, exponent($11, start, 0.1), 1000 * each, exponent(each, before, 0.1 / $3),
      $15 / 1024, exponent($15, memory, 0)
    check = $5; frame = $8; start = $11; before = each; memory = $15; last = number
  }' "$lot/rows" | tee "$lot/table"
[ -z "$write" ] || bench/fill.sh docs/speed.md growth "$lot/table"
[ ! -s "$lot/failed" ] || { echo "error: more than linear: $(tr '\n' ';' <"$lot/failed")" >&2; exit 1; }
