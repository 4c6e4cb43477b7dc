# Milliseconds by the intruder's size, and how many times faster. Needs: folder, image.
width = 1400; height = 520
load style
set output image
sizes = folder."/sizes.csv"
set logscale xy
set xrange [0.8:500]
set xtics ("1" 1, "3" 3, "10" 10, "30" 30, "100" 100, "300" 300)
set xlabel "size of the intruder, px" textcolor rgb ink
set multiplot layout 1, 2 margins 0.055, 0.985, 0.13, 0.9 spacing 0.075, 0
set title "time of a frame of 1280 x 960" textcolor rgb ink
set ylabel "ms a frame" textcolor rgb ink offset 1, 0
set yrange [0.1:1000]
set ytics ("0.1" 0.1, "1" 1, "10" 10, "100" 100, "1000" 1000)
set key top left at graph 0.03, 0.98
plot sizes using 1:6 with linespoints pt 9 ps 1.3 lc rgb classic title "classic", \
  sizes using 1:5 with linespoints pt 7 ps 1.2 lc rgb direct4 title "direct", \
  sizes using 1:3 with lines dt 2 lc rgb direct4 title "   of it drawing (OpenGL)", \
  sizes using 1:4 with lines dt 4 lc rgb green title "   of it compositing"
set title "classic's time over direct's" textcolor rgb ink
set ylabel "times" textcolor rgb ink
set yrange [1:300]
set ytics ("1" 1, "3" 3, "10" 10, "20" 20, "30" 30, "100" 100, "300" 300)
unset key
set label 1 "dotted: 20 times, wanted up to 100 px" at 0.95, 200 textcolor rgb grey font ",10"
plot sizes using 1:7 with linespoints pt 7 ps 1.2 lc rgb direct4 notitle, \
  20 with lines dt 3 lc rgb grey notitle
unset multiplot
