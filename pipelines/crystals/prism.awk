# A prism: a base of corners, moved by a vector, as OBJ.
#   awk -f prism.awk -v base='X,Y,Z X,Y,Z ...' -v along=X,Y,Z [-v place=X,Y,Z] [-v size=S]
# The base is given so that it turns counter-clockwise seen from where `along` points to; the prism's middle is at `place`.
# SPDX-License-Identifier: GPL-3.0-or-later
BEGIN {
    if (size == "") size = 1
    if (place == "") place = "0,0,0"
    n = split(base, corner, " ")
    split(along, d, ",")
    split(place, o, ",")
    for (i = 1; i <= n; ++i) {
        split(corner[i], c, ",")
        for (k = 1; k <= 3; ++k) { at[i, k] = c[k]; mean[k] += c[k] / n }
    }
    for (side = 0; side < 2; ++side)
        for (i = 1; i <= n; ++i) {
            line = "v"
            for (k = 1; k <= 3; ++k) line = line " " o[k] + size * (at[i, k] - mean[k] + (side - 0.5) * d[k])
            print line
        }
    low = high = "f"
    for (i = 1; i <= n; ++i) { low = low " " n + 1 - i; high = high " " n + i }
    print low
    print high
    for (i = 1; i <= n; ++i) { j = i % n + 1; print "f", i, j, n + j, n + i }
}
