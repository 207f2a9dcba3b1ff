// Fine voxels that opaque surfaces cross, each with a number: light on surfaces is stored by it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A table by hash finds the record of a voxel of the domain that has any. The record has a word for every 32
// of its fine voxels, x fastest: a bit for each that is one, and the number of the first of those. Both lie in
// textures: software devices read those for all lanes of a vector at once, buffers lane by lane.
#include "shared/bindings.h"
#include "shared/limits.h"
#include "shared/surface_params.h"

layout(std140, binding = kSurfaceBlock) uniform Surface { SurfaceParams surface; };
layout(binding = kSurfaceTableUnit) uniform usampler3D surfaceTable;     // a voxel's place, its record
layout(binding = kSurfaceRecordsUnit) uniform usampler3D surfaceRecords; // words of records

// Where what is stored by number lies in a texture of lists.
ivec3 surfaceTexel(int number) {
    const int row = (1 << kRowBits) - 1;
    return ivec3(number & row, number >> kRowBits & row, number >> 2 * kRowBits);
}

// The fine voxel that holds x [voxel].
ivec3 fineVoxelAt(vec3 x) {
    return ivec3(floor((x + 0.5) * float(surface.size.w)));
}

// The record of a voxel of the domain, or −1.
int surfaceRecordOf(ivec3 voxel) {
    uint key = uint(voxel.x + surface.size.x * (voxel.y + surface.size.y * voxel.z));
    uint slot = key * 2654435769u >> surface.table.y;
    uvec2 entry = texelFetch(surfaceTable, surfaceTexel(int(slot)), 0).xy;
    while (entry.x != key && entry.x != kNoVoxel) {
        slot = (slot + 1u) & surface.table.x;
        entry = texelFetch(surfaceTable, surfaceTexel(int(slot)), 0).xy;
    }
    return entry.x == key ? int(entry.y) : -1;
}

// The bits of a word of a record, and the number of the first of them.
uvec2 surfaceWord(int record, int word) {
    return texelFetch(surfaceRecords, surfaceTexel(record + word), 0).xy;
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
    uvec2 word = surfaceWord(record, place >> 5);
    uint bit = 1u << (place & 31);
    return (word.x & bit) == 0u ? -1 : int(word.y) + bitCount(word.x & (bit - 1u));
}

// The axis along which a surface's columns of fine voxels lie: its normal's longest.
int axisOf(vec3 normal) {
    vec3 steep = abs(normal);
    return steep.x >= steep.y && steep.x >= steep.z ? 0 : steep.y >= steep.z ? 1 : 2;
}

ivec3 axisVector(int axis) {
    return ivec3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
}
