# Checks the statements of docs/accuracy.md and docs/research/accuracy.md against the tables: prints each one that the figures no longer support.
#   awk -F, -f claims.awk machine.csv frames.csv chroma.csv sizes.csv tolerance.csv lens.csv lens_table.csv spline.csv condition.csv
function claim(holds, text) { if (!holds) { print "no longer so: " text; broken = 1 } }
FNR == 1 { next }
FILENAME ~ /machine/ { ss = $1; m = $2; tolerance = $3 }
FILENAME ~ /frames/ && ($2 == "plain" || $2 == "classic" || $2 == "direct") {
  scenes[$1] = 1
  rmse[$1, $2, $3, $4] = $5; p999[$1, $2, $3, $4] = $6; max[$1, $2, $3, $4] = $7; cpu[$1, $2, $3, $4] = $14
}
FILENAME ~ /tolerance/ && $2 == 0 { exact[$1] = $3 }
FILENAME ~ /tolerance/ { claim($3 < 1.01 * exact[$1], $1 ": tabulated rays leave the error as it is") }
FILENAME ~ /tolerance/ && $2 == tolerance { claim($4 <= 1, $1 ": tabulated rays move no sample by more than one code") }
FILENAME ~ /lens.csv/ && $2 == "Lens::ray" { claim($6 < 1e-9, $1 ": Lens::ray is exact") }
FILENAME ~ /lens_table/ && $2 == tolerance { claim($9 <= tolerance, $1 ": no tabulated ray misses by more than the tolerance") }
FILENAME ~ /spline/ { claim($6 < 1e-9 && $7 < 1e-14 && $8 < 1e-12, $1 " waypoints: flights are exact") }
FILENAME ~ /condition/ { claim($2 < 3.001 && $5 < 1e-11, "ratio " $1 ": the condition stays 3") }
FILENAME ~ /chroma/ {
  claim($7 < 1.02 * $6, $1 ", chroma " $2 ": weights of the site are no worse than blocks")
  claim($7 < 1.15 * $8, $1 ", chroma " $2 ": what is left in chroma is hardly more than rounding")
}
END {
  for (s in scenes) {
    for (samples = 1; samples <= 4; samples += 3)
      for (k = 1; k <= 4; k++) {
        claim(rmse[s, "direct", k, samples] < rmse[s, "classic", k, samples],
          s ", supersampling " k ", samples " samples ": direct has less error than classic")
        claim(cpu[s, "direct", k, samples] < cpu[s, "classic", k, samples],
          s ", supersampling " k ", samples " samples ": direct takes less work than classic")
      }
    claim(p999[s, "direct", ss, m] < p999[s, "classic", ss, m] && max[s, "direct", ss, m] < max[s, "classic", ss, m],
      s ": direct is better than classic in 99.9 % and largest error")
    claim(rmse[s, "direct", ss, m] < rmse[s, "plain", ss, m], s ": direct is better than plain")
    small = s ~ /^(mid|far|speck)/  # rendered finer than requested
    claim(small || rmse[s, "direct", 3, m] < 0.7 * rmse[s, "direct", 1, m], s ": from 1 to 3 the error falls by a third or more")
    nearness = small ? 1.9 : s == "border" ? 1.3 : 1.15  # with four samples at 2 across the border: a fifth nearer
    claim(rmse[s, "direct", 3, 1] < nearness * rmse[s, "direct", 2, 4] &&
      cpu[s, "direct", 3, 1] < 0.8 * cpu[s, "direct", 2, 4],
      s ": one sample at supersampling 3 is as near as four at 2, small ones within a factor of two, for less")
  }
  exit broken
}
