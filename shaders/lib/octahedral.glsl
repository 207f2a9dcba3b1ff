// Unit vectors as two numbers: on the octahedron, whose lower half is folded out (Meyer et al. 2010).
// SPDX-License-Identifier: GPL-3.0-or-later

float eitherSign(float x) {
    return x < 0.0 ? -1.0 : 1.0;
}

// In [−1, 1]², of a vector of any length but 0.
vec2 octahedralOf(vec3 v) {
    vec2 onto = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
    return v.z >= 0.0 ? onto
                      : vec2((1.0 - abs(onto.y)) * eitherSign(onto.x), (1.0 - abs(onto.x)) * eitherSign(onto.y));
}

vec3 fromOctahedral(vec2 p) {
    float z = 1.0 - abs(p.x) - abs(p.y);
    vec2 xy = z >= 0.0 ? p : vec2((1.0 - abs(p.y)) * eitherSign(p.x), (1.0 - abs(p.x)) * eitherSign(p.y));
    return normalize(vec3(xy, z));
}
