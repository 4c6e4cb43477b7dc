# From a pixel to its ray: error against time, a panel a lens. Needs: folder, image.
width = 1500; height = 860
load style
set output image
lenses = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { gsub(/ /, \"~\", $1); print $1 }' %s/lens.csv", folder))
spaced(name) = system(sprintf("echo '%s' | tr '~' ' '", name))
rows_of(lens, which) = sprintf("< awk -F, '$1 == \"%s\" && $2 ~ /%s/' %s/lens.csv", lens, which, folder)
set logscale xy
set xrange [25:6000]
set xtics ("30" 30, "100" 100, "300" 300, "1000" 1000, "3000" 3000)
set yrange [1e-15:1e5]
set ytics 1e-15, 1e3, 1e6
# An inverse that finds no ray has no error: it is drawn at the upper edge.
capped(e) = e > 3e4 ? 3e4 : e
unset key
eval legend(1, 0.06, "Lens::ray", 7, direct4)
eval legend(2, 0.19, "OpenCV: 5, 20, 100 iterations", 9, classic)
eval legend(3, 0.45, "OpenCV: up to 100, until 10^{-12}", 11, plain)
set multiplot layout 2, 3 margins 0.055, 0.99, 0.085, 0.89 spacing 0.045, 0.1
do for [i = 1:6] {
  lens = spaced(word(lenses, i))
  set title lens textcolor rgb ink offset 0, -0.3
  set xlabel (i > 3 ? "ns a point" : "") textcolor rgb ink
  set ylabel (i % 3 == 1 ? "largest error, px" : "") textcolor rgb ink offset 1, 0
  plot rows_of(lens, "OpenCV [0-9]+$") using 7:(capped($6)) with linespoints pt 9 ps 1.4 lc rgb classic, \
    rows_of(lens, "OpenCV 100 or") using 7:(capped($6)) with points pt 11 ps 1.6 lc rgb plain, \
    rows_of(lens, "Lens::ray") using 7:(capped($6)) with points pt 7 ps 1.7 lc rgb direct4
  unset label  # else each panel would draw the legend again
}
unset multiplot
