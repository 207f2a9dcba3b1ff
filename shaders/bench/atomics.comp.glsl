// The bare deposits that the photon pass is measured against: one atomic add each.
// SPDX-License-Identifier: GPL-3.0-or-later
#extension GL_NV_shader_atomic_float : enable

#ifndef FLOATS
#error FLOATS must be 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { uvec4 params; }; // items, adds an item, mask, stride
#if FLOATS
layout(std430, binding = 0) buffer Sums { float sums[]; };
#else
layout(std430, binding = 0) buffer Sums { uint sums[]; };
#endif

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item >= params.x) return;
    // Each item walks a column of its own, as a beam of photons does.
    for (uint i = 0u; i < params.y; ++i) {
#if FLOATS
        atomicAdd(sums[(item + i * params.w) & params.z], 1.0);
#else
        atomicAdd(sums[(item + i * params.w) & params.z], 1u);
#endif
    }
}
