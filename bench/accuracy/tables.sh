# The tables of docs/research/accuracy.md from the benches' own. Sourced by accuracy.sh; each function prints one, as Markdown.
# folder: where the CSV files are.

# For awk: the defaults, as machine.csv has them; two significant digits, without exponents where possible; "none" where the method shows nothing.
number_awk='
  function n(x) {
    if (x == "" || x ~ /nan/) return "none"
    if (x == 0) return "0"
    size = x < 0 ? -x : x
    if (size >= 100) return sprintf("%.0f", x)
    if (size >= 10) return sprintf("%.1f", x)
    if (size >= 1) return sprintf("%.2f", x)
    if (size >= 0.001) return sprintf("%.2g", x)
    return sprintf("%.0e", x)
  }
  FILENAME ~ /machine/ && FNR == 2 { supersampling = $1; samples = $2; tolerance = $3 }
  FILENAME ~ /machine/ { next }
  function row(text) { print "| " text " |" }
'

table_machine() {
  local renderer
  renderer=$(awk -F'"' 'NR == 2 { print $2 }' "$folder/machine.csv")
  echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) processors; OpenGL: $renderer."
}

# One row a scene: the three methods at their defaults.
table_defaults() {
  awk -F, "$number_awk"'
    FNR == 1 { next }
    FILENAME ~ /scenes/ { order[++count] = $1; title[$1] = $2; sigma[$1] = $4; next }
    $2 == "rounded" || $2 == "truth" { rmse[$1, $2] = $5 }
    $3 == supersampling && $4 == samples { rmse[$1, $2] = $5; p[$1, $2] = $6; max[$1, $2] = $7; ms[$1, $2] = $13 }
    END {
      row("scene | sigma, px | RMSE plain | classic | **direct** | rounding alone | truth alone | 99.9 % classic | **direct** | max classic | **direct** | ms classic | **direct**")
      print "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; i++) {
        s = order[i]
        row(title[s] " | " n(sigma[s]) " | " n(rmse[s, "plain"]) " | " n(rmse[s, "classic"]) " | **" n(rmse[s, "direct"]) "** | " \
          n(rmse[s, "rounded"]) " | " n(rmse[s, "truth"]) " | " n(p[s, "classic"]) " | **" n(p[s, "direct"]) "** | " \
          n(max[s, "classic"]) " | **" n(max[s, "direct"]) "** | " n(ms[s, "classic"]) " | **" n(ms[s, "direct"]) "**")
      }
    }' "$folder/machine.csv" "$folder/scenes.csv" "$folder/frames.csv"
}

table_shapes() {
  awk -F, "$number_awk"'
    FNR == 1 { next }
    FILENAME ~ /scenes/ { order[++count] = $1; title[$1] = $2; next }
    $3 == supersampling && $4 == samples { box[$1, $2] = $8; centroid[$1, $2] = $9; area[$1, $2] = $10 }
    END {
      row("scene | box, px: plain | **direct** | centroid, px: plain | classic | **direct** | area, %: plain | classic | **direct**")
      print "|---|---|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; i++) {
        s = order[i]
        row(title[s] " | " n(box[s, "plain"]) " | **" n(box[s, "direct"]) "** | " n(centroid[s, "plain"]) " | " \
          n(centroid[s, "classic"]) " | **" n(centroid[s, "direct"]) "** | " n(area[s, "plain"]) " | " \
          n(area[s, "classic"]) " | **" n(area[s, "direct"]) "**")
      }
    }' "$folder/machine.csv" "$folder/scenes.csv" "$folder/frames.csv"
}

# direct at every setting: RMSE, and milliseconds.
table_settings() {
  awk -F, "$number_awk"'
    FNR == 1 { next }
    FILENAME ~ /scenes/ { order[++count] = $1; title[$1] = $2; next }
    $2 == "direct" { cell[$1, $4, $3] = n($5) " / " n($13) " / " n($14) }
    END {
      row("scene | 1 sample: 1 | 2 | 3 | 4 | 4 samples: 1 | 2 | 3 | 4")
      print "|---|---|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; i++) {
        s = order[i]
        line = title[s]
        for (m = 1; m <= 4; m += 3)
          for (k = 1; k <= 4; k++)
            line = line " | " (m == samples && k == supersampling ? "**" cell[s, m, k] "**" : cell[s, m, k])
        row(line)
      }
    }' "$folder/machine.csv" "$folder/scenes.csv" "$folder/frames.csv"
}

table_sizes() {
  awk -F, "$number_awk"'
    FNR == 1 { row("size, px | sigma, px | direct: drawing | compositing | **ms a frame** | classic: ms a frame | **times faster** | CPU ms direct | classic"); print "|---|---|---|---|---|---|---|---|---|"; next }
    { row($1 " | " n($2) " | " n($3) " | " n($4) " | **" n($5) "** | " n($6) " | **" n($7) "** | " n($8) " | " n($9)) }
  ' "$folder/sizes.csv"
}

table_lens() {
  awk -F, "$number_awk"'
    FNR == 1 { next }
    !($1 in seen) { seen[$1] = 1; order[++count] = $1; points[$1] = $3 }
    { cell[$1, $2] = n($5) ", " n($6) ", " n($7); names[$2] = 1 }
    END {
      row("lens | points | **`Lens::ray`** | OpenCV 5 | OpenCV 20 | OpenCV 100 | OpenCV up to 100, until 1e-12")
      print "|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; i++) {
        l = order[i]
        row(l " | " points[l] " | **" cell[l, "Lens::ray"] "** | " cell[l, "OpenCV 5"] " | " cell[l, "OpenCV 20"] " | " \
          cell[l, "OpenCV 100"] " | " cell[l, "OpenCV 100 or 1e-12"])
      }
    }' "$folder/lens.csv"
}

table_lens_table() {
  awk -F, "$number_awk"'
    FNR == 1 { next }
    !($1 in seen) { seen[$1] = 1; order[++count] = $1 }
    { cell[$1, $2 + 0] = n($9) ", " n($6) ", " n($3) }
    END {
      row("lens | exact | 1e-6 px | 1e-4 px | **1e-3 px** | 1e-2 px | 0.1 px")
      print "|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; i++) {
        l = order[i]
        row(l " | " cell[l, 0] " | " cell[l, 1e-6] " | " cell[l, 1e-4] " | **" cell[l, 1e-3] "** | " cell[l, 1e-2] " | " cell[l, 0.1])
      }
    }' "$folder/lens_table.csv"
}

table_tolerance() {
  awk -F, "$number_awk"'
    FNR == 1 { row("scene | tolerance, px | RMSE against the truth | largest step from exact rays, code values | compositing, ms | first frame, ms"); print "|---|---|---|---|---|---|"; next }
    { row($1 " | " ($2 == 0 ? "exact" : $2) " | " n($3) " | " n($4) " | " n($5) " | " n($6)) }
  ' "$folder/tolerance.csv"
}

table_spline() {
  awk -F, "$number_awk"'
    FNR == 1 { row("waypoints | long legs over short | making the flight, ms | one position, ns | one pose, ns | position, m | nose, rad | wings, rad"); print "|---|---|---|---|---|---|---|---|"; next }
    { row($1 " | " $2 " | " n($3) " | " n($4) " | " n($5) " | " n($6) " | " n($7) " | " n($8)) }
  ' "$folder/spline.csv"
}

table_condition() {
  awk -F, "$number_awk"'
    FNR == 1 { row("long legs over short | rows as in textbooks | rows as solved here | the curve itself | position, m"); print "|---|---|---|---|---|"; next }
    { row($1 " | " n($3) " | " n($2) " | " n($4) " | " n($5)) }
  ' "$folder/condition.csv"
}

table_chroma() {
  awk -F, "$number_awk"'
    FNR == 1 { row("scene | chroma lies | RMSE of chroma: by blocks | **by site** | rounding alone | largest: by blocks | **by site** | RMSE of luma: by blocks | **by site**"); print "|---|---|---|---|---|---|---|---|---|"; next }
    { row($1 " | " $2 " | " n($6) " | **" n($7) "** | " n($8) " | " n($9) " | **" n($10) "** | " n($3) " | **" n($4) "**") }
  ' "$folder/chroma.csv"
}

# with_tables PAGE: the page with the text between <!-- table: NAME --> and <!-- end --> replaced.
with_tables() {
  local line name=
  while IFS= read -r line; do
    [ -n "$name" ] || printf '%s\n' "$line"
    if [[ $line =~ ^'<!-- table: '([a-z_]+)' -->'$ ]]; then
      name=${BASH_REMATCH[1]}
      "table_$name"
    elif [ "$line" = '<!-- end -->' ]; then
      [ -z "$name" ] || printf '%s\n' "$line"
      name=
    fi
  done <"$1"
}
