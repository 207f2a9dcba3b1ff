# Figure 10 of Oliveira and Brauwers 2007: gnuplot -e "rows='out/image_space.csv'; page='docs/image_space_rates.svg'" pipelines/image_space.gp
# SPDX-License-Identifier: GPL-3.0-or-later
set datafile separator ","
set grid xtics ytics lt 1 lc rgb "#cccccc"
set xlabel "triangles"
set ylabel "frames a second"
set xrange [0:*]
set yrange [0:*]
set format x "%'.0f"
set terminal svg size 760,420 font "Sans,12" background rgb "white"
set output page
plot rows using 1:2 with linespoints pt 7 lw 2 lc rgb "#c0392b" title "dir", \
     rows using 1:3 with linespoints pt 7 lw 2 lc rgb "#2980b9" title "isr", \
     rows using 1:4 with linespoints pt 7 lw 2 lc rgb "#888888" title "sir"
