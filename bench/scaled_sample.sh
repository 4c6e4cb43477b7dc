# The lens of the sample footage for copies of it in other sizes. Sourced in the root of the tree.
#   scaled_lens WIDTH HEIGHT   prints a calibration file for the sample scaled to the width and cut to the height around
#                              its middle: pixel i of the sample lies at (i + 0.5) * scale - 0.5
scaled_lens() {
  awk -v width="$1" -v height="$2" '
    /<image_width>/ { scale = width / number(); sub(/[0-9.]+/, width) }
    /<image_height>/ { cut = (number() * scale - height) / 2; sub(/[0-9.]+/, height) }
    /<data>/ { row = 1; print; next }
    row == 1 && NF == 3 { $0 = sprintf("%.4f 0. %.4f", $1 * scale, ($3 + 0.5) * scale - 0.5); row = 2; print; next }
    row == 2 { $0 = sprintf("0. %.4f %.4f", $2 * scale, ($3 + 0.5) * scale - 0.5 - cut); row = 3 }
    { print }
    function number(text) { text = $0; gsub(/[^0-9.]/, "", text); return text }' assets/calibrations/sample.xml
}
