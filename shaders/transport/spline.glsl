// Cubic B-splines in textures: value and gradient from unfiltered look-ups.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/spline.glsl"

struct Curved {
    vec4 sum;    // gradient, value
    vec3 change; // (d·∇)∇
};

// How the coefficients of a row lie in texels. A texel for each cell has all four that it needs; compact, a
// texel has the next four, of which the cell's begin at `offset`, and go on in the texel behind.
struct Rows {
    bool compact;
    int offset;
};

const Rows kPlainRows = Rows(false, 0);

// Weights for the coefficients of a row's texel and of the one behind it.
struct Weights {
    vec4 first, second;
};

Weights weightsOf(vec4 w, Rows rows) {
    if (!rows.compact) return Weights(w, vec4(0.0));
    bool even = rows.offset == 0;
    vec4 first = even ? w : vec4(0.0, w.xyz);
    vec4 second = even ? vec4(0.0) : vec4(w.w, 0.0, 0.0, 0.0);
    bool two = rows.offset == 2;
    if (two || rows.offset == 3) {
        first = two ? vec4(0.0, 0.0, w.xy) : vec4(0.0, 0.0, 0.0, w.x);
        second = two ? vec4(w.zw, 0.0, 0.0) : vec4(w.yzw, 0.0);
    }
    return Weights(first, second);
}

// At t in [0, 1)³ of a cell: gradient and value, and how the gradient changes along d. 16 look-ups of rows,
// unfiltered, where filtered ones would take 8 for the value alone, and a device's filters may be coarse;
// 32 of packed rows. `texel` is the centre of the cell's first one, `scale` 1 / texels.
Curved curvedSplineAt(sampler3D coefficients, Rows rows, vec3 texel, vec3 scale, vec3 t, vec3 d) {
    Weights wx = weightsOf(splineWeights(t.x), rows);
    Weights sx = weightsOf(splineSlopes(t.x), rows);
    Weights bx = weightsOf(splineBends(t.x), rows);
    vec4 wy = splineWeights(t.y);
    vec4 wz = splineWeights(t.z);
    vec4 sy = splineSlopes(t.y);
    vec4 sz = splineSlopes(t.z);
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
            float value = dot(c, wx.first);
            float slope = dot(c, sx.first);
            float bend = dot(c, bx.first);
            if (rows.compact) {
                vec4 behind = textureLod(coefficients, (texel + vec3(1, j, k)) * scale, 0.0);
                value += dot(behind, wx.second);
                slope += dot(behind, sx.second);
                bend += dot(behind, bx.second);
            }
            row += vec3(wy[j] * value, wy[j] * slope, sy[j] * value);
            second += vec3(wy[j] * bend, by[j] * value, sy[j] * slope);
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
vec4 splineAt(sampler3D coefficients, Rows rows, vec3 texel, vec3 scale, vec3 t) {
    return curvedSplineAt(coefficients, rows, texel, scale, t, vec3(0.0)).sum;
}
