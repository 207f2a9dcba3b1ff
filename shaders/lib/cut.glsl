// How much of a triangle lies within a voxel: exact, without a polygon being built.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle steep to the third axis nowhere is looked at along that axis. What lies below a plane across
// the axis is a polygon of at most four corners; its part in a square is a sum over its edges (Green's
// theorem): of each the part over the square counts by its height, held between the square's sides.

// What of a step from height a to b is above 0, held below 1: its mean.
float heldMean(float a, float b) {
    float d = b - a;
    d = abs(d) < 1.0e-6 ? (d < 0.0 ? -1.0e-6 : 1.0e-6) : d;
    float at0 = clamp(-a / d, 0.0, 1.0);
    float at1 = clamp((1.0 - a) / d, 0.0, 1.0);
    float above = d > 0.0 ? 1.0 - at1 : at1;
    return above + abs(at1 - at0) * 0.5 * (clamp(a, 0.0, 1.0) + clamp(b, 0.0, 1.0));
}

// An edge's part of the area within the unit square.
float edgePart(vec2 p, vec2 q) {
    float from = clamp(p.x, 0.0, 1.0);
    float to = clamp(q.x, 0.0, 1.0);
    float width = q.x - p.x;
    float slope = (q.y - p.y) / (abs(width) < 1.0e-12 ? 1.0e-12 : width);
    return (to - from) * heldMean(p.y + (from - p.x) * slope, p.y + (to - p.x) * slope);
}

// Corners by ascending third coordinate.
void sortCorners(inout vec3 a, inout vec3 b, inout vec3 c) {
    vec3 t = a;
    if (b.z < a.z) { a = b; b = t; }
    t = b;
    if (c.z < b.z) { b = c; c = t; }
    t = a;
    if (b.z < a.z) { a = b; b = t; }
}

float shareTo(float from, float to, float at) {
    return clamp((at - from) / max(to - from, 1.0e-12), 0.0, 1.0);
}

// The area seen along the third axis of what a triangle has in the unit square at `corner` below height
// `top`; corners ascend. Signed by the way its corners go round.
float areaBelow(vec3 a, vec3 b, vec3 c, vec2 corner, float top) {
    vec2 u = a.xy - corner;
    vec2 v = b.xy - corner;
    vec2 w = c.xy - corner;
    vec2 p = mix(u, v, shareTo(a.z, b.z, top));
    vec2 q = top < b.z ? p : mix(v, w, shareTo(b.z, c.z, top));
    vec2 r = mix(u, w, shareTo(a.z, c.z, top));
    return edgePart(p, u) + edgePart(q, p) + edgePart(r, q) + edgePart(u, r);
}
