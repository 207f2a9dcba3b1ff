// The index field at a point, as every path reads it: (½∇(n²) [1/voxel], n) by voxel coordinates.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/field_params.h"
#include "transport/spectrum.glsl"
#include "transport/spline.glsl"
#include "transport/voxels.glsl"

#ifndef FIELD
#error FIELD must be 0 (a constant index), 1 (linear) or 2 (cubic)
#endif
const int kField = FIELD;

layout(std140, binding = kFieldBlock) uniform Field { FieldParams fieldParams; };
#if FIELD > 0
// Linear: (½∇n², n) per voxel, padded by one. Cubic: per texel four spline coefficients along x.
layout(binding = kFieldUnit) uniform sampler3D field; // at 587.6 nm
#if DISPERSION == 1
layout(binding = kDispersedFieldUnit) uniform sampler3D dispersedField; // at kDispersedTerm
#endif
#endif

#if FIELD == 2
// The potential ½(n² − n₀²) is one spline, its gradient the spline's own.
vec4 fieldFrom(sampler3D coefficients, vec4 cubic, vec3 x) {
    // Coefficients reach a voxel beyond the faces.
    vec3 at = clamp(x, vec3(-0.999), fieldParams.high.xyz + 0.999);
    vec3 cell = floor(at);
    vec4 sum = splineAt(coefficients, kPlainRows, cell + 1.5, fieldParams.scale.xyz, at - cell);
    // The potential that steps of τ see is higher by τ²/24 |∇U|².
    float more = 2.0 * sum.w - cubic.y * dot(sum.xyz, sum.xyz); // n² − n₀²
    // Overshoot beside a jump must not make the index vanish.
    more = max(more, cubic.z);
    float n0 = cubic.x;
    // As n₀ and a difference, which keeps the digits of a faint one.
    return vec4(sum.xyz, n0 + more / (n0 + sqrt(n0 * n0 + more)));
}
#elif FIELD == 1
vec4 fieldFrom(sampler3D samples, vec4 cubic, vec3 x) {
    return textureLod(samples, texelAt(x) * fieldParams.scale.xyz, 0.0);
}
#endif

#if FIELD == 0
vec4 fieldAt(vec3 x) {
    return vec4(0.0, 0.0, 0.0, dispersed(fieldParams.scale.w, fieldParams.dispersed.w));
}
#elif DISPERSION == 1
// n, and with it ∇n, is linear in Cauchy's term: of two of its values all others follow.
vec4 fieldAt(vec3 x) {
    vec4 first = fieldFrom(field, fieldParams.cubic, x);
    vec4 second = fieldFrom(dispersedField, fieldParams.dispersed, x);
    float share = cauchyTerm / kDispersedTerm;
    float n = first.w + share * (second.w - first.w);
    vec3 slope = mix(first.xyz / first.w, second.xyz / second.w, share);
    return vec4(n * slope, n);
}
#else
vec4 fieldAt(vec3 x) {
    return fieldFrom(field, fieldParams.cubic, x);
}
#endif

// The index as exactly as the samples tell: what a path begins with.
#if FIELD == 1
// Unbiased samples make the mean of linear interpolation right, not each of its points: where x lies in
// its cell tells how far it is off, by n's second derivatives, and those the eight samples round it.
float indexAt(vec3 x) {
    vec3 cell = clamp(floor(x), vec3(-1.0), fieldParams.high.xyz);
    vec3 t = x - cell;
    float first = fieldAt(cell).w; // what the others differ from it is summed: all digits are kept
    float n = first;
    vec3 curve = vec3(0.0); // ∂²n along each axis
    for (int i = 0; i < 8; ++i) {
        vec3 corner = vec3(i & 1, (i >> 1) & 1, i >> 2);
        vec4 s = fieldAt(cell + corner);
        vec3 weight = mix(1.0 - t, t, corner);
        n += weight.x * weight.y * weight.z * (s.w - first);
        // A difference along an axis, linear in the others.
        curve += (2.0 * corner - 1.0) * weight.yzx * weight.zxy * s.xyz / s.w;
    }
    if (fieldParams.high.w == 1.0) n -= dot(0.5 * t * (1.0 - t) - 1.0 / 12.0, curve);
    return n;
}
#else
float indexAt(vec3 x) {
    return fieldAt(x).w;
}
#endif

// ∇U and its derivative along w, (w·∇)∇U, from two look-ups: what the ends of a run of Verlet steps
// need, in terms of τ² where the second order of these differences does not count.
struct Bend {
    vec3 force;
    vec3 change;
};

Bend bendAt(vec3 x, vec3 w) {
    float e = 0.5 / max(length(w), 1.0e-6);
    vec3 before = fieldAt(x - e * w).xyz;
    vec3 after = fieldAt(x + e * w).xyz;
    return Bend(0.5 * (before + after), (after - before) / (2.0 * e));
}
