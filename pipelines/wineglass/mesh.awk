# A profile (profile.awk) turned round the y axis, as OBJ with the surface's own normals.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# around: facets of a ring; along: a piece's longest facet [mm].
function cosine(a) { return sin(a + pi / 2) }
# A ring of the profile's next point, or on the axis a pole.
function ring(x, y, nx, ny,    i, a) {
    if (x < 1e-9) { x = 0; nx = 0; ny = ny < 0 ? -1 : 1 }
    first[rings] = points + 1; size[rings] = x ? around : 1; ++rings
    for (i = 0; i < (x ? around : 1); ++i) {
        a = 2 * pi * i / around; ++points
        printf "v %.10g %.10g %.10g\nvn %.10g %.10g %.10g\n", \
               x * cosine(a), y, -x * sin(a), nx * cosine(a), ny, -nx * sin(a)
    }
}
function corner(r, i) { r = first[r] + (size[r] > 1 ? i % around : 0); return r "//" r }
BEGIN {
    pi = atan2(0, -1)
    rings = points = 0
    if (!around) around = 512
    if (!along) along = 0.5
}
# Each piece's points but its last, which is the next one's first.
$1 == "line" {
    dx = $4 - $2; dy = $5 - $3; long = sqrt(dx * dx + dy * dy)
    n = int(long / along) + 1
    for (k = 0; k < n; ++k) ring($2 + dx * k / n, $3 + dy * k / n, dy / long, -dx / long)
    endX = $4; endNx = dy / long; endY = $5; endNy = -dx / long
}
$1 == "arc" {
    turn = $6 - $5; side = turn > 0 ? 1 : -1
    n = int(side * turn * $4 / along) + 1
    least = int(side * turn / (pi / 16)) + 1
    if (n < least) n = least
    for (k = 0; k <= n; ++k) {
        a = $5 + turn * k / n
        endX = $2 + $4 * cosine(a); endNx = side * cosine(a)
        endY = $3 + $4 * sin(a); endNy = side * sin(a)
        if (k < n) ring(endX, endY, endNx, endNy)
    }
}
END {
    ring(endX, endY, endNx, endNy)
    for (r = 0; r < rings - 1; ++r)
        for (i = 0; i < around; ++i) {
            if (size[r] > 1)
                print "f", corner(r, i), corner(r, i + 1), corner(r + 1, i)
            if (size[r + 1] > 1)
                print "f", corner(r + 1, i), corner(r, i + 1), corner(r + 1, i + 1)
        }
}
