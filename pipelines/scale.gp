# Plots of `make scale`: gnuplot -e "work='out/scale'; page='docs/scale.svg'" pipelines/scale.gp
# SPDX-License-Identifier: GPL-3.0-or-later
set datafile separator ","
set encoding utf8
set grid xtics ytics lt 1 lc rgb "#cccccc"
set logscale xy
set format y "10^{%L}"
set offsets graph 0.06, graph 0.06, graph 0.1, graph 0.1
set key top left samplen 1.5 font ",9"
set style data linespoints
set pointsize 0.6

# Of each table: what it counts, and columns with their names.
set terminal svg size 900,980 font "Sans,11" background rgb "white"
set output page
set multiplot layout 4,2
set ylabel "ms"
set format x "%g"
set xtics (64, 128, 256, 512, 1024)
set xlabel "voxels along the longest edge"
plot work."/resolutions.csv" using 1:2 pt 7 title "mesh2vol", "" using 1:5 pt 7 title "render: prepare", \
     "" using 1:6 pt 7 title "view"
set ylabel "MB"
plot work."/resolutions.csv" using 1:4 pt 7 title "mesh2vol, host", \
     "" using 1:7 pt 7 title "render, device", "" using 1:8 pt 7 title "render, host"
set ylabel "ms"
plot work."/voxels.csv" using 1:2 pt 7 title "lightsim", "" using 1:3 pt 7 title "its photons"
set xtics auto
set format x "10^{%L}"
set xlabel "pixels"
plot work."/pixels.csv" using 1:2 pt 7 title "view", "" using 1:3 pt 7 title "write"
set xlabel "photons"
plot work."/photons.csv" using 1:2 pt 7 title "lightsim"
set format x "%g"
set xtics (1, 2, 4, 8, 16, 32, 64)
set xlabel "lights"
plot work."/lights.csv" using 1:2 pt 7 title "lightsim"
set xlabel "objects"
plot work."/objects.csv" using 1:2 pt 7 title "mesh2vol", "" using 1:4 pt 7 title "render: prepare", \
     "" using 1:5 pt 7 title "view"
set xtics auto
set format x "10^{%L}"
set xlabel "triangles"
plot work."/triangles.csv" using 1:2 pt 7 title "mesh2vol", "" using 1:3 pt 7 title "reading and checks", \
     "" using 1:4 pt 7 title "distances"
unset multiplot
