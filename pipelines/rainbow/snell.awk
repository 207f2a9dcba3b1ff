# Where a wavelength should meet the wall of stage.awk by Snell's law, beside where lightsim has it: reads what
# oiiotool --dumpdata prints of one column of points' irradiance.
# awk -v nm=WAVELENGTH -v ior=N -v dispersion=B -v top=Y -v pixel=SIZE (the column's upper end, a pixel's height)
# SPDX-License-Identifier: GPL-3.0-or-later
function asin(s) { return atan2(s, sqrt(1 - s * s)) }

/Pixel/ {
    gsub(/[(),:]/, " ")
    sum += $4; moment += $4 * (top - ($3 + 0.5) * pixel)
}

END {
    pi = atan2(0, -1); side = 0.7; rise = 29.8 * pi / 180; wall = 1.7
    n = ior + dispersion * (1e6 / nm ^ 2 - 1 / 0.5876 ^ 2)
    inside = asin(sin(rise + pi / 6) / n)           # to the left face's normal
    leaves = asin(n * sin(pi / 3 - inside))         # to the right face's
    climbs = inside - pi / 6                        # within the prism
    x = -side / 4; y = side / 4 / sqrt(3)           # the left face's middle
    way = (side / 2 / sqrt(3) - cos(pi / 6) * x - y / 2) / (cos(pi / 6) * cos(climbs) + sin(climbs) / 2)
    x += way * cos(climbs); y += way * sin(climbs)
    y -= (wall - x) * sin(leaves - pi / 6) / cos(leaves - pi / 6)
    printf "%6.1f nm  n %.5f  Snell %.5f  lightsim %.5f  apart %.5f\n", nm, n, y, moment / sum, moment / sum - y
}
