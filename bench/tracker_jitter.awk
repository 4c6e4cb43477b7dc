# How much the errors of `sigs evaluate track` change from one frame to the next: root mean square, px. Of frames.csv of
# several videos, a row a tracker and video; `video` is the file's folder.
FNR == 1 {
  for (i = 1; i <= NF; ++i) column[$i] = i
  split(FILENAME, parts, "/")
  video = parts[length(parts) - 1]
  last_tracker = ""
  next
}
{
  tracker = $column["tracker"]
  x = $column["x_error_px"]
  y = $column["y_error_px"]
  if (tracker == last_tracker && x != "" && last_x != "") {
    key = tracker SUBSEP video
    x2[key] += (x - last_x) ^ 2
    y2[key] += (y - last_y) ^ 2
    ++count[key]
  }
  if (!(tracker in seen)) { seen[tracker] = 1; order[++trackers] = tracker }
  if (!(video in seen_video)) { seen_video[video] = 1; videos[++videos_counted] = video }
  last_tracker = tracker; last_x = x; last_y = y
}
function rms(sum, key) { return count[key] > 0 ? sprintf("%.2f", sqrt(sum / count[key])) : "" }
END {
  head = "| tracker |"; rule = "|---|"
  for (f = 1; f <= videos_counted; ++f) { head = head " X, " videos[f] " | Y, " videos[f] " |"; rule = rule "---|---|" }
  print head; print rule
  for (t = 1; t <= trackers; ++t) {
    row = "| " order[t] " |"
    for (f = 1; f <= videos_counted; ++f) {
      key = order[t] SUBSEP videos[f]
      row = row " " rms(x2[key], key) " | " rms(y2[key], key) " |"
    }
    print row
  }
}
