# A profile (profile.awk) as a lathe for POV-Ray: lines and arcs as cubics, each of a sixteenth of a half
# turn at most, which keep to the circle to 1e-8 of its radius.
# SPDX-License-Identifier: GPL-3.0-or-later
function cosine(a) { return sin(a + pi / 2) }
function point(x, y) { return sprintf("<%.12g, %.12g>", x < 1e-9 ? 0 : x, y) }
function cubic(x0, y0, x1, y1, x2, y2, x3, y3) {
    cubics[++count] = point(x0, y0) ", " point(x1, y1) ", " point(x2, y2) ", " point(x3, y3)
}
BEGIN { pi = atan2(0, -1) }
$1 == "line" {
    dx = ($4 - $2) / 3; dy = ($5 - $3) / 3
    cubic($2, $3, $2 + dx, $3 + dy, $4 - dx, $5 - dy, $4, $5)
}
$1 == "arc" {
    turn = $6 - $5
    n = int((turn > 0 ? turn : -turn) / (pi / 16)) + 1
    step = turn / n; tangent = step / 4; reach = 4 / 3 * $4 * sin(tangent) / cosine(tangent)
    for (k = 0; k < n; ++k) {
        a = $5 + step * k; b = a + step
        x0 = $2 + $4 * cosine(a); y0 = $3 + $4 * sin(a)
        x3 = $2 + $4 * cosine(b); y3 = $3 + $4 * sin(b)
        cubic(x0, y0, x0 - reach * sin(a), y0 + reach * cosine(a), \
              x3 + reach * sin(b), y3 - reach * cosine(b), x3, y3)
    }
}
END {
    print "#declare Glass = lathe { bezier_spline " 4 * count ","
    for (k = 1; k <= count; ++k) print "  " cubics[k] (k < count ? "," : "")
    print "  sturm }"
}
