#!/usr/bin/env bash
# Whether memory, descriptors and threads of one process stay level over a long run. Memory is what it has of its own
# (RssAnon): resident pages of files and libraries come and go with what other programs need.
#   bench/endurance.sh [--write] frames  [FRAMES|draw]  [BUILD]   one export, default 100000 frames of build/release
#   bench/endurance.sh [--write] dataset [VIDEOS|draw]  [BUILD]   one dataset, default 500 videos of build/release
#   bench/endurance.sh [--write] editor  [MINUTES|draw] [BUILD]   random input, default 30 minutes of build/asan; the
#                                                                 keys and the mouse are those of build/release
# Each second a line goes to BUILD/endurance/PART.csv. A line is fitted to the last two thirds by least squares; the run
# fails where memory rises by more than the bound that is printed beside it, or descriptors or threads by more than five
# in that time: they come and go with each video and each dialog. The editor's work in the background (an export, a
# search) has threads and memory of its own until it ends: memory is fitted to the samples with the commonest number of
# threads there, and the slope of all samples is printed too. --write fills docs/reliability.md and draws
# docs/images/endurance-PART.png; draw: no run, but the lines that are there.
set -euo pipefail
cd "$(dirname "$0")/.."
here=$PWD
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
part=${1:?frames, dataset or editor}
case $part in
  frames) amount=${2:-100000} build=${3:-build/release} unit=frame bound_kb=0.6 ;;
  dataset) amount=${2:-500} build=${3:-build/release} unit=video bound_kb=20 ;;
  editor) amount=${2:-30} build=${3:-build/asan} unit=minute bound_kb=1024 ;;
  *) echo "error: no part $part; there are frames, dataset and editor" >&2; exit 64 ;;
esac
samples=$here/$build/endurance/$part.csv
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT
source bench/looped_clip.sh

# A line each second for as long as a process runs. done_so_far prints how much of the work is done.
sample() { # PROCESS
  local begin=$SECONDS resident own threads descriptors
  while read -r resident own threads < <(awk '/^VmRSS/ { r = $2 } /^RssAnon/ { o = $2 } /^Threads/ { t = $2 }
      END { if (r) print r, o, t }' "/proc/$1/status" 2>/dev/null); do
    descriptors=$(ls "/proc/$1/fd" 2>/dev/null | wc -l)
    echo "$((SECONDS - begin)),$(done_so_far),$own,$descriptors,$threads,$resident"
    sleep 1
  done >>"$samples"
}

# Runs a program to its end, sampled.
sampled() { # COMMAND...
  mkdir -p "$(dirname "$samples")"
  echo "seconds,done,own_kb,descriptors,threads,resident_kb" >"$samples"
  "$@" >"$lot/said" 2>&1 &
  local process=$!
  sample "$process"
  wait "$process" || { tail -5 "$lot/said" >&2; exit 1; }
}

run_frames() {
  small_clip
  looped "$amount"
  looped_project long "$amount" 1
  done_so_far() { { grep -oE '"done": [0-9]+' "$lot/said" || echo 0; } | tail -1 | grep -oE '[0-9]+'; }
  sampled "$here/$build/sigs" export "$lot/long.json" --out "$lot/out" --codec h264 --masks video --labels xml,coco --progress json
}

run_dataset() {
  small_clip
  cat >"$lot/recipe.json" <<JSON
{"sigs_dataset": 1, "name": "many", "seed": 1, "settings": {"export.video.codec": "h264", "export.labels": ["xml", "coco"]},
 "backgrounds": [{"name": "small", "footage": {"video": "small.mp4", "calibration": "lens.xml"},
   "camera": {"position_m": [0, 0, -150], "speed_mps": 22}}],
 "aircraft": [{"name": "light", "model": {"file": "$here/assets/models/light-aircraft/light-aircraft.obj", "forward": "+x", "up": "+z"}}],
 "videos": [{"name": "{number}", "count": $amount, "frames": 10, "first_frame": {"uniform": [0, 180]},
   "flights": [{"kind": "left_right", "distance_m": {"uniform": [80, 200]}}]}]}
JSON
  done_so_far() { find "$lot/out" -mindepth 1 -maxdepth 1 -name '0*' 2>/dev/null | wc -l; }
  sampled "$here/$build/sigs" dataset "$lot/recipe.json" --out "$lot/out" --progress none
}

# The editor, driven as in tests/editor/ui_test. Where mounts are allowed the tree is read-only for it: random input may
# save and export anywhere.
run_editor() {
  local screenshots=$here/build/release/screenshots sandbox=()
  mkdir -p "$screenshots"
  if unshare -m true 2>/dev/null; then
    sandbox=(unshare -m sh -c 'mount --bind "$1" /mnt && mount --bind "$0" "$0" && mount -o remount,bind,ro "$0" &&
      mount --bind /mnt "$1" && shift && exec "$@"' "$here" "$screenshots")
  fi
  local begin=$SECONDS
  done_so_far() { awk -v s="$((SECONDS - begin))" 'BEGIN { printf "%.3f", s / 60 }'; }
  mkdir -p "$(dirname "$samples")"
  echo "seconds,done,own_kb,descriptors,threads,resident_kb" >"$samples"
  export ASAN_OPTIONS=quarantine_size_mb=8:detect_leaks=0 SIGS_TEST_EDITOR=$here/$build/sigs-editor SIGS_TEST_MINUTES=$amount TMPDIR=$lot
  "${sandbox[@]}" build/release/test_editor_ui_test --test-case='no sequence of keys and mouse input*' >"$lot/said" 2>&1 &
  local test=$! editor=
  until editor=$(pgrep -P "$test" -x sigs-editor); do kill -0 "$test" || break; sleep 0.2; done
  [ -z "$editor" ] || sample "$editor"
  wait "$test" || { tail -40 "$lot/said" >&2; exit 1; }
  grep -E '^MESSAGE|events' "$lot/said" || true
}

# Of the last two thirds: the slope of each quantity by `done`, and where it began and ended.
report() {
  awk -F, -v part="$part" -v unit="$unit" -v bound="$bound_kb" '
    # Of column i by `done`, over the samples from `first` on with so many threads; "": all.
    function slope_of(i, threads,   k, count, x, y, xx, xy) {
      for (k = first; k <= n; ++k) {
        if (threads != "" && v[k, 5] != threads) continue
        ++count
        x += v[k, 2]; y += v[k, i]
      }
      for (k = first; k <= n; ++k) {
        if (threads != "" && v[k, 5] != threads) continue
        xx += (v[k, 2] - x / count) ^ 2
        xy += (v[k, 2] - x / count) * (v[k, i] - y / count)
      }
      return xy / xx
    }
    NR > 1 { n += 1; for (i = 1; i <= 6; ++i) v[n, i] = $i }
    END {
      for (first = 1; v[first, 2] < v[n, 2] / 3; ++first);
      m = n - first + 1
      if (m < 5) { print "error: too few samples; take a longer run" > "/dev/stderr"; exit 1 }
      span = v[n, 2] - v[first, 2]
      for (i = 2; i <= 6; ++i) {
        low[i] = high[i] = v[first, i]
        for (k = first; k <= n; ++k) {
          if (v[k, i] < low[i]) low[i] = v[k, i]
          if (v[k, i] > high[i]) high[i] = v[k, i]
        }
      }
      for (i = 3; i <= 5; ++i) slope[i] = slope_of(i, "")
      slope_of_all = slope[3]
      if (part == "editor") {
        for (k = first; k <= n; ++k) if (++samples[v[k, 5]] > samples[usual]) usual = v[k, 5]
        slope[3] = slope_of(3, usual)
        printf "%d of %d samples with %d threads; slope of all samples %.0f kB a minute\n\n", samples[usual], m, usual, slope_of_all
      }
      is_level = slope[3] <= bound && slope[4] * span <= 5 && slope[5] * span <= 5
      printf "| %ss | run, s | resident, MB | own memory, MB | slope, kB a %s | bound | descriptors | slope over the two thirds | threads | slope over the two thirds | level |\n|---|---|---|---|---|---|---|---|---|---|---|\n", unit, unit
      printf "| %.0f | %d | %.0f to %.0f | %.0f to %.0f | %.3f | %g | %d to %d | %.2f | %d to %d | %.2f | %s |\n", v[n, 2], v[n, 1],
        low[6] / 1024, high[6] / 1024, low[3] / 1024, high[3] / 1024, slope[3], bound, low[4], high[4], slope[4] * span, low[5], high[5], slope[5] * span,
        is_level ? "yes" : "no"
      exit !is_level
    }' "$samples"
}

[ "$amount" = draw ] || "run_$part"
failed=
report >"$lot/table" || failed=1
cat "$lot/table"
if [ -n "$write" ]; then
  bench/fill.sh docs/reliability.md "$part" "$lot/table"
  "$here/$build/bench_plots" endurance "$samples" "docs/images/endurance-$part.png"
fi
[ -z "$failed" ] || { echo "error: something rises by more than its bound" >&2; exit 1; }
