# A box between two corners as OBJ: awk -v x0=... -v y0=... -v z0=... -v x1=... -v y1=... -v z1=...
# SPDX-License-Identifier: GPL-3.0-or-later
BEGIN {
    for (i = 0; i < 8; ++i)
        printf "v %.9g %.9g %.9g\n", (i % 2 ? x1 : x0), (int(i / 2) % 2 ? y1 : y0), (i > 3 ? z1 : z0)
    print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6"
}
