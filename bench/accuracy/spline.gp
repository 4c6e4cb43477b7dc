# Flights: time and error by the number of waypoints, condition by the legs' ratio. Needs: folder, image.
width = 1500; height = 520
load style
set output image
rows_of(ratio) = sprintf("< awk -F, '$2 == %d' %s/spline.csv", ratio, folder)
set logscale xy
set multiplot layout 1, 3 margins 0.055, 0.99, 0.13, 0.9 spacing 0.06, 0
set xlabel "waypoints" textcolor rgb ink
set xrange [7:15000]
set xtics ("10" 10, "100" 100, "1000" 1000, "10^4" 1e4)
set key left top
set title "time" textcolor rgb ink
set yrange [1e-9:10]
set ytics ("1 ns" 1e-9, "10 ns" 1e-8, "100 ns" 1e-7, "1 {/Symbol m}s" 1e-6, "10 {/Symbol m}s" 1e-5, "0.1 ms" 1e-4, "1 ms" 1e-3, "10 ms" 1e-2, "0.1 s" 0.1, "1 s" 1)
plot rows_of(1) using 1:($3 * 1e-3) with linespoints pt 7 ps 1.2 lc rgb classic title "making the flight", \
  rows_of(1) using 1:($5 * 1e-9) with linespoints pt 7 ps 1.2 lc rgb direct4 title "one pose", \
  rows_of(1) using 1:($4 * 1e-9) with linespoints pt 7 ps 1.2 lc rgb direct1 title "one position"
set title "largest error, against long double" textcolor rgb ink
set yrange [1e-17:1e-8]
set ytics 1e-18, 100, 1e-4
set format y "10^{%T}"
plot rows_of(1) using 1:6 with linespoints pt 7 ps 1.2 lc rgb direct4 title "position, m; even legs", \
  rows_of(1000) using 1:6 with linespoints pt 6 ps 1.2 lc rgb direct1 title "position, m; every other leg 1000 times shorter", \
  rows_of(1) using 1:7 with linespoints pt 9 ps 1.2 lc rgb classic title "nose, rad; even legs", \
  rows_of(1000) using 1:7 with linespoints pt 8 ps 1.2 lc rgb plain title "nose, rad; 1000 times shorter"
set title "condition numbers" textcolor rgb ink
set xlabel "long legs over short legs" textcolor rgb ink
set xrange [0.7:1.5e5]
set xtics ("1" 1, "10" 10, "100" 100, "10^3" 1e3, "10^4" 1e4, "10^5" 1e5)
set yrange [1:1e6]
set ytics ("1" 1, "10" 10, "100" 100, "10^3" 1e3, "10^4" 1e4, "10^5" 1e5, "10^6" 1e6)
condition = folder."/condition.csv"
plot condition using 1:3 with linespoints pt 9 ps 1.2 lc rgb classic title "rows as in textbooks", \
  condition using 1:2 with linespoints pt 7 ps 1.2 lc rgb direct4 title "rows as solved here", \
  condition using 1:4 with linespoints pt 5 ps 1.1 lc rgb green title "the curve itself, by its waypoints"
unset multiplot
