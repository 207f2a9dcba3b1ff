// Cuts beams into the cells that are laid down, each by a work item of its own: as many along a beam's sides as
// it takes for them to be straight and of one density.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lanes of a vector wait for each other, and beams differ by a hundred times in what there is to be done.
#include "lightsim/beam_node.glsl"
#include "shared/beam_params.h"
#include "shared/bindings.h"

#ifndef DISPERSION
#error DISPERSION must be 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) readonly buffer Points { BeamPoint points[]; };
#if DISPERSION == 1
layout(std430, binding = kShiftedBuffer) readonly buffer Shifted { BeamPoint shifted[]; };
#endif
layout(std430, binding = kNodesBuffer) readonly buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kBeamsBuffer) readonly buffer Beams { uint beams[]; };
layout(std430, binding = kBeamCountsBuffer) buffer Counts { uint counts[]; };
layout(std430, binding = kCellsBuffer) writeonly buffer Cells { uvec2 cells[]; };

const float kLongest = 6.0;  // edge of a cell, if so many cells allow it [fine voxel]
const float kFaint = 2.0; // of a beam that carries what so many fine voxels get by the plain light they may be longer
const int kMostCells = 16;   // cells along a beam: one that bends so much is a guess in any case
const float kDensity = 80.0; // cells along it for a bend as large as itself
const float kFlat = 0.05;    // a bend of so much is none [fine voxel]
const float kChange = 0.05;  // a cell's light, even over it, may change by so much along it
const vec2 kDim = vec2(1.0e-4, 0.05); // beams dimmer than the latter, by the plain light, may be cut coarser, and no
                                      // more so below the former

// Cells along one side of a beam, whose rows have their points `step` apart and begin `row` apart, none
// longer than that. `care`: how much the beam's errors count.
int cellsAlong(vec3 place[9], float weight[9], int step, int row, float longest, float care) {
    float bend = 0.0;
    float change = 0.0;
    float extent = 0.0;
    for (int i = 0; i < 3; ++i) {
        vec3 a = place[i * row];
        vec3 b = place[i * row + step];
        vec3 c = place[i * row + 2 * step];
        bend = max(bend, length(0.5 * (a + c) - b));
        extent = max(extent, length(c - a));
        vec3 along = vec3(weight[i * row], weight[i * row + step], weight[i * row + 2 * step]);
        change = max(change, abs(along.y - along.x) + abs(along.z - along.y));
    }
    float changing = change / (kChange * max(weight[4], 1.0e-20));
    float bending = care * max(kDensity * bend / max(extent, 1.0e-6), sqrt(bend / kFlat));
    float wanted = min(max(bending, care * changing), 1.5 * max(extent, 2.0 * bend));
    return clamp(int(ceil(max(wanted, extent / longest))), 1, kMostCells);
}

// How many places light is laid down at where its wavelengths land at other ones than their middle's: a power of two,
// told by its exponent, so that they are a fine voxel apart in the mean, if as many as may be allow it.
int shiftsOf(BeamNode node) {
#if DISPERSION == 1
    float widest = 0.0;
    for (int i = 0; i < 9; ++i) {
        if (node.state.x == 1u && i != 4) continue;
        BeamPoint point = points[pointOf(node, i)];
        BeamPoint there = shifted[pointOf(node, i)];
        if (landTogether(point, there)) widest = max(widest, distance(point.place.xyz, there.place.xyz));
    }
    float places = (1.0 - params.shifts[0].x) * widest * float(params.size.w);
    return min(int(ceil(log2(max(places, 1.0)))), findMSB(kMostShifts));
#else
    return 0;
#endif
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    uint entry = beams[params.list.y + item];
    BeamNode node = nodes[entry & 0x7FFFFFFFu];
    bool broken = entry >= 0x80000000u;
    ivec2 count = node.state.x == 1u ? ivec2(1) : ivec2(2);
    if (!broken) {
        float fine = float(params.size.w);
        vec3 place[9]; // [fine voxel]
        float weight[9];
        for (int i = 0; i < 9; ++i) {
            BeamPoint point = points[pointOf(node, i)];
            place[i] = point.place.xyz * fine;
            weight[i] = point.weight.x;
        }
        float edge = float(node.place.z) / float(params.levels.x);
        float carries = edge * edge * params.map.x * fine * fine * weight[4];
        float longest = carries < kFaint ? 1.0e9 : kLongest;
        float area = 0.5 * length(cross(place[8] - place[0], place[6] - place[2]));
        float bright = clamp(carries / max(area, 1.0e-20), kDim.x, kDim.y);
        float care = sqrt(sqrt(bright / kDim.y));
        count.x = cellsAlong(place, weight, 1, 3, longest, care);
        count.y = cellsAlong(place, weight, 3, 1, longest, care);
    }
    int shifts = shiftsOf(node);
    // Those of beams from the front, others from the back, so that vectors are of one kind.
    uint all = uint(count.x * count.y) << shifts;
    uint first = atomicAdd(counts[broken ? kBrokenCellCount : kCellCount], all);
    uint i = 0u;
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x)
            for (int k = 0; k < 1 << shifts; ++k) {
                uint at = first + i++;
                cells[broken ? params.list.z - 1u - at : at] = uvec2(entry, packedPart(ivec2(x, y), count, k, shifts));
            }
}
