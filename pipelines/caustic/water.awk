# The surface of water with waves on it as an open OBJ: x and z from -1 to 1 (or -v half=...), y a sum of
# sines about 0, by 256 (-v n=...) squares each way. With -v bottom=Y it is closed by walls and a floor there.
# SPDX-License-Identifier: GPL-3.0-or-later
function height(x, z) {
    return 0.02 * sin(7 * x + 2 * z) + 0.015 * sin(-4 * x + 9 * z + 1) + 0.008 * sin(13 * x + 11 * z + 2)
}
function at(i, j) { return j * (n + 1) + i + 1 }
BEGIN {
    if (!half) half = 1
    if (!n) n = 256
    m = (n + 1) * (n + 1)
    for (j = 0; j <= n; ++j)
        for (i = 0; i <= n; ++i) {
            x = half * (2 * i / n - 1); z = half * (2 * j / n - 1)
            printf "v %.9g %.9g %.9g\n", x, height(x, z), z
        }
    # The rim once more at the bottom, round it.
    for (i = 0; bottom != "" && i < 4 * n; ++i) {
        side = int(i / n); k = i % n
        u = side == 0 ? k : side == 1 ? n : side == 2 ? n - k : 0
        v = side == 0 ? 0 : side == 1 ? k : side == 2 ? n : n - k
        rim[i] = at(u, v)
        printf "v %.9g %.9g %.9g\n", half * (2 * u / n - 1), bottom, half * (2 * v / n - 1)
    }
    if (bottom != "") printf "v 0 %.9g 0\n", bottom
    for (j = 0; j < n; ++j)
        for (i = 0; i < n; ++i) {
            printf "f %d %d %d\n", at(i, j), at(i, j + 1), at(i + 1, j + 1)
            printf "f %d %d %d\n", at(i, j), at(i + 1, j + 1), at(i + 1, j)
        }
    for (i = 0; bottom != "" && i < 4 * n; ++i) {
        k = (i + 1) % (4 * n)
        printf "f %d %d %d\n", rim[i], rim[k], m + k + 1
        printf "f %d %d %d\n", rim[i], m + k + 1, m + i + 1
        printf "f %d %d %d\n", m + 4 * n + 1, m + i + 1, m + k + 1
    }
}
