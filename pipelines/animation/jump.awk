# A frame of a body of jelly that jumps and twists, from a closed mesh about the origin.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   awk -v phase=0.25 -f jump.awk bunny.off >frame.obj
#
# phase: 0 to 1, once round. In [0, 0.2] it crouches, then flies along a parabola till 0.8, and
# lands crouching. Squash and stretch keep the volume; the twist is about the upright axis, by an
# angle that grows with height, and ends as it began.

function smoothstep(x) { x = x < 0 ? 0 : x > 1 ? 1 : x; return x * x * (3 - 2 * x) }

BEGIN {
    pi = atan2(0, -1)
    ground = -0.5
    flight = (phase - 0.2) / 0.6
    inAir = flight > 0 && flight < 1
    height = inAir ? 0.9 * 4 * flight * (1 - flight) * 0.5 : 0
    # How tall it is: 0.78 where it crouches, 1.15 on its way up and down.
    low = phase < 0.1 ? smoothstep(phase / 0.1) : phase < 0.2 ? 1 - smoothstep((phase - 0.1) / 0.1) : \
          phase > 0.9 ? 1 - smoothstep((phase - 0.9) / 0.1) : phase > 0.8 ? smoothstep((phase - 0.8) / 0.1) : 0
    tall = 1 - 0.22 * low + (inAir ? 0.15 * sin(pi * flight) ^ 2 : 0)
    wide = 1 / sqrt(tall)
    twist = inAir ? 1.3 * sin(2 * pi * flight) : 0 # at the top over the bottom [radian]
}

/^#/ || NF == 0 { next }
!head { head = 1; if ($1 == "OFF" && NF == 1) next; if ($1 == "OFF") { $1 = ""; $0 = $0 } }
!points { points = $1; next }
seen < points {
    ++seen
    up = ($2 - ground) # above where it stands
    angle = twist * (up - 0.5)
    c = cos(angle); s = sin(angle)
    printf "v %.6f %.6f %.6f\n", wide * (c * $1 + s * $3), ground + tall * up + height, wide * (c * $3 - s * $1)
    next
}
{ print "f", $2 + 1, $3 + 1, $4 + 1 }
