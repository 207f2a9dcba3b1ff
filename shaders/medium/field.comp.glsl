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

// ∂(½n²)/∂axis at a voxel [1/voxel]
float slope(ivec3 p, int axis) {
    int last = params.size[axis] - 1;
    if (last == 0) return 0.0;
    ivec3 unit = ivec3(0);
    unit[axis] = 1;
    if (p[axis] > 0 && p[axis] < last) {
        float a = indexAt(p - unit), b = indexAt(p + unit);
        return 0.25 * (b - a) * (b + a);
    }
    float n0 = indexAt(p);
    ivec3 inward = p[axis] == 0 ? unit : -unit;
    float side = p[axis] == 0 ? 1.0 : -1.0;
    float n1 = indexAt(p + inward);
    if (last == 1) return side * 0.5 * (n1 - n0) * (n1 + n0);
    float n2 = indexAt(p + 2 * inward);
    // −3a + 4b − c over 2, written in differences so that a constant index gives exactly 0
    return side * (0.75 * (n1 - n0) * (n1 + n0) - 0.25 * (n2 - n1) * (n2 + n1)) +
           side * 0.25 * (n1 - n0) * (n1 + n0);
}

vec4 sampleAt(ivec3 p) {
    return vec4(slope(p, 0), slope(p, 1), slope(p, 2), indexAt(p));
}

void main() {
    ivec3 padded = params.size.xyz + 2;
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, padded))) return;
    ivec3 p = texel - 1;
    ivec3 inside = clamp(p, ivec3(0), params.size.xyz - 1);
    vec4 value = sampleAt(inside);
    if (p != inside) {
        // Linear extrapolation from the face and the voxel behind it, along the way outward. The
        // index stays positive whatever the slope.
        ivec3 behind = clamp(2 * inside - p, ivec3(0), params.size.xyz - 1);
        vec4 extended = 2.0 * value - sampleAt(behind);
        extended.w = max(extended.w, 0.25 * value.w);
        value = extended;
    }
    imageStore(field, texel, value);
}
