#!/usr/bin/env bash
# What datasets cover: time of planning 1,000 random encounters, and the coverage of 50 videos made against their labels.
#   bench/dataset_coverage.sh [BUILD] [FRAMES]
# FRAMES of each of the 50 videos, default 8. Prints the seconds of two plans (straight encounters; flights drawn from an
# encounter model, where ../shared/data has one), the balance of random encounters and of flights by place and size, and
# how the predicted coverage, the one that sigs counts and a count of the labels by awk agree. Ends with 1 where the last
# two differ.
set -euo pipefail
cd "$(dirname "$0")/.."
sigs=$PWD/${1:-build/release}/sigs
frames=${2:-8}
assets=$PWD/assets
model=$PWD/../shared/data/encounters/models/uncor_1200only_fwse_v1p2.txt
lot=$(mktemp -d)
trap 'rm -rf "$lot"' EXIT

recipe_head() { # SEED
  cat <<EOF
"sigs_dataset": 1, "name": "set", "seed": $1,
"settings": {"export.labels": ["xml"], "export.video.codec": "h264"},
"backgrounds": [{"name": "clear", "footage": {"video": "$assets/footage/table1_clear.mp4",
                 "calibration": "$assets/calibrations/sample.xml", "own_body_mask": "$assets/footage/sample_own_body.png"},
                 "camera": {"position_m": [0, 0, -900], "attitude_deg": {"roll": 0, "pitch": 0}, "speed_mps": 22}}],
"aircraft": [{"name": "jet", "model": {"file": "$assets/models/airliner/airliner.obj"}},
             {"name": "light", "model": {"file": "$assets/models/light-aircraft/light-aircraft.obj"},
              "scale": {"uniform": [0.8, 1.2]}},
             {"name": "bird", "category": "bird", "distractor": true, "model": {"file": "$assets/models/bird/bird.obj"}}],
EOF
}
drawn='{"kind": "encounter_model", "file": "'$model'", "hmd_m": {"uniform": [-300, 300]},
  "vmd_m": {"uniform": [-100, 100]}, "bearing_deg": {"uniform": [-40, 40]}}'

TIMEFORMAT="%R s (%U s of processor time)"
planning() { # TITLE RECIPE
  local seconds
  seconds=$({ time "$sigs" dataset "$2" --dry-run >"$lot/said" 2>&1; } 2>&1)
  printf "%s: %s; %s\n" "$1" "$seconds" "$(grep -o '^[0-9]* videos, [0-9]* frames' "$lot/said")"
}
echo "{$(recipe_head 3) \"videos\": [{\"videos\": 1000, \"frames\": 100}]}" >"$lot/straight.json"
planning "1,000 random encounters" "$lot/straight.json"
if [ -r "$model" ]; then
  echo "{$(recipe_head 3) \"videos\": [{\"videos\": 1000, \"frames\": 100, \"flights\": [$drawn]}]}" >"$lot/drawn.json"
  planning "1,000 drawn from an encounter model" "$lot/drawn.json"
else
  drawn='"approaching"'
fi

# Balance: shares of the cells of the image and of the sizes, of random encounters and of flights by place and size.
shares_of() { # TITLE JSON
  awk -v title="$1" '
    /^  "(intruders|distractors)"/ { counts = $1 ~ /intruders/ }
    /"in_view":/ && counts { total = $2 + 0 }
    /^    "[a-z_]*": \[/ { gsub(/[^a-z_]/, "", $1); quantity = $1 }
    /"count":/ && counts {
      share = 100 * $2 / total
      if (quantity == "image_position") { if (least == "" || share < least) least = share; if (share > most) most = share }
      if (quantity == "size_px" && share > size) size = share
    }
    END { printf "%s: cells of the image %.1f to %.1f %%, largest bin of size %.1f %%\n", title, least, most, size }' "$2"
}
placed='{"kind": "image_position", "x_percent": {"uniform": [0, 100]}, "y_percent": {"uniform": [0, 100]},
  "size_px": {"log_uniform": [4, 256]}, "direction_deg": {"choice": [0, 180]}, "relative_speed_mps": {"uniform": [50, 120]}}'
for what in encounters placed; do
  flights=
  [ "$what" = placed ] && flights=", \"flights\": [$placed]"
  echo "{$(recipe_head 3) \"videos\": [{\"videos\": 600, \"frames\": 10$flights}]}" >"$lot/$what.json"
  "$sigs" dataset "$lot/$what.json" --dry-run --json "$lot/$what.coverage" >/dev/null 2>&1
done
shares_of "600 random encounters" "$lot/encounters.coverage"
shares_of "600 by place and size" "$lot/placed.coverage"

cat >"$lot/fifty.json" <<EOF
{$(recipe_head 8) "videos": [{"videos": 50, "frames": $frames, "first_frame": {"uniform": [0, 90]},
  "appearance": {"haze.visibility_m": {"uniform": [3000, 30000]}},
  "flights": [$drawn, "left_right", {"kind": "encounter", "miss_distance_m": {"uniform": [0, 150]},
    "bearing_deg": {"uniform": [-40, 40]}, "closing_speed_mps": {"uniform": [40, 160]}, "time_of_closest_approach_s": {"uniform": [1, 20]}}],
  "others": [{"aircraft": ["bird"], "count": {"choice": [0, 1, 2]},
              "flights": [{"kind": "right_left", "distance_m": {"uniform": [8, 60]}, "from_y_percent": {"uniform": [20, 60]}}]}]}]}
EOF
"$sigs" dataset "$lot/fifty.json" --dry-run --json "$lot/predicted.json" >"$lot/said"
"$sigs" dataset "$lot/fifty.json" --out "$lot/out" --progress none >/dev/null 2>"$lot/said" || { cat "$lot/said" >&2; exit 1; }
"$sigs" dataset "$lot/fifty.json" --out "$lot/out" --coverage --json "$lot/counted.json" >/dev/null

# GROUP QUANTITY BIN COUNT, bins from 0, of a coverage in JSON.
lines_of() {
  awk '
    /^  "(intruders|distractors)"/ { gsub(/[^a-z]/, "", $1); group = $1 }
    /^    "[a-z_]*": \[/ { gsub(/[^a-z_]/, "", $1); quantity = $1; bin = 0 }
    /"count":/ { if ($2 + 0 > 0) print group, quantity, bin, $2 + 0; bin++ }' "$1" | sort
}
# The same from the annotations, without sigs: one element a line.
cat "$lot"/out/*/*.xml | awk '
  function value(name,   rest) {
    if (!match($0, " " name "=\"[^\"]*\"")) return ""
    rest = substr($0, RSTART, RLENGTH); sub(/^[^"]*"/, "", rest); sub(/"$/, "", rest); return rest
  }
  function bin(number, limits,   n, parts, i) {
    n = split(limits, parts, " "); for (i = 1; i <= n; i++) if (number + 0 < parts[i] + 0) return i - 1; return n
  }
  function third(at, length_px,   n) { n = int(3 * (at + 0.5) / length_px); return at < 0 ? 0 : n > 2 ? 2 : n }
  function bearing(y, x) { return atan2(y, x) * 180 / 3.14159265358979323846 }
  /<footage / { width = value("width"); height = value("height") }
  /<intruder / { seen = 0; group = value("role") == "distractor" ? "distractors" : "intruders"; side = value("horizon") }
  /<position / { x = value("x_m"); y = value("y_m") }
  /<distance / { range = value("m") }
  /<box / { seen = 1 }
  /<silhouette / { size = value("width") + 0 > value("height") + 0 ? value("width") : value("height")
    column = third(value("x") + value("width") / 2, width); line = third(value("y") + value("height") / 2, height) }
  /<\/intruder>/ && seen {
    count[group " range_m " bin(range, "50 100 200 500 1000 2000 5000")]++
    count[group " size_px " bin(size, "4 8 16 32 64 128 256")]++
    count[group " bearing_deg " bin(bearing(y, x), "-60 -45 -30 -15 0 15 30 45 60")]++
    count[group " image_position " (3 * line + column)]++
    count[group " horizon " (side == "above" ? 0 : side == "on" ? 1 : side == "below" ? 2 : 3)]++
  }
  END { for (key in count) print key, count[key] }' | sort >"$lot/awk"
lines_of "$lot/counted.json" >"$lot/counted"
lines_of "$lot/predicted.json" >"$lot/predicted"
echo
diff "$lot/awk" "$lot/counted" && echo "the count by awk is the same in all $(wc -l <"$lot/awk") bins"
awk '
  { key = $1 " " $2 " " $3 }
  NR == FNR { counted[key] = $4; if ($2 == "range_m") total += $4; next }
  { predicted[key] = $4 }
  END {
    for (key in counted) all[key]; for (key in predicted) all[key]
    for (key in all) { d = predicted[key] - counted[key]; split(key, part, " "); off[part[2]] += d < 0 ? -d : d }
    printf "predicted against counted, sum of the differences of all bins, of %d in view:", total
    printf " range %d, size %d, bearing %d, image position %d, horizon %d\n", off["range_m"], off["size_px"], off["bearing_deg"], off["image_position"], off["horizon"]
  }' "$lot/counted" "$lot/predicted"
