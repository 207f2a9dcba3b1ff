// Fine voxels that opaque surfaces cross, each with a number: light on surfaces is stored by it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A table by hash finds the record of a voxel of the domain that has any. The record holds the number of
// the first of them, and a bit for each of its fine voxels, x fastest.
#include "shared/bindings.h"
#include "shared/limits.h"
#include "shared/surface_params.h"

layout(std140, binding = kSurfaceBlock) uniform Surface { SurfaceParams surface; };
layout(std430, binding = kSurfaceTableBuffer) readonly buffer SurfaceTable { uvec2 surfaceTable[]; };
layout(std430, binding = kSurfaceRecordsBuffer) readonly buffer SurfaceRecords { uint surfaceRecords[]; };

// The fine voxel that holds x [voxel].
ivec3 fineVoxelAt(vec3 x) {
    return ivec3(floor((x + 0.5) * float(surface.size.w)));
}

// The record of a voxel of the domain, or −1.
int surfaceRecordOf(ivec3 voxel) {
    uint key = uint(voxel.x + surface.size.x * (voxel.y + surface.size.y * voxel.z));
    uint slot = key * 2654435769u >> surface.table.y;
    uvec2 entry = surfaceTable[slot];
    while (entry.x != key && entry.x != kNoVoxel) {
        slot = (slot + 1u) & surface.table.x;
        entry = surfaceTable[slot];
    }
    return entry.x == key ? int(entry.y) : -1;
}

// The number of a fine voxel, or −1 where no opaque surface crosses it.
int surfaceVoxelOf(ivec3 fine) {
    int edge = surface.size.w;
    if (any(lessThan(fine, ivec3(0))) || any(greaterThanEqual(fine, surface.size.xyz * edge))) return -1;
    // By floats: software devices divide whole numbers one by one.
    ivec3 voxel = ivec3((vec3(fine) + 0.5) / float(edge));
    int record = surfaceRecordOf(voxel);
    if (record < 0) return -1;
    ivec3 within = fine - voxel * edge;
    int place = (within.z * edge + within.y) * edge + within.x;
    uint bits = surfaceRecords[record + 1 + (place >> 5)];
    uint bit = 1u << (place & 31);
    if ((bits & bit) == 0u) return -1;
    uint before = uint(bitCount(bits & (bit - 1u)));
    for (int word = 0; word < place >> 5; ++word) before += uint(bitCount(surfaceRecords[record + 1 + word]));
    return int(surfaceRecords[record] + before);
}

// Where what is stored by number lies in a texture of lists.
ivec3 surfaceTexel(int number) {
    const int row = (1 << kRowBits) - 1;
    return ivec3(number & row, number >> kRowBits & row, number >> 2 * kRowBits);
}

// The axis along which a surface's columns of fine voxels lie: its normal's longest.
int axisOf(vec3 normal) {
    vec3 steep = abs(normal);
    return steep.x >= steep.y && steep.x >= steep.z ? 0 : steep.y >= steep.z ? 1 : 2;
}

ivec3 axisVector(int axis) {
    return ivec3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
}
