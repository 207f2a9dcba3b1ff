# The sketch of a body: its bones, as joints and radii. Included before body.awk and pose.awk.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A bone runs from its joint, about which it turns, to its end; it hangs on a parent. Y is up, X to
# the body's left, Z where it looks; it is about 1.8 tall and stands at y = 0.

function bone(name, parent, ax, ay, az, bx, by, bz, thick, thin) {
    number[name] = ++bones
    above[bones] = parent == "" ? 0 : number[parent]
    px[bones] = ax; py[bones] = ay; pz[bones] = az
    qx[bones] = bx; qy[bones] = by; qz[bones] = bz
    ra[bones] = thick; rb[bones] = thin
}

function limbs(side, s) {
    bone("upper arm " side, "chest", s * 0.21, 1.38, 0, s * 0.47, 1.19, 0, 0.075, 0.062)
    bone("forearm " side, "upper arm " side, s * 0.47, 1.19, 0, s * 0.70, 0.99, 0.04, 0.060, 0.048)
    bone("hand " side, "forearm " side, s * 0.70, 0.99, 0.04, s * 0.78, 0.92, 0.06, 0.055, 0.05)
    bone("thigh " side, "pelvis", s * 0.13, 0.90, 0, s * 0.17, 0.50, 0.02, 0.105, 0.080)
    bone("shin " side, "thigh " side, s * 0.17, 0.50, 0.02, s * 0.18, 0.10, -0.02, 0.075, 0.055)
    bone("foot " side, "shin " side, s * 0.18, 0.10, -0.02, s * 0.20, 0.06, 0.15, 0.06, 0.05)
}

function sketch() {
    bone("pelvis", "", 0, 0.98, 0, 0, 0.90, 0, 0.15, 0.14)
    bone("chest", "pelvis", 0, 1.05, 0, 0, 1.33, 0, 0.14, 0.17)
    bone("neck", "chest", 0, 1.44, 0, 0, 1.56, 0.01, 0.08, 0.075)
    bone("head", "neck", 0, 1.60, 0.01, 0, 1.72, 0.03, 0.125, 0.12)
    limbs("left", 1)
    limbs("right", -1)
}

# The distance to a bone's surface, negative inside; `along` is left at the share of its length.
function fromBone(b, x, y, z,    ux, uy, uz, vx, vy, vz, t) {
    ux = qx[b] - px[b]; uy = qy[b] - py[b]; uz = qz[b] - pz[b]
    vx = x - px[b]; vy = y - py[b]; vz = z - pz[b]
    t = (ux * vx + uy * vy + uz * vz) / (ux * ux + uy * uy + uz * uz)
    along = t = t < 0 ? 0 : t > 1 ? 1 : t
    vx -= t * ux; vy -= t * uy; vz -= t * uz
    return sqrt(vx * vx + vy * vy + vz * vz) - (ra[b] + t * (rb[b] - ra[b]))
}
