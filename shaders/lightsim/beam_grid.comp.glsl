// The cells that a light's map starts with, and their points.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/beam_node.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) writeonly buffer Points { BeamPoint points[]; };
layout(std430, binding = kNodesBuffer) writeonly buffer Nodes { BeamNode nodes[]; };

void main() {
    int item = int(gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6));
    ivec3 levels = params.levels.xyz;
    int edge = levels.x << kAimedLevels;
    int row = 2 * levels.y + 1;
    if (item < row * (2 * levels.z + 1))
        points[item].map = ivec4(packedPlace(ivec2(item % row, item / row) * (edge / 2)), 0, 0, 0);
    if (item >= levels.y * levels.z) return;
    ivec2 cell = ivec2(item % levels.y, item / levels.y);
    uint a = uint(2 * (cell.y * row + cell.x));
    uint b = a + uint(row);
    uint c = b + uint(row);
    BeamNode node;
    node.first = uvec4(a, a + 1u, a + 2u, b);
    node.second = uvec4(b + 1u, b + 2u, c, c + 1u);
    node.place = ivec4(cell * edge, edge, c + 2u);
    node.state = uvec4(0u);
    nodes[item] = node;
}
