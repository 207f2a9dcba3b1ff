# Quads next to the plane z = 0: x, y of their middles, irradiance. In: twelve coordinates, then the bytes of a
# face, the last four of them a little-endian float.
# SPDX-License-Identifier: GPL-3.0-or-later
function float(first,    bits, exponent) {
    bits = $first + 256 * $(first + 1) + 65536 * ($(first + 2) % 128)
    exponent = 2 * ($(first + 3) % 128) + int($(first + 2) / 128)
    return exponent == 0 ? 0 : (1 + bits / 8388608) * 2 ^ (exponent - 127)
}
{
    z = ($3 + $6 + $9 + $12) / 4
    if (z < -0.6 * near || z > 0.6 * near) next # quads of a plain front lie on both sides
    print ($1 + $4 + $7 + $10) / 4, ($2 + $5 + $8 + $11) / 4, float(34)
}
