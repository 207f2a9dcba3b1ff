// Cells that go on from an interface, one for each branch that they take, told by the points of the next generation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/beam_params.h"
#include "shared/bindings.h"

#ifndef CRYSTALS
#error CRYSTALS must be 0 to 2
#endif
#include "lightsim/beam_kind.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kNodesBuffer) readonly buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kNextNodesBuffer) writeonly buffer NextNodes { BeamNode nextNodes[]; };
layout(std430, binding = kBeamCountsBuffer) buffer Counts { uint counts[]; };
layout(std430, binding = kSlotsBuffer) readonly buffer Slots { uint slots[]; };

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    BeamNode node = nodes[item];
    for (uint branch = 0u; branch < 1u << kBranchBits; ++branch) {
        if ((node.state.y >> branch & 1u) == 0u) continue;
        BeamNode next = node;
        next.state.w = kindAfter(node.state.w, int(params.generation.x), branch);
        next.second.x = slots[wantedAs(node.second.x, branch)];
        if (node.state.x == 0u) { // else its middle is all there is
            for (int i = 0; i < 4; ++i) next.first[i] = slots[wantedAs(node.first[i], branch)];
            for (int i = 1; i < 4; ++i) next.second[i] = slots[wantedAs(node.second[i], branch)];
            next.place.w = int(slots[wantedAs(uint(node.place.w), branch)]);
        }
        nextNodes[atomicAdd(counts[kNextCount], 1u)] = next;
    }
}
