# The skin of the sketched body at rest: a closed mesh around its bones, as OFF.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   awk -v cell=0.025 -f skeleton.awk -f body.awk >body.off
#
# The skin is where a smooth minimum of the distances to the bones is 0. Its mesh has a point in
# each cell of a grid that the skin crosses and a quadrilateral for each grid edge (naive surface
# nets, Gibson 1998, "Constrained elastic surface nets"); points are then moved onto the skin.

function skin(x, y, z,    b, sum) {
    sum = 0
    for (b = 1; b <= bones; ++b) sum += exp(-sharp * fromBone(b, x, y, z))
    return -log(sum) / sharp
}

function at(i, j, k) { return (k * ny + j) * nx + i }

# The point of a cell: the mean of where its edges cross the skin, then along the gradient.
function place(i, j, k,    c, d, e, f, g, t, n, x, y, z, step, h, ax, ay, az, bx, by, bz) {
    n = x = y = z = 0
    for (c = 0; c < 8; ++c) for (e = 1; e <= 4; e *= 2) if (int(c / e) % 2 == 0) {
        d = c + e
        ax = c % 2; ay = int(c / 2) % 2; az = int(c / 4)
        bx = d % 2; by = int(d / 2) % 2; bz = int(d / 4)
        f = value[at(i + ax, j + ay, k + az)]; g = value[at(i + bx, j + by, k + bz)]
        if ((f < 0) == (g < 0)) continue
        t = f / (f - g); ++n
        x += ax + t * (bx - ax); y += ay + t * (by - ay); z += az + t * (bz - az)
    }
    x = x0 + cell * (i + x / n); y = y0 + cell * (j + y / n); z = z0 + cell * (k + z / n)
    h = 0.01 * cell
    for (step = 0; step < 2; ++step) {
        f = skin(x, y, z)
        ax = (skin(x + h, y, z) - f) / h; ay = (skin(x, y + h, z) - f) / h; az = (skin(x, y, z + h) - f) / h
        t = f / (ax * ax + ay * ay + az * az)
        x -= t * ax; y -= t * ay; z -= t * az
    }
    points = points sprintf("%.6f %.6f %.6f\n", x, y, z)
    return count++
}

function pointOf(i, j, k,    cellHere) {
    cellHere = at(i, j, k)
    if (!(cellHere in point)) point[cellHere] = place(i, j, k)
    return point[cellHere]
}

# Round a grid edge from outside to inside or back: two triangles, which look outside.
function facesAt(a, b, c, d, inside) {
    if (inside) faces = faces "3 " a " " b " " c "\n3 " a " " c " " d "\n"
    else faces = faces "3 " a " " c " " b "\n3 " a " " d " " c "\n"
    made += 2
}

BEGIN {
    if (!cell) cell = 0.025
    sharp = 28 # how closely the skin follows the bones [1/unit]
    sketch()
    x0 = -0.95; y0 = -0.06; z0 = -0.3
    nx = int(1.9 / cell) + 2; ny = int(2.0 / cell) + 2; nz = int(0.65 / cell) + 2
    for (k = 0; k < nz; ++k) for (j = 0; j < ny; ++j) for (i = 0; i < nx; ++i)
        value[at(i, j, k)] = skin(x0 + cell * i, y0 + cell * j, z0 + cell * k)
    for (k = 1; k < nz - 1; ++k) for (j = 1; j < ny - 1; ++j) for (i = 1; i < nx - 1; ++i) {
        in0 = value[at(i, j, k)] < 0
        if (in0 != (value[at(i + 1, j, k)] < 0))
            facesAt(pointOf(i, j - 1, k - 1), pointOf(i, j, k - 1), pointOf(i, j, k), pointOf(i, j - 1, k), in0)
        if (in0 != (value[at(i, j + 1, k)] < 0))
            facesAt(pointOf(i - 1, j, k - 1), pointOf(i - 1, j, k), pointOf(i, j, k), pointOf(i, j, k - 1), in0)
        if (in0 != (value[at(i, j, k + 1)] < 0))
            facesAt(pointOf(i - 1, j - 1, k), pointOf(i, j - 1, k), pointOf(i, j, k), pointOf(i - 1, j, k), in0)
    }
    printf "OFF\n%d %d 0\n%s%s", count, made, points, faces
}
