// Signed distances of a narrow band, looked up a step: a dense texture, bricks by a page table, NanoVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#if !defined(STORE) || !defined(FILTERED)
#error STORE and FILTERED must be defined
#endif
const int kDense = 0;
const int kPaged = 1;
const int kNano = 2;
const int kNearest = 0; // one value a step
const int kByHand = 1;  // eight values, mixed here
const int kByDevice = 2;

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params { uvec4 params; }; // width, height, steps
layout(std430, binding = 0) writeonly buffer Result { float result[]; };
layout(binding = 0) uniform sampler3D dense;
layout(binding = 1) uniform usampler3D pages; // a brick's first texel, 10 bits each, or kNoBrick and its like
layout(binding = 2) uniform sampler3D atlas;  // bricks of 8 voxels and the first of the next

#if STORE == 2
layout(std430, binding = 1) readonly buffer Grid { uint pnanovdb_buf_data[]; };
#define PNANOVDB_GLSL
#include "bench/PNanoVDB.h"
#endif

const uint kNoBrick = 0xFFFFFFFEu; // beyond the band, outside; one more: inside
const float kBeyond = 3.0;

float farOf(uint page) {
    return page == kNoBrick ? kBeyond : -kBeyond;
}

float trilinear(float v[8], vec3 t) {
    vec4 alongX = mix(vec4(v[0], v[2], v[4], v[6]), vec4(v[1], v[3], v[5], v[7]), t.x);
    vec2 alongY = mix(alongX.xz, alongX.yw, t.y);
    return mix(alongY.x, alongY.y, t.z);
}

#if STORE == 2
float valueAt(vec3 x, inout pnanovdb_readaccessor_t accessor) {
    pnanovdb_buf_t buf;
    ivec3 low = ivec3(floor(x));
    float v[8];
    for (int i = 0; i < (FILTERED == 0 ? 1 : 8); ++i) {
        ivec3 at = FILTERED == 0 ? ivec3(floor(x + 0.5)) : low + ivec3(i & 1, i >> 1 & 1, i >> 2);
        pnanovdb_address_t address =
            pnanovdb_readaccessor_get_value_address(PNANOVDB_GRID_TYPE_FLOAT, buf, accessor, at);
        v[i] = pnanovdb_read_float(buf, address);
    }
    return FILTERED == 0 ? v[0] : trilinear(v, x - vec3(low));
}
#else
float valueAt(vec3 x) {
    ivec3 low = ivec3(floor(FILTERED == 0 ? x + 0.5 : x));
    if (STORE == kDense) {
        vec3 size = vec3(textureSize(dense, 0));
        if (FILTERED == kByDevice) return textureLod(dense, (x + 0.5) / size, 0.0).x;
        return texelFetch(dense, low, 0).x;
    }
    uint page = texelFetch(pages, low >> 3, 0).x;
    ivec3 texel = ivec3(page & 1023u, page >> 10 & 1023u, page >> 20 & 1023u) + (low & 7);
    if (page >= kNoBrick) texel = ivec3(0);
    float found;
    if (FILTERED == kNearest) found = texelFetch(atlas, texel, 0).x;
    if (FILTERED == kByDevice)
        found = textureLod(atlas, (vec3(texel) + 0.5 + (x - vec3(low))) / vec3(textureSize(atlas, 0)), 0.0).x;
    if (FILTERED == kByHand) {
        float v[8];
        for (int i = 0; i < 8; ++i) v[i] = texelFetch(atlas, texel + ivec3(i & 1, i >> 1 & 1, i >> 2), 0).x;
        found = trilinear(v, x - vec3(low));
    }
    return page >= kNoBrick ? farOf(page) : found;
}
#endif

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, params.xy))) return;
    float voxels = float(params.z);
    vec3 x = vec3((vec2(pixel) + 0.37) / vec2(params.xy) * 0.9 * voxels, 0.0) + 0.5;
    vec3 step = vec3(0.083, 0.061, 0.98);
    float sum = 0.0;
#if STORE == 2
    pnanovdb_buf_t buf;
    pnanovdb_grid_handle_t grid;
    grid.address = pnanovdb_address_null();
    pnanovdb_root_handle_t root = pnanovdb_tree_get_root(buf, pnanovdb_grid_get_tree(buf, grid));
    pnanovdb_readaccessor_t accessor;
    pnanovdb_readaccessor_init(accessor, root);
#endif
    for (uint i = 0u; i < params.z; ++i) {
#if STORE == 2
        sum += valueAt(x, accessor);
#else
        sum += valueAt(x);
#endif
        x += step;
    }
    result[pixel.y * params.x + pixel.x] = sum;
}
