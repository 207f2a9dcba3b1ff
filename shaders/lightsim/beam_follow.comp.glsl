// Cells that go on from an interface, told by the points of the next kind of path: those that go on alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/beam_params.h"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kNodesBuffer) buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kSlotsBuffer) readonly buffer Slots { uint slots[]; };

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    BeamNode node = nodes[item];
    nodes[item].second.x = slots[node.second.x];
    if (node.state.x == 1u) return; // of which the middle is all there is
    for (int i = 0; i < 4; ++i) nodes[item].first[i] = slots[node.first[i]];
    for (int i = 1; i < 4; ++i) nodes[item].second[i] = slots[node.second[i]];
    nodes[item].place.w = int(slots[node.place.w]);
}
