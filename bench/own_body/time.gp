# The mask's error by run time, and the run time by that of decoding alone. Needs: folder (of the tables), image.
width = 1300; height = 520
load style
set output image
rows_of(condition) = sprintf("< awk -F, 'NR > 1 && %s' %s/time.csv", condition, folder)
by_frames(method) = rows_of(sprintf("$1 == \"%s\" && $3 == 1 && $4 == 0", method))
most = int(system(sprintf("awk -F, 'NR > 1 && $2 > most { most = $2 } END { print most }' %s/time.csv", folder)))
by_every = rows_of(sprintf("$1 == \"stable\" && $4 == 0 && $2 == %d", most))
settled = rows_of("$1 == \"stable\" && $4 > 0")
error(iou) = iou >= 1 ? 1e-4 : 1 - iou

set logscale xy
set multiplot layout 1, 2 margins 0.06, 0.99, 0.13, 0.9 spacing 0.075, 0
set title "what is wrong of the mask" textcolor rgb ink
set xlabel "seconds, from the opened file to the mask" textcolor rgb ink
set ylabel "1 - intersection over union" textcolor rgb ink
set xrange [*:*]
set yrange [0.001:1.5]
set format x "%g"
set format y "%g"
set key left bottom
plot by_frames("paper") using 9:(error($7)) with linespoints pt 9 ps 1.2 lc rgb classic title "paper, by frames", \
  by_frames("stable") using 9:(error($7)) with linespoints pt 7 ps 1.2 lc rgb direct4 title "stable, by frames", \
  by_frames("stable") using 9:(error($7)):(sprintf("%d", $2)) with labels offset 0.4, 0.9 font ",9" tc rgb direct4 notitle, \
  by_every using 9:(error($7)) with linespoints pt 6 ps 1.2 lc rgb direct1 title "stable, every 1 to 16", \
  by_every using 9:(error($7)):($3 > 1 ? sprintf("/%d", $3) : "") with labels offset 0.4, -0.9 font ",9" tc rgb direct1 notitle, \
  settled using 9:(error($7)) with points pt 4 ps 1.6 lc rgb plain title "stable, stopped early", \
  settled using 9:(error($7)):(sprintf("%g %%", $4)) with labels offset -0.4, 0.9 font ",9" tc rgb plain notitle
unset logscale y
set title "beside decoding the same frames and nothing else" textcolor rgb ink
set xlabel "frames" textcolor rgb ink
set ylabel "seconds by decoding's seconds" textcolor rgb ink
set xrange [40:2000]
set xtics (50, 100, 200, 400, 800, 1500)
set yrange [0:*]
set key right bottom
plot by_frames("paper") using 2:11 with linespoints pt 9 ps 1.2 lc rgb classic title "paper", \
  by_frames("stable") using 2:11 with linespoints pt 7 ps 1.2 lc rgb direct4 title "stable", \
  by_frames("stable") using 2:12 with linespoints pt 6 ps 1.2 lc rgb direct1 title "stable, processor time", \
  1.3 with lines dt 3 lc rgb grey title "1.3: the goal"
unset multiplot
