// The index field at given points, as rays see it: for tests of what is shipped.
// SPDX-License-Identifier: GPL-3.0-or-later

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { uvec4 params; }; // x: points
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };  // x [voxel]; then w
layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; };   // per point, as C++ names them
#include "transport/index_field.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.x) return;
    vec3 x = points[2u * i].xyz;
    Bend bend = bendAt(x, points[2u * i + 1u].xyz);
    found[3u * i] = fieldAt(x);
    found[3u * i + 1u] = vec4(bend.force, indexAt(x));
    found[3u * i + 2u] = vec4(bend.change, 0.0);
}
