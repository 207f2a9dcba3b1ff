# The surface of water with waves on it as an open OBJ: x and z from -1 to 1, y a sum of sines about 0.
# SPDX-License-Identifier: GPL-3.0-or-later
function height(x, z) {
    return 0.02 * sin(7 * x + 2 * z) + 0.015 * sin(-4 * x + 9 * z + 1) + 0.008 * sin(13 * x + 11 * z + 2)
}
function at(i, j) { return j * (n + 1) + i + 1 }
BEGIN {
    n = 256
    for (j = 0; j <= n; ++j)
        for (i = 0; i <= n; ++i) {
            x = 2 * i / n - 1; z = 2 * j / n - 1
            printf "v %.9g %.9g %.9g\n", x, height(x, z), z
        }
    for (j = 0; j < n; ++j)
        for (i = 0; i < n; ++i) {
            printf "f %d %d %d\n", at(i, j), at(i, j + 1), at(i + 1, j + 1)
            printf "f %d %d %d\n", at(i, j), at(i + 1, j + 1), at(i + 1, j)
        }
}
