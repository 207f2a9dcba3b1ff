# A front's cuts, coloured by the logarithm of their irradiance: gnuplot -e "cut='...'; picture='...'"
# SPDX-License-Identifier: GPL-3.0-or-later
set terminal pngcairo size 720,1000 background rgb "black" fontscale 0.8
set output picture
set size ratio -1
unset key
unset border
unset tics
set xrange [-42:42]
set yrange [-3:123]
set cbrange [-1:1.2]
set palette defined (0 "#102040", 0.4 "#3060c0", 0.6 "#ffffff", 1 "#ff8020")
set cblabel "log_{10} irradiance [W/m^2]" textcolor rgb "white"
set cbtics textcolor rgb "white"
plot cut using 1:2:($3 > 0 ? log10($3) : -1) with points pointtype 7 pointsize 0.12 linecolor palette
