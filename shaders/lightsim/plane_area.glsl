// How much of a plane lies within a cube.
// SPDX-License-Identifier: GPL-3.0-or-later

// The part of the unit square in which a u + b v <= q, 0 < a, b.
float partBelow(float a, float b, float q) {
    vec4 t = max(vec4(q, q - a, q - b, q - a - b), vec4(0.0));
    return clamp((t.x * t.x - t.y * t.y - t.z * t.z + t.w * t.w) / (2.0 * a * b), 0.0, 1.0);
}

// The area within a cube of that edge of the plane at distance d, with that gradient, from its middle.
// Its share of the column along the gradient's longest axis is exact, or so nearly that all cubes of a column
// have the column's: slopes below a fiftieth count as that, since floats would hold the difference no better.
float planeAreaIn(vec3 gradient, float d, float edge) {
    vec3 g = abs(gradient);
    float along = max(g.x, max(g.y, g.z));
    float least = min(g.x, min(g.y, g.z));
    float between = g.x + g.y + g.z - along - least;
    float a = max(between / along, 0.02);
    float b = max(least / along, 0.02);
    float q = d / (along * edge) + 0.5 * (a + b);
    float share = partBelow(a, b, q + 0.5) - partBelow(a, b, q - 0.5);
    return share * edge * edge * length(gradient) / along;
}
