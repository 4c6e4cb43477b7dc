# The look of every plot of docs/research/accuracy.md: an opaque light card, which reads on a light page and on a dark one.
set terminal pngcairo enhanced size width, height font "DejaVu Sans,11" background rgb "#fcfcfa" linewidth 1.4
set datafile separator ","
ink = "#30363d"
set border 3 linecolor rgb "#8c959f" linewidth 0.8
set tics nomirror textcolor rgb ink scale 0.6
set grid xtics ytics linecolor rgb "#c9d1d9" linewidth 0.6, linecolor rgb "#c9d1d9" linewidth 0.6
set key textcolor rgb ink samplen 2 spacing 1.15 Left reverse
set format x "10^{%T}"
set format y "10^{%T}"
direct4 = "#0969da"
direct1 = "#6cb6ff"
classic = "#cf5b00"
plain = "#8250df"
green = "#1a7f37"
grey = "#8c959f"
# Six distinguishable colours for lenses.
array hues[6] = ["#0969da", "#cf5b00", "#1a7f37", "#8250df", "#bf3989", "#9a6700"]

# A legend above several panels: its entry number n stands at x (of the image's width).
legend(n, x, text, pt, color) = sprintf( \
  "set label %d \"%s\" at screen %f, 0.965 left textcolor rgb ink font ',12' point pt %d ps 1.5 lc rgb \"%s\" offset 1, 0", \
  n, text, x, pt, color)
