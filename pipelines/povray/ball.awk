# A ball of radius 0.5 as OBJ, fine enough that its facets are not seen: 512 by 256 of them, or
# -v around=... by -v down=...
# SPDX-License-Identifier: GPL-3.0-or-later
BEGIN {
    pi = atan2(0, -1); r = 0.5
    if (!around) { around = 512; down = 256 }
    printf "v 0 %.9g 0\n", r
    for (j = 1; j < down; ++j)
        for (i = 0; i < around; ++i) {
            t = pi * j / down; p = 2 * pi * i / around
            printf "v %.9g %.9g %.9g\n", r * sin(t) * sin(p), r * cos(t), r * sin(t) * cos(p)
        }
    printf "v 0 %.9g 0\n", -r
    last = 2 + (down - 1) * around
    for (i = 0; i < around; ++i) {
        k = (i + 1) % around
        printf "f 1 %d %d\n", 2 + i, 2 + k
        for (j = 0; j < down - 2; ++j) {
            a = 2 + j * around
            printf "f %d %d %d %d\n", a + i, a + around + i, a + around + k, a + k
        }
        a = 2 + (down - 2) * around
        printf "f %d %d %d\n", last, a + k, a + i
    }
}
