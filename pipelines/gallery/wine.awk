# What fills a glass (pipelines/wineglass/profile.awk) to a level, as a table of radii and heights.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# level: of its surface [mm]; into: how far it reaches into the glass [mm].
# The last three pieces of the profile are its inside, from the rim down to the axis.
{ piece[NR] = $0 }
function point(x, y) { if (y < level) { radius[++count] = x < 1e-9 ? 0 : x; height[count] = y } }
END {
    pi = atan2(0, -1)
    split(piece[NR - 2], line); split(piece[NR - 1], belly); split(piece[NR], bottom)
    dx = line[4] - line[2]; dy = line[5] - line[3]; long = sqrt(dx * dx + dy * dy)
    for (k = 0; k <= 32; ++k) # outward is to the left on the way down
        point(line[2] + dx * k / 32 - into * dy / long, line[3] + dy * k / 32 + into * dx / long)
    arcTo(belly); arcTo(bottom)
    print "# radius [mm], height [mm]"
    print 0, level
    print radius[1] + (radius[1] - radius[2]) / (height[1] - height[2]) * (level - height[1]), level
    for (k = 1; k <= count; ++k) print radius[k], height[k]
}
function arcTo(arc,    k, a) {
    for (k = 1; k <= 64; ++k) {
        a = arc[5] + (arc[6] - arc[5]) * k / 64
        point(arc[2] + (arc[4] + into) * sin(a + pi / 2), arc[3] + (arc[4] + into) * sin(a))
    }
}
