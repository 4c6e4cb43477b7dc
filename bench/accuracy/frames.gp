# Error against run time, a panel a scene. Needs: folder (of the tables), image.
width = 1680; height = 1240
load style
set output image
rows_of(scene, method, samples) = sprintf( \
  "< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $4 == %d' %s/frames.csv", scene, method, samples, folder)
floor_of(scene) = real(system(sprintf( \
  "awk -F, '$1 == \"%s\" && $2 == \"rounded\" { print $5 }' %s/frames.csv", scene, folder)))
scenes = system(sprintf("awk -F, 'NR > 1 { print $1 }' %s/scenes.csv", folder))
title_of(scene) = system(sprintf("awk -F, '$1 == \"%s\" { print $2 }' %s/scenes.csv", scene, folder))

default_k = int(system(sprintf("awk -F, 'NR == 2 { print $1 }' %s/machine.csv", folder)))
default_m = int(system(sprintf("awk -F, 'NR == 2 { print $2 }' %s/machine.csv", folder)))
default_of(scene) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"direct\" && $3 == %d && $4 == %d' %s/frames.csv", \
  scene, default_k, default_m, folder)

set logscale xy
set xrange [1:600]
set yrange [0.008:60]
set xtics ("1" 1, "3" 3, "10" 10, "30" 30, "100" 100, "300" 300)
set ytics ("0.01" 0.01, "0.1" 0.1, "1" 1, "10" 10)
set lmargin 7; set rmargin 1.5; set bmargin 2.6; set tmargin 2.2
unset key
eval legend(1, 0.05, "plain", 5, plain)
eval legend(2, 0.13, "classic", 9, classic)
eval legend(3, 0.22, "direct, 1 sample a pixel", 6, direct1)
eval legend(4, 0.41, "direct, 4 samples a pixel", 7, direct4)
set label 5 "Numbers: supersampling.   Ring: the default.   Dotted: the truth, rounded to 8 bits." \
  at screen 0.60, 0.965 left textcolor rgb ink font ",12"
set multiplot layout 3, 4 margins 0.045, 0.99, 0.075, 0.915 spacing 0.032, 0.075
do for [i = 1:words(scenes)] {
  scene = word(scenes, i)
  set title title_of(scene) textcolor rgb ink font ",11.5" offset 0, -0.4
  set xlabel (i > 8 ? "ms a frame: drawing and compositing" : "") textcolor rgb ink offset 0, 0.4
  set ylabel (i % 4 == 1 ? "RMSE, code values" : "") textcolor rgb ink offset 1.2, 0
  plot rows_of(scene, "plain", 4) using 13:5 with points pt 5 ps 1.1 lc rgb plain, \
    rows_of(scene, "classic", 4) using 13:5 with linespoints pt 9 ps 1.2 lc rgb classic, \
    rows_of(scene, "direct", 1) using 13:5 with linespoints pt 6 ps 1.1 lc rgb direct1, \
    rows_of(scene, "direct", 4) using 13:5 with linespoints pt 7 ps 1.1 lc rgb direct4, \
    rows_of(scene, "direct", 4) using 13:5:(sprintf("%d", $3)) with labels offset 0.2, 0.9 font ",9" tc rgb direct4, \
    rows_of(scene, "direct", 1) using 13:5:(sprintf("%d", $3)) with labels offset -0.2, -0.9 font ",9" tc rgb direct1, \
    default_of(scene) using 13:5 with points pt 6 ps 2.3 lc rgb ink, \
    floor_of(scene) with lines dt 3 lc rgb grey
  unset label  # else each panel would draw the legend again
}
unset multiplot
