// Cubic B-splines in textures: value and gradient from 16 unfiltered look-ups.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/spline.glsl"

struct Curved {
    vec4 sum;    // gradient, value
    vec3 change; // (d·∇)∇
};

// At t in [0, 1)³ of a cell: gradient and value, and how the gradient changes along d. A texel has all
// that a row needs, its four coefficients: 16 of them, unfiltered, where filtered look-ups would take 8
// for the value alone, and a device's filters may be coarse. `texel` is the centre of the cell's first
// row, `scale` 1 / texels.
Curved curvedSplineAt(sampler3D coefficients, vec3 texel, vec3 scale, vec3 t, vec3 d) {
    vec4 wx = splineWeights(t.x);
    vec4 wy = splineWeights(t.y);
    vec4 wz = splineWeights(t.z);
    vec4 sx = splineSlopes(t.x);
    vec4 sy = splineSlopes(t.y);
    vec4 sz = splineSlopes(t.z);
    vec4 bx = splineBends(t.x);
    vec4 by = splineBends(t.y);
    vec4 bz = splineBends(t.z);
    vec4 sum = vec4(0.0);
    vec3 pure = vec3(0.0);  // ∂xx, ∂yy, ∂zz
    vec3 mixed = vec3(0.0); // ∂yz, ∂xz, ∂xy
    for (int k = 0; k < 4; ++k) {
        vec3 row = vec3(0.0);    // over y of: value, ∂x, ∂y
        vec3 second = vec3(0.0); // of: ∂xx, ∂yy, ∂xy
        for (int j = 0; j < 4; ++j) {
            vec4 c = textureLod(coefficients, (texel + vec3(0, j, k)) * scale, 0.0);
            float value = dot(c, wx);
            float slope = dot(c, sx);
            row += vec3(wy[j] * value, wy[j] * slope, sy[j] * value);
            second += vec3(wy[j] * dot(c, bx), by[j] * value, sy[j] * slope);
        }
        sum += vec4(wz[k] * row.y, wz[k] * row.z, sz[k] * row.x, wz[k] * row.x);
        pure += vec3(wz[k] * second.x, wz[k] * second.y, bz[k] * row.x);
        mixed += vec3(sz[k] * row.z, sz[k] * row.y, wz[k] * second.z);
    }
    vec3 change = vec3(pure.x * d.x + mixed.z * d.y + mixed.y * d.z,
                       mixed.z * d.x + pure.y * d.y + mixed.x * d.z,
                       mixed.y * d.x + mixed.x * d.y + pure.z * d.z);
    return Curved(sum, change);
}

// Without the change, whose terms no compiler keeps.
vec4 splineAt(sampler3D coefficients, vec3 texel, vec3 scale, vec3 t) {
    return curvedSplineAt(coefficients, texel, scale, t, vec3(0.0)).sum;
}
