# The profile of a wine glass, 120 mm tall with a wall of 1 mm: arcs and lines that go over into each
# other without a corner, so that what it makes when turned round the y axis can be traced exactly.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From the middle of the foot's underside outward, up outside, over the rim and down inside, with the
# glass to the left. A piece a line, in mm and radians:
#   line X0 Y0 X1 Y1
#   arc CX CY RADIUS FROM TO      angles from the x axis; FROM < TO where it curves round the glass
function line(x0, y0, x1, y1) { printf "line %.17g %.17g %.17g %.17g\n", x0, y0, x1, y1 }
function arc(x, y, r, from, to) { printf "arc %.17g %.17g %.17g %.17g %.17g\n", x, y, r, from, to }
BEGIN {
    pi = atan2(0, -1); degree = pi / 180
    if (!wall) wall = 1 # -v wall=2: another [mm]
    height = 120; lip = wall / 2
    foot = 34; edge = 1; slope = 7 * degree         # the foot's radius, its rounded edge, its top
    stem = 4; below = 16; above = 14                # the stem's radius, and the fillets at its ends
    bottom = 36; belly = 34                         # the bowl's two radii, inside,
    turn = 56 * degree; lean = 8 * degree           # where one goes over into the other, and its side
    side = 25                                       # the straight part of that, along it

    # The bowl's centres, from its rim downward.
    lipY = height - lip
    topY = lipY - lip * sin(lean)                   # where the inside ends
    bellyX = (bottom - belly) * sin(turn)
    bellyY = topY - side * cos(lean) - belly * sin(lean)
    bottomY = bellyY + (bottom - belly) * cos(turn)
    lowX = bellyX + belly * cos(lean); lowY = bellyY + belly * sin(lean)
    topX = lowX - side * sin(lean)
    lipX = topX + lip * cos(lean)

    # The fillet that the bowl stands on.
    open = atan2((stem + above) / (bottom + wall + above), \
                 sqrt(1 - ((stem + above) / (bottom + wall + above)) ^ 2))
    aboveY = bottomY - (bottom + wall + above) * cos(open)

    # The foot's top, from its edge to the fillet below the stem.
    edgeX = foot - edge
    fromX = edgeX + edge * sin(slope); fromY = edge + edge * cos(slope)
    toX = stem + below - below * sin(slope)
    toY = fromY + (fromX - toX) * sin(slope) / cos(slope)
    belowY = toY + below * cos(slope)

    line(0, 0, edgeX, 0)
    arc(edgeX, edge, edge, -pi / 2, pi / 2 - slope)
    line(fromX, fromY, toX, toY)
    arc(stem + below, belowY, below, 3 * pi / 2 - slope, pi)
    line(stem, belowY, stem, aboveY)
    arc(stem + above, aboveY, above, pi, pi / 2 + open)
    arc(0, bottomY, bottom + wall, open - pi / 2, turn - pi / 2)
    arc(bellyX, bellyY, belly + wall, turn - pi / 2, lean)
    line(lowX + wall * cos(lean), lowY + wall * sin(lean), \
         topX + wall * cos(lean), topY + wall * sin(lean))
    arc(lipX, lipY, lip, lean, lean + pi)
    line(topX, topY, lowX, lowY)
    arc(bellyX, bellyY, belly, lean, turn - pi / 2)
    arc(0, bottomY, bottom, turn - pi / 2, -pi / 2)
}
