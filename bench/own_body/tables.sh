# The tables of docs/research/own-body.md from the bench's own. Sourced by own_body.sh; each function prints one, as Markdown.
# folder: where the CSV files are.

table_machine() {
  echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | sed -n 1p), $(nproc) processors."
}

# The result of a method, in a cell: agreement, or its statement.
cell_awk='
  function cell(iou, told, said) {
    if (told == "no") return said == "cannot tell" ? "says so" : "a mask"
    return said == "cannot tell" ? "cannot tell" : sprintf("%.3f", iou)
  }'

# TABLE: of synthetic flights
table_of_flights() {
  awk -F, "$cell_awk"'
    FNR == 1 { print "| flight | size | own body, % | `paper` | **`stable`** | `stable` masks, % |"; print "|---|---|---|---|---|---|"; next }
    # A flight may have a comma in its name; the fields behind it are counted from the end.
    { name = $1; for (i = 2; i <= NF - 8; i++) name = name "," $i
      key = name " | " $(NF - 7) " x " $(NF - 6); if (!(key in seen)) { seen[key] = 1; order[++count] = key }
      truth[key] = $(NF - 1) == "no" ? "" : sprintf("%.1f", $(NF - 3))
      value[key, $(NF - 5)] = cell($(NF - 4), $(NF - 1), $NF)
      found[key, $(NF - 5)] = $NF == "cannot tell" ? "" : sprintf("%.1f", $(NF - 2)) }
    END {
      for (i = 1; i <= count; i++) {
        k = order[i]
        print "| " k " | " truth[k] " | " value[k, "paper"] " | **" value[k, "stable"] "** | " found[k, "stable"] " |"
      }
    }' "$folder/$1.csv"
}

table_flights() { table_of_flights flights; }
table_limits() { table_of_flights limits; }

table_time() {
  awk -F, '
    FNR == 1 { print "| method | frames | `every` | `settled_percent` | frames used | IoU | IoU with all frames | s | processor s | by decoding alone | processor, by decoding alone |"
               print "|---|---|---|---|---|---|---|---|---|---|---|"; next }
    { printf "| `%s` | %d | %d | %s | %d | %.3f | %s | %.2f | %.2f | **%.2f** | %.2f |\n", $1, $2, $3, $4 == 0 ? "off" : $4, $6, $7,
        $1 == "stable" ? sprintf("%.3f", $8) : "", $9, $10, $11, $12 }
  ' "$folder/time.csv"
}

# Savings and cost of stopping early.
table_early() {
  awk -F, '
    FNR == 1 { print "| flight | frames used | IoU | IoU with all frames | s | s with all frames |"; print "|---|---|---|---|---|---|"; next }
    { printf "| %s | %d of %d | %.4f | %.4f | %.2f | %.2f |\n", $1, $3, $4, $5, $6, $7, $8; early += $7; all += $8; used += $3; of += $4
      if ($6 - $5 > cost) cost = $6 - $5 }
    END { printf "| all | %.0f %% | at most %.4f less | | %.1f | %.1f |\n", 100 * used / of, cost, early, all }
  ' "$folder/early.csv"
}

table_real() {
  awk -F, '
    function cell(iou, percent, truth, said) {
      if (said == "cannot tell") return truth == "still" ? "says that nothing moves" : "cannot tell"
      if (truth == "none") return percent == 0 ? "nothing, rightly" : sprintf("%.1f %%, wrongly", percent)
      if (truth == "still") return sprintf("%.1f %%, wrongly", percent)
      return sprintf("%.1f %%", percent) (truth == "known" ? sprintf(", IoU %.3f", iou) : "")
    }
    FNR == 1 { print "| clip | `paper` masks | **`stable`** masks |"; print "|---|---|---|"; next }
    { if (!($1 in seen)) { seen[$1] = 1; order[++count] = $1 } value[$1, $2] = cell($3, $4, $5, $6) }
    END { for (i = 1; i <= count; i++) print "| " order[i] " | " value[order[i], "paper"] " | **" value[order[i], "stable"] "** |" }
  ' "$folder/real.csv"
}

# By the number of frames, for docs/research/accuracy.md.
table_by_frames() {
  awk -F, '
    FNR == 1 { print "| frames | `stable`: 1 - IoU | s | `paper`: 1 - IoU | s |"; print "|---|---|---|---|---|"; next }
    $3 == 1 && $4 == 0 { if (!($2 in seen)) { seen[$2] = 1; order[++count] = $2 } error[$2, $1] = 1 - $7; time[$2, $1] = $9 }
    END { for (i = 1; i <= count; i++) { n = order[i]
      printf "| %d | **%.4f** | %.2f | %.4f | %.2f |\n", n, error[n, "stable"], time[n, "stable"], error[n, "paper"], time[n, "paper"] } }
  ' "$folder/time.csv"
}

# Of the pixels of each tenth of the confidence: their share of the image, their mean confidence, and how many are body.
table_reliability() {
  awk -F, '
    NR == 1 { next }
    { all[$1] += $3; n = $1 SUBSEP $2; pixels[n] = $3; body[n] = $4; sum[n] = $5; if (!($2 in seen)) { seen[$2] = 1; from[++count] = $2 } }
    function share(n) { return pixels[n] > 0 ? sprintf("%.2f", body[n] / pixels[n]) : "" }
    function mean(n) { return pixels[n] > 0 ? sprintf("%.2f", sum[n] / pixels[n]) : "" }
    function part(set, n) { return all[set] > 0 ? sprintf("%.2f %%", 100 * pixels[n] / all[set]) : "" }
    END {
      print "| confidence | unseen: of the image | mean confidence | **truly body** | known: of the image | mean confidence | **truly body** |"
      print "|---|---|---|---|---|---|---|"
      for (i = 1; i <= count; ++i) {
        u = "unseen" SUBSEP from[i]; k = "known" SUBSEP from[i]
        printf "| %.1f to %.1f | %s | %s | **%s** | %s | %s | **%s** |\n", from[i], from[i] + 0.1, part("unseen", u), mean(u), share(u), part("known", k), mean(k), share(k)
      }
    }' "$folder/reliability.csv"
}
