# A diamond in the standard brilliant cut as OBJ, of radius 1, lying on a main facet of its pavilion on y = 0:
# awk -v table=53 -v crown=34.5 -v pavilion=40.75 -v girdle=2 -v star=50 -v lower=77 -v culet=1 -v upright=0
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Table, girdle and culet are in percent of the diameter, crown and pavilion the angles of the main facets in
# degrees; these defaults are Tolkowsky's (Diamond Design, 1919). He left the lesser facets open: star and lower
# are how far, in percent, the star facets reach from the table's edge to the girdle, and the lower girdle facets
# from the girdle to the axis. 58 facets and 16 of the girdle, each flat: the corners of every facet with
# more than three are laid on its plane.
function default_to(value, otherwise) { return value == "" ? otherwise : value }

function corner(turn, r, y,    a) { # `turn` in sixteenths
    a = turn * pi / 8
    x[++count] = r * cos(a); up[count] = y; z[count] = r * sin(a)
    return count
}

function tangent(degrees) { return sin(degrees * pi / 180) / cos(degrees * pi / 180) }

BEGIN {
    pi = atan2(0, -1)
    table = default_to(table, 53) / 100
    crown = tangent(default_to(crown, 34.5))
    angle = default_to(pavilion, 40.75) * pi / 180; pavilion = sin(angle) / cos(angle)
    half = default_to(girdle, 2) / 100 # of its height; the radius is 1
    star = default_to(star, 50) / 100; lower = default_to(lower, 77) / 100
    culet = default_to(culet, 1) / 100
    beside = cos(pi / 8) # what a corner between two main facets has of its radius along their normals

    inner = table * beside + star * (1 - table * beside) # where star facets end
    deep = 1 - lower                                     # where lower girdle facets end
    for (k = 0; k < 8; ++k) { # main facets face the even sixteenths
        T[k] = corner(2 * k, table, half + crown * (1 - table))
        S[k] = corner(2 * k + 1, inner, half + crown * (1 - inner * beside))
        L[k] = corner(2 * k + 1, deep, -half - pavilion * (1 - deep * beside))
        C[k] = corner(2 * k + 1, culet, -half - pavilion * (1 - culet * beside))
    }
    for (k = 0; k < 16; ++k) { A[k] = corner(k, 1, half); B[k] = corner(k, 1, -half) }

    # Turned about x until the main facet that faces z looks down.
    low = 0
    for (i = 1; i <= count && !upright; ++i) {
        y = up[i] * cos(angle) - z[i] * sin(angle)
        z[i] = up[i] * sin(angle) + z[i] * cos(angle); up[i] = y
    }
    for (i = 1; i <= count; ++i) if (up[i] < low) low = up[i]
    for (i = 1; i <= count; ++i) printf "v %.9g %.9g %.9g\n", x[i], up[i] - low, z[i]

    # Seen from outside, corners go counterclockwise.
    printf "f"; for (k = 7; k >= 0; --k) printf " %d", T[k]; print ""
    printf "f"; for (k = 0; k < 8; ++k) printf " %d", C[k]; print ""
    for (k = 0; k < 8; ++k) {
        next_one = (k + 1) % 8; before = (k + 7) % 8
        main = 2 * k; right = main + 1; far = (main + 2) % 16
        print "f", T[k], T[next_one], S[k]                    # star
        print "f", T[k], S[k], A[main], S[before]             # bezel
        print "f", S[k], A[right], A[main] "\nf", S[k], A[far], A[right]   # upper girdle
        print "f", A[main], A[right], B[right], B[main] "\nf", A[right], A[far], B[far], B[right]
        print "f", L[k], B[main], B[right] "\nf", L[k], B[right], B[far]   # lower girdle
        print "f", B[main], L[k], C[k], C[before], L[before]  # pavilion
    }
}
