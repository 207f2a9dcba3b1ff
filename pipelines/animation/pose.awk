# A frame of the sketched body, which jumps with raised arms: its bones turned, its skin with them.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   awk -v phase=0.25 -f skeleton.awk -f pose.awk body.off >frame.obj
#
# Linear blend skinning: a point follows the bones that are near it, each by a weight that falls
# with the sixth power of the distance.

# Turns a bone about its joint, with all that hang on it: by angles about X, then Y, then Z.
function turn(name, x, y, z) {
    x *= pi / 180; y *= pi / 180; z *= pi / 180
    turned[number[name]] = cos(y) * cos(z) " " (sin(x) * sin(y) * cos(z) - cos(x) * sin(z)) " " \
                           (cos(x) * sin(y) * cos(z) + sin(x) * sin(z)) " " \
                           cos(y) * sin(z) " " (sin(x) * sin(y) * sin(z) + cos(x) * cos(z)) " " \
                           (cos(x) * sin(y) * sin(z) - sin(x) * cos(z)) " " \
                           (-sin(y)) " " sin(x) * cos(y) " " cos(x) * cos(y)
}

# Rows of each bone's transform: m[b, 0] to m[b, 11], the last column the shift.
function poseBones(    b, a, r, c, k, n, local) {
    for (b = 1; b <= bones; ++b) {
        n = split(b in turned ? turned[b] : "1 0 0 0 1 0 0 0 1", local, " ")
        # About the joint.
        for (r = 0; r < 3; ++r) {
            for (c = 0; c < 3; ++c) own[4 * r + c] = local[3 * r + c + 1]
            own[4 * r + 3] = (r == 0 ? px[b] : r == 1 ? py[b] : pz[b]) - local[3 * r + 1] * px[b] - \
                             local[3 * r + 2] * py[b] - local[3 * r + 3] * pz[b]
        }
        a = above[b]
        for (r = 0; r < 3; ++r) for (c = 0; c < 4; ++c) {
            if (!a) { m[b, 4 * r + c] = own[4 * r + c]; continue }
            k = m[a, 4 * r] * own[c] + m[a, 4 * r + 1] * own[4 + c] + m[a, 4 * r + 2] * own[8 + c]
            m[b, 4 * r + c] = k + (c == 3 ? m[a, 4 * r + 3] : 0)
        }
    }
}

# Crouches, jumps with arms and legs apart, and lands.
function jump(    flight, low, air, way) {
    flight = (phase - 0.25) / 0.5
    air = flight > 0 && flight < 1 ? sin(pi * flight) : 0
    low = flight <= 0 ? sin(pi * phase / 0.25) : flight >= 1 ? sin(pi * (phase - 0.75) / 0.25) : 0
    for (way in sides) {
        turn("upper arm " way, -25 * low, 0, sides[way] * (95 * air - 15 * low))
        turn("forearm " way, -50 * low - 20 * air, 0, sides[way] * 10 * air)
        turn("thigh " way, -70 * low - 12 * air, 0, sides[way] * 22 * air)
        turn("shin " way, 105 * low + 45 * air, 0, 0)
        turn("foot " way, -38 * low + 20 * air, 0, 0)
    }
    turn("chest", 22 * low - 8 * air, 25 * sin(2 * pi * phase), 0)
    turn("head", -15 * low, -15 * sin(2 * pi * phase), 0)
    # The feet stay down: what thighs and shins lose in height the pelvis sinks.
    lift = 0.55 * air - (0.40 * (1 - cos(70 * low * pi / 180)) + 0.40 * (1 - cos(35 * low * pi / 180)))
}

BEGIN {
    pi = atan2(0, -1)
    sides["left"] = 1; sides["right"] = -1
    sketch()
    jump()
    poseBones()
}

/^#/ || NF == 0 || $1 == "OFF" { next }
!points { points = $1; next }
seen < points {
    ++seen
    sum = x = y = z = 0
    for (b = 1; b <= bones; ++b) {
        d = fromBone(b, $1, $2, $3) + ra[b] # from its line
        w = (ra[b] / d) ^ 6
        sum += w
        x += w * (m[b, 0] * $1 + m[b, 1] * $2 + m[b, 2] * $3 + m[b, 3])
        y += w * (m[b, 4] * $1 + m[b, 5] * $2 + m[b, 6] * $3 + m[b, 7])
        z += w * (m[b, 8] * $1 + m[b, 9] * $2 + m[b, 10] * $3 + m[b, 11])
    }
    printf "v %.6f %.6f %.6f\n", x / sum, y / sum + lift, z / sum
    next
}
{ print "f", $2 + 1, $3 + 1, $4 + 1 }
