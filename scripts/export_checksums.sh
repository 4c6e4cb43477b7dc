#!/usr/bin/env bash
# Checksums of everything that `sigs` writes from the sample projects: each method, codec and kind of masks, all label
# formats, the stages of a frame, videos of a dataset, the own body's mask. Two programs that write the same bytes print
# the same list:
#   scripts/export_checksums.sh old/sigs >old.txt
#   scripts/export_checksums.sh build/release/sigs >new.txt
#   diff old.txt new.txt
# FRAMES (130-159 if not given) are the frames exported of each project. Some minutes on two cores.
set -euo pipefail
if [ $# -ne 1 ] || [ ! -x "$1" ]; then
  echo "usage: scripts/export_checksums.sh SIGS" >&2
  exit 64
fi
sigs=$(realpath "$1")
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints a line for each file in $work/out, its path with NAME before it, and empties the folder.
checksums() {  # NAME
  (cd "$work/out" && find . -type f -print0 | sort -z | xargs -0 sha256sum) | sed "s#  \./#  $1/#"
  rm -rf "$work/out"
}

# All formats that this program has, from its help.
labels=$("$sigs" export --help | sed -n 's/^ *--labels .*commas: \(.*\); none$/\1/p' | tr -d ' ')
if [ -z "$labels" ]; then
  echo "export_checksums.sh: $sigs export --help does not list the label formats" >&2
  exit 70
fi

for project in crossing head-on two-intruders; do
  file=projects/$project/$project.json
  for method in direct classic plain; do
    for output in "ffv1 video" "h264 png" "mjpeg none" "png png"; do
      read -r codec masks <<<"$output"
      "$sigs" export "$file" --out "$work/out" --frames "${FRAMES:-130-159}" --method $method --codec "$codec" \
        --masks "$masks" --labels "$labels" --progress none >/dev/null
      checksums "$project/$method/$codec"
    done
    "$sigs" frame "$file" --frame 148 --stages --out "$work/out" --set compositing.method=$method >/dev/null
    checksums "$project/$method/stages"
  done
  # A blur so wide that it is made from a coarser rendering.
  "$sigs" frame "$file" --frame 148 --out "$work/out" --set compositing.blur_px_per_m=0.2 >/dev/null
  checksums "$project/wide-blur"
done
"$sigs" dataset projects/table1/table1.json --out "$work/out" --only 1LRB737,3FNC172 --progress none >/dev/null
# Files that contain the path of this folder are left out.
rm -rf "$work"/out/*/*.json
checksums dataset
mkdir "$work/out"
"$sigs" mask assets/footage/sample.mp4 --out "$work/out/own_body.png" >/dev/null 2>&1
checksums mask
