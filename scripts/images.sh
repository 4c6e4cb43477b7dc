#!/usr/bin/env bash
# Makes the images of README.md and docs/: scripts/images.sh [BUILD FOLDER] (after
# scripts/test.sh; Xvfb and xdotool are needed).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The head-on encounter at frame 148; below, the intruder and its mask, four times enlarged.
"$build"/sigs frame projects/head-on/head-on.json --frame 148 --stages --out "$work" >/dev/null
mkdir -p docs/images
ffmpeg -v error -y -i "$work/frame_148.png" -i "$work"/frame_148_*_mask.png -filter_complex "
  [0]split[whole][part];
  [whole]crop=1280:640:0:240,scale=960:480[top];
  [part]crop=180:90:575:680,scale=480:240:flags=neighbor[left];
  [1]format=rgb24,crop=180:90:575:680,scale=480:240:flags=neighbor[right];
  [left][right]hstack[bottom];
  [top][bottom]vstack" -q:v 3 docs/images/head-on.jpg

# The paper's figure 4: every stage of the classic method at frame 140.
"$build"/sigs frame projects/crossing/crossing.json --frame 140 --stages --out "$work" \
  --set compositing.method=classic >/dev/null
stages=()
for stage in input1 input2 a b c d f output; do
  stages+=(-i "$(ls "$work"/frame_140_*_"$stage".png)")
done
ffmpeg -v error -y "${stages[@]}" -filter_complex "
  [0]scale=400:-1[s0];[1]scale=400:-1[s1];[2]scale=400:-1[s2];[3]scale=400:-1[s3];
  [4]scale=400:-1[s4];[5]scale=400:-1[s5];[6]scale=400:-1[s6];[7]scale=400:-1[s7];
  [s0][s1][s2][s3]hstack=4[upper];[s4][s5][s6][s7]hstack=4[lower];[upper][lower]vstack" \
  -q:v 4 docs/images/classic-stages.jpg

# The sample models: part of frame 100 of the project that has them all, enlarged.
"$build"/sigs frame projects/liveries/liveries.json --frame 100 --out "$work" >/dev/null
ffmpeg -v error -y -i "$work/frame_100.png" -vf "crop=900:420:200:150,scale=1350:-1:flags=neighbor" -q:v 4 \
  docs/images/models.jpg

# The editor, as a test drives it.
"$build"/test_editor_ui_test --test-case='the ten steps*,a person authors*,a person makes a project*,a person finds the own body*,a person loads trackers*,the footage is matched*,a click on an entry*' >"$work/ui_test.log" || {
  cat "$work/ui_test.log"
  exit 1
}
editor_image() {  # NAME SCREENSHOT
  ffmpeg -v error -y -i "$build/screenshots/$2.png" -vf scale=1200:-1:flags=lanczos -q:v 5 \
    "docs/images/editor-$1.jpg"
}
# A waypoint dragged over the footage, and the encounter that comes of it: six seconds.
"$build"/test_editor_ui_test --no-skip --test-case='a waypoint is dragged over the footage*' >"$work/drag.log" || {
  cat "$work/drag.log"
  exit 1
}
"$build"/sigs export "$build"/screenshots/animation/dragged.json --frames 112-160 --codec png --masks none --labels none \
  --out "$work/dragged" --progress none >/dev/null
ffmpeg -v error -y -framerate 10 -i "$build"/screenshots/animation/%03d.png -framerate 20 -pattern_type glob \
  -i "$work/dragged/*/*.png" -filter_complex "
  [0]scale=800:480:flags=lanczos,fps=10,setsar=1[window];
  [1]scale=800:480:force_original_aspect_ratio=increase:flags=lanczos,crop=800:480:0:120,fps=10,setsar=1[result];
  [window][result]concat" -c:v libwebp_anim -quality 55 -compression_level 6 -loop 0 docs/images/drag.webp

editor_image open ui_test-open
editor_image new-project new-project-dialog
editor_image footage 'tutorial-5 dragged'
editor_image world 'tutorial-7 handle'
editor_image light 'tutorial-8 light'
editor_image stages 'tutorial-9 classic'
editor_image own-body own-body-found
editor_image results results-loaded
editor_image appearance appearance-matched
editor_image encounter encounter-lanes-shown
