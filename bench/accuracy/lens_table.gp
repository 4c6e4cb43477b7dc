# Tabulated rays: error against memory and against time, a curve a lens, a point a tolerance. Needs: folder, image.
width = 1500; height = 560
load style
set output image
table = folder."/lens_table.csv"
lenses = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { gsub(/ /, \"~\", $1); print $1 }' %s", table))
spaced(name) = system(sprintf("echo '%s' | tr '~' ' '", name))
rows_of(lens, which) = sprintf("< awk -F, '$1 == \"%s\" && (%s)' %s", lens, which, table)
set logscale xy
set yrange [1e-14:10]
set ytics 1e-15, 1e3, 1e6
set multiplot layout 1, 3 margins 0.055, 0.99, 0.13, 0.88 spacing 0.045, 0
unset key
do for [i = 1:6] { eval legend(i, 0.05 + 0.16 * (i - 1), spaced(word(lenses, i)), 7, hues[i]) }
set ylabel "largest error, px" textcolor rgb ink offset 1, 0
set xlabel "kB kept, whole image" textcolor rgb ink
set xrange [5:1e5]
plot for [i = 1:6] rows_of(spaced(word(lenses, i)), "1") using 6:9 with linespoints pt 6 ps 1 \
    lc rgb hues[i], \
  for [i = 1:6] rows_of(spaced(word(lenses, i)), "$2 == 0.001") using 6:9 with points pt 7 ps 1.5 lc rgb hues[i], \
  1e-3 with lines dt 3 lc rgb grey
unset label  # else each panel would draw the legend again
unset ylabel
set xlabel "ns a ray, first time" textcolor rgb ink
set xrange [3:6000]
plot for [i = 1:6] rows_of(spaced(word(lenses, i)), "1") using 3:9 with linespoints pt 6 ps 1 lc rgb hues[i], \
  for [i = 1:6] rows_of(spaced(word(lenses, i)), "$2 == 0.001") using 3:9 with points pt 7 ps 1.5 lc rgb hues[i], \
  1e-3 with lines dt 3 lc rgb grey
set xlabel "evaluations of the lens a ray" textcolor rgb ink
set xrange [0.01:2]
plot for [i = 1:6] rows_of(spaced(word(lenses, i)), "1") using 5:9 with linespoints pt 6 ps 1 lc rgb hues[i], \
  for [i = 1:6] rows_of(spaced(word(lenses, i)), "$2 == 0.001") using 5:9 with points pt 7 ps 1.5 lc rgb hues[i], \
  1e-3 with lines dt 3 lc rgb grey
unset multiplot
