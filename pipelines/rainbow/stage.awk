# The stage that the prism stands on, as OBJ: a floor, a white wall to the right, and to the left a screen
# with a slit, through which light that rises by 29.8 degrees meets the prism's left face at its middle.
# awk [-v slit=HEIGHT] -f stage.awk
# SPDX-License-Identifier: GPL-3.0-or-later
function box(name, x0, y0, z0, x1, y1, z1,    i, b) {
    print "o", name
    for (i = 0; i < 8; ++i)
        printf "v %.9g %.9g %.9g\n", (i % 2 ? x1 : x0), (int(i / 2) % 2 ? y1 : y0), (i > 3 ? z1 : z0)
    b = 8 * boxes++
    print "f", b + 1, b + 3, b + 4, b + 2 "\nf", b + 5, b + 6, b + 8, b + 7 "\nf", b + 1, b + 2, b + 6, b + 5
    print "f", b + 3, b + 7, b + 8, b + 4 "\nf", b + 1, b + 5, b + 7, b + 3 "\nf", b + 2, b + 4, b + 8, b + 6
}

BEGIN {
    pi = atan2(0, -1)
    if (!slit) slit = 0.05
    side = 0.7 # of the prism
    tangent = sin(29.8 * pi / 180) / cos(29.8 * pi / 180)
    left = -1.24; right = -1.17; width = 0.2 # of the screen, and of the slit to either side
    middle = side / 4 / sqrt(3) + ((left + right) / 2 + side / 4) * tangent # of the slit, as high
    # It lets through what comes in above its lower edge on the left, and leaves below the upper on the right.
    low = middle - slit / 2 - (right - left) / 2 * tangent
    high = middle + slit / 2 + (right - left) / 2 * tangent
    box("floor", -1.6, -1.6, -1, 2, -1.22, 1)
    box("wall", 1.7, -1.5, -1, 2, 1, 1)
    box("below", left, -1.5, -1, right, low, 1)
    box("above", left, high, -1, right, 1, 1)
    box("behind", left, low - 0.1, -1, right, high + 0.1, -width)
    box("before", left, low - 0.1, width, right, high + 0.1, 1)
}
