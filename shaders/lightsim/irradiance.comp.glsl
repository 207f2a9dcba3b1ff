// Power of surface voxels over area of their surface: irradiance.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Power and area are summed over the column of surface voxels along the surface's steepest axis, so that it
// does not matter how a slanting surface is cut between them: a whole column has the area of its foot over
// the cosine. No other kernel blurs what light draws on a surface.
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "transport/surface_voxels.glsl"

#if !defined(FLUENCE) || !defined(SURFACE_FLOW)
#error FLUENCE must be 1 or 3, SURFACE_FLOW 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { LayoutParams params; };
layout(std430, binding = kVoxelListBuffer) readonly buffer VoxelList { uint voxelList[]; };
layout(std430, binding = kAreasBuffer) readonly buffer Areas { uvec2 areas[]; };
layout(r32f, binding = kSurfacePowerImage) uniform readonly image3D power;         // [W]
layout(r32f, binding = kIrradianceImage) uniform writeonly image3D irradiance; // [W/m²]

const bool kFlow = SURFACE_FLOW == 1;
const int kColumn = 3;          // most surface voxels of a column on either side of one
const float kSameSide = 0.3;    // cosine between normals of one surface
const float kWhole = 0.25;      // share of a column's foot below which neighbours lend theirs

struct Sum {
    vec3 power;
    vec3 flow;  // power times the direction it travels in
    float area; // [face of a voxel]
};

vec3 normalOf(int number) {
    return unpackSnorm4x8(areas[number].y).xyz;
}

void add(inout Sum sum, int number) {
    sum.area += uintBitsToFloat(areas[number].x);
    for (int c = 0; c < FLUENCE; ++c) sum.power[c] += imageLoad(power, surfaceTexel(number + c * params.list.z)).x;
    for (int c = 0; c < 3 && kFlow; ++c)
        sum.flow[c] += imageLoad(power, surfaceTexel(number + (FLUENCE + c) * params.list.z)).x;
}

// Of the column that a fine voxel on a surface of that normal is in.
Sum columnAt(ivec3 fine, int number, ivec3 along, vec3 normal) {
    Sum sum = Sum(vec3(0.0), vec3(0.0), 0.0);
    add(sum, number);
    for (int side = -1; side <= 1; side += 2) {
        bool goes = true;
        for (int step = 1; step <= kColumn && goes; ++step) {
            int other = surfaceVoxelOf(fine + side * step * along);
            goes = other >= 0;
            if (goes) goes = dot(normalOf(other), normal) > kSameSide;
            if (goes) add(sum, other);
        }
    }
    return sum;
}

// The columns next to it, where they are on the same surface.
void addNeighbours(inout Sum sum, ivec3 fine, ivec3 along, vec3 normal) {
    ivec3 u = along.x != 0 ? ivec3(0, 1, 0) : ivec3(1, 0, 0);
    ivec3 v = along.z != 0 ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
    for (int i = 0; i < 9; ++i) {
        if (i == 4) continue;
        ivec3 foot = fine + (i % 3 - 1) * u + (i / 3 - 1) * v;
        for (int step = 0; step < 5; ++step) { // 0, 1, −1, 2, −2
            ivec3 at = foot + ((step & 1) == 1 ? 1 : -1) * ((step + 1) >> 1) * along;
            int other = surfaceVoxelOf(at);
            if (other < 0) continue;
            if (dot(normalOf(other), normal) <= kSameSide) continue;
            Sum column = columnAt(at, other, along, normal);
            sum.power += column.power;
            sum.flow += column.flow;
            sum.area += column.area;
            break;
        }
    }
}

void store(int number, int plane, float power, float area) {
    float found = area > 0.0 ? power / area : 0.0;
    imageStore(irradiance, surfaceTexel(number + plane * params.list.z), vec4(found, 0.0, 0.0, 0.0));
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= uint(params.list.x)) return;
    int edge = params.size.w;
    int place = int(voxelList[item]);
    ivec3 low = edge * ivec3(place % params.size.x, place / params.size.x % params.size.y,
                             place / (params.size.x * params.size.y));
    int record = surfaceRecordOf(low / edge);
    for (int word = 0; word < int(surface.table.z); ++word) {
        uvec2 found = surfaceWord(record, word);
        uint bits = found.x;
        int number = int(found.y);
        while (bits != 0u) {
            int within = 32 * word + findLSB(bits);
            bits &= bits - 1u;
            float row = floor((float(within) + 0.5) / float(edge));
            float slab = floor((row + 0.5) / float(edge));
            ivec3 fine = low + ivec3(within - edge * int(row), int(row) - edge * int(slab), int(slab));
            vec3 normal = normalOf(number);
            ivec3 along = axisVector(axisOf(normal));
            Sum sum = columnAt(fine, number, along, normal);
            if (sum.area * float(edge * edge) < kWhole) addNeighbours(sum, fine, along, normal);
            float area = sum.area * params.weight.w;
            for (int c = 0; c < FLUENCE; ++c) store(number, c, sum.power[c], area);
            for (int c = 0; c < 3 && kFlow; ++c) store(number, FLUENCE + c, sum.flow[c], area);
            ++number;
        }
    }
}
