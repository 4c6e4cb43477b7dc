# The summary of `sigs evaluate track` as a table of Markdown.
NR == 1 {
  for (i = 1; i <= NF; ++i) column[$i] = i
  print "| tracker | CLE mean px | CLE median px | CLE 95 % px | X mean px | Y mean px | precision @20 px | success AUC | normalised precision AUC | frames lost | frames scored |"
  print "|---|---|---|---|---|---|---|---|---|---|---|"
  next
}
# No mean where fewer than half of the frames have a report.
function pixels(name) {
  return $column[name] == "" || 2 * $column["reported_frames"] < $column["scored_frames"] ? "-" : sprintf("%.1f", $column[name])
}
function share(name) { return sprintf("%.3f", $column[name]) }
{
  printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %d | %d |\n", $1, pixels("mean_center_error_px"),
    pixels("median_center_error_px"), pixels("p95_center_error_px"), pixels("mean_x_error_px"), pixels("mean_y_error_px"),
    share("precision_at_20_px"), share("success_auc"), share("normalized_precision_auc"), $column["lost_frames"],
    $column["scored_frames"]
}
