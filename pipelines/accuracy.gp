# Plots of `make accuracy`: gnuplot -e "work='out/accuracy'; docs='docs/accuracy'" pipelines/accuracy.gp
# SPDX-License-Identifier: GPL-3.0-or-later
set datafile separator ","
set encoding utf8
set grid xtics ytics lt 1 lc rgb "#cccccc"
set autoscale xfix
set offsets graph 0.04, graph 0.12, graph 0.04, graph 0.04
set key bottom left
set logscale xy
set format y "10^{%L}"

# Every plot is drawn for the page, and as SVG and PNG beside the rows.
plots = "rays sharp photons voxels steps"
do for [plot in plots] {
    do for [kind in "page svg png"] {
        if (kind eq "png") {
            set terminal pngcairo size 1100,750 font "Sans,11"
            set output work."/".plot.".png"
        } else {
            set terminal svg size 760,520 font "Sans,12" background rgb "white"
            set output (kind eq "page" ? docs : work)."/".plot.".svg"
        }
        if (plot eq "rays") {
            set xlabel "time of the view pass, sources' scheme = 1"
            set ylabel "rms error of exits, sources' scheme = 1"
            set format x "%g"
            set xtics (0.25, 0.5, 1, 2, 4, 8, 16, 32, 64)
            set key top right
            plot work."/rays.csv" skip 1 using 2:3 with points pt 7 ps 0.5 lc rgb "#888888" \
                     title "settings", \
                 work."/front.csv" skip 1 using 2:3 with linespoints pt 7 lw 2 lc rgb "#c0392b" \
                     title "nothing is better in both", \
                 work."/front.csv" skip 1 using 2:3:1 with labels left rotate by 25 \
                     offset 0.6,0.3 font ",9" notitle, \
                 work."/rays.csv" every ::1::1 using 2:3:1 with labels left offset 0.8,0 \
                     font ",9" notitle
            set xtics auto
        }
        if (plot eq "sharp") {
            set xlabel "time of the view pass [ms]"
            set ylabel "rms error of directions at half the radius [degree]"
            set format x "%g"
            stats work."/sharp.csv" using 1:2 nooutput
            set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
            half = STATS_blocks/2 # blurred, then sharp, in as many sizes
            plot for [i=0:STATS_blocks-1] work."/sharp.csv" index i using 1:2 \
                     with points pt (i < half ? 6 : 7) lc i%half+1 lw 2 title columnheader(1)
            set xtics auto
        }
        if (plot eq "photons") {
            set xlabel "device time [ms]"
            set ylabel "relative rms error of the fluence"
            set format x "%g"
            stats work."/photons.csv" using 1:2 nooutput
            plot for [i=0:STATS_blocks-1] work."/photons.csv" index i skip 0 using 2:3 \
                     with linespoints pt 7 lw 2 title columnheader(1)
        }
        if (plot eq "voxels") {
            set xlabel "voxels along an edge"
            set ylabel "rms error of exits [1/128 of the box]"
            set format x "%g"
            set xtics (16, 32, 64, 128, 256)
            plot for [i=2:5] work."/voxels.csv" using 1:i with linespoints pt 7 lw 2 \
                     title columnheader(i)
            set xtics auto
        }
        if (plot eq "steps") {
            set xlabel "step [voxel]"
            set ylabel "rms error of exits from those of short steps [voxel]"
            set format x "%g"
            set key bottom right
            set xtics (0.25, 0.5, 1, 2, 4, 8, 16)
            stats work."/steps.csv" skip 1 nooutput
            plot for [i=2:STATS_columns] work."/steps.csv" using 1:i with linespoints pt 7 lw 2 \
                     title columnheader(i)
            set xtics auto
            set key bottom left
        }
        set output
    }
}
