// The index field as rays sample it: (½∇(n²), n) per voxel, padded by one voxel all round.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The padding makes plain trilinear look-ups extend the values linearly through the outermost half
// voxel of the domain. Gradients are central differences, at the faces second-order one-sided ones.
#include "shared/medium_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { MediumParams params; };
layout(std430, binding = 0) readonly buffer Index { float index[]; };
layout(rgba32f, binding = 0) writeonly uniform image3D field;

float indexAt(ivec3 p) {
    return index[(p.z * params.size.y + p.y) * params.size.x + p.x];
}

// ∂(½n²)/∂axis at a voxel [1/voxel]: half the difference quotient of n², written in differences so
// that a constant index gives exactly 0. Of the samples n0, n1, n2 the middle one is the voxel's own
// inside, and the first one at a face, where the quotient is second-order one-sided.
float slope(ivec3 p, int axis) {
    int last = params.size[axis] - 1;
    if (last == 0) return 0.0;
    ivec3 unit = ivec3(0);
    unit[axis] = 1;
    bool face = p[axis] == 0 || p[axis] == last;
    float side = p[axis] == last ? -1.0 : 1.0;
    ivec3 first = p - (face ? ivec3(0) : unit);
    ivec3 stride = int(side) * unit;
    float n0 = indexAt(first);
    float n1 = indexAt(first + stride);
    float n2 = last == 1 ? n1 : indexAt(first + 2 * stride);
    float a = 0.25 * (n1 - n0) * (n1 + n0); // a quarter of the difference of n²
    float b = 0.25 * (n2 - n1) * (n2 + n1);
    if (last == 1) return side * 2.0 * a;
    return face ? side * (3.0 * a - b) : a + b;
}

void main() {
    ivec3 padded = params.size.xyz + 2;
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, padded))) return;
    ivec3 p = texel - 1;
    ivec3 inside = clamp(p, ivec3(0), params.size.xyz - 1);
    ivec3 behind = clamp(2 * inside - p, ivec3(0), params.size.xyz - 1);
    // In the padding: linear extrapolation from the face and the voxel behind it, along the way
    // outward, 2 face − behind. The index stays positive whatever the slope. (Loops over a count that
    // the compiler does not know keep the code small: it is compiled on every run.)
    vec4 value = vec4(0.0);
    float own = 0.0;
    int samples = p == inside ? 1 : 2;
    for (int i = 0; i < samples; ++i) {
        ivec3 at = i == 0 ? inside : behind;
        float n = indexAt(at);
        vec4 found = vec4(0.0, 0.0, 0.0, n);
        for (int axis = 0; axis < params.size.w; ++axis) found[axis] = slope(at, axis);
        own = i == 0 ? n : own;
        value = i == 0 ? found : 2.0 * value - found;
    }
    value.w = max(value.w, 0.25 * own);
    imageStore(field, texel, value);
}
