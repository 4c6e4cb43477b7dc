# Memory, descriptors and threads of one process by what it has done. Needs: samples, unit, image.
width = 1000; height = 320
load "bench/accuracy/style.gp"
set output image
set format x "%g"
set format y "%g"
set border 11
set xlabel unit textcolor rgb ink
set ylabel "memory, MB" textcolor rgb ink
set y2label "descriptors, threads" textcolor rgb ink
set y2tics textcolor rgb ink scale 0.6
set yrange [0:*]
set y2range [0:*]
set key above horizontal
plot samples using 2:($3 / 1024) every ::1 with lines lc rgb direct4 title "own memory", \
  samples using 2:($6 / 1024) every ::1 with lines lc rgb grey title "resident, with files and libraries", \
  samples using 2:4 every ::1 axes x1y2 with lines lc rgb classic title "descriptors", \
  samples using 2:5 every ::1 axes x1y2 with lines lc rgb green title "threads"
