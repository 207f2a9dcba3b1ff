# A closed mesh as OBJ: awk -v shape=ball|ring|box -v place=X,Y,Z -v size=... -f shape.awk
#   ball: size=RADIUS; ring: size=RADIUS,WALL,HEIGHT, standing on its place; box: size=X,Y,Z, centred on its place.
# SPDX-License-Identifier: GPL-3.0-or-later
function quad(a, b, c, d) { printf "f %d %d %d\nf %d %d %d\n", a, b, c, a, c, d }
function point(x, y, z) { printf "v %.7f %.7f %.7f\n", px + x, py + y, pz + z }
function ball(r,    i, j, k, t, p, a, b, M, N) {
    M = 48; N = 96
    point(0, r, 0)
    for (i = 1; i < M; i++)
        for (j = 0; j < N; j++) {
            t = pi * i / M; p = 2 * pi * j / N
            point(r * sin(t) * cos(p), r * cos(t), r * sin(t) * sin(p))
        }
    point(0, -r, 0)
    for (j = 0; j < N; j++) {
        k = (j + 1) % N
        printf "f 1 %d %d\n", 2 + k, 2 + j
        for (i = 1; i < M - 1; i++) { a = 2 + (i - 1) * N; b = a + N; quad(a + j, a + k, b + k, b + j) }
        a = 2 + (M - 2) * N
        printf "f %d %d %d\n", a + j, a + k, 2 + (M - 1) * N
    }
}
function ring(r, wall, h,    i, a, b, c, s, N) {
    N = 256
    for (i = 0; i < N; i++) {
        c = cos(2 * pi * i / N); s = sin(2 * pi * i / N)
        point(r * c, 0, r * s); point(r * c, h, r * s)
        point((r + wall) * c, 0, (r + wall) * s); point((r + wall) * c, h, (r + wall) * s)
    }
    for (i = 0; i < N; i++) {
        a = 4 * i + 1; b = 4 * ((i + 1) % N) + 1
        quad(a, b, b + 1, a + 1); quad(a + 2, a + 3, b + 3, b + 2)
        quad(a + 1, b + 1, b + 3, a + 3); quad(a, a + 2, b + 2, b)
    }
}
function box(x, y, z,    i) {
    for (i = 0; i < 8; i++) point((i % 2 - 0.5) * x, (int(i / 2) % 2 - 0.5) * y, (int(i / 4) - 0.5) * z)
    quad(1, 3, 4, 2); quad(5, 6, 8, 7); quad(1, 2, 6, 5); quad(3, 7, 8, 4); quad(1, 5, 7, 3); quad(2, 4, 8, 6)
}
BEGIN {
    pi = atan2(0, -1)
    split(place, P, ","); px = P[1]; py = P[2]; pz = P[3]
    split(size, S, ",")
    if (shape == "ball") ball(S[1])
    else if (shape == "ring") ring(S[1], S[2], S[3])
    else if (shape == "box") box(S[1], S[2], S[3])
    else { print "shape.awk: no shape '" shape "'" > "/dev/stderr"; exit 64 }
}
