// Four cells in place of one, with the points that they need beside its own.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/beam_node.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) writeonly buffer Points { BeamPoint points[]; };
layout(std430, binding = kNodesBuffer) readonly buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kSplitsBuffer) readonly buffer Splits { uint splits[]; };
layout(std430, binding = kNextNodesBuffer) writeonly buffer NextNodes { BeamNode nextNodes[]; };

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    BeamNode node = nodes[splits[params.list.y + item]];
    uint known[9] = uint[9](node.first.x, node.first.y, node.first.z, node.first.w, node.second.x,
                            node.second.y, node.second.z, node.second.w, uint(node.place.w));
    // All four children's points: five by five, of which every other one is known.
    uint next = params.list.z + kNewPoints * item;
    int step = node.place.z / 4;
    uint all[25];
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i) {
            bool isKnown = ((i | j) & 1) == 0;
            all[5 * j + i] = isKnown ? known[3 * (j >> 1) + (i >> 1)] : next;
            if (!isKnown) points[next++].map = ivec4(packedPlace(node.place.xy + step * ivec2(i, j)), node.state.w, 0, 0);
        }
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            int a = 10 * j + 2 * i;
            BeamNode child;
            child.first = uvec4(all[a], all[a + 1], all[a + 2], all[a + 5]);
            child.second = uvec4(all[a + 6], all[a + 7], all[a + 10], all[a + 11]);
            child.place = ivec4(node.place.xy + 2 * step * ivec2(i, j), 2 * step, all[a + 12]);
            child.state = uvec4(0u, 0u, 0u, node.state.w);
            nextNodes[4u * item + uint(2 * j + i)] = child;
        }
}
