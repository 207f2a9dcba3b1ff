// Sums the changes along each column: how many sub-samples of each voxel lie inside.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/voxelize_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { StripParams params; };
layout(std430, binding = kChangesBuffer) buffer Changes { int changes[]; };

void main() {
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (column.x >= params.size.x || column.y >= params.size.y) return;
    int most = params.size.w * params.size.w * params.size.w;
    int at = (column.y * params.size.x + column.x) * params.size.z;
    int sum = 0;
    for (int z = 0; z < params.size.z; ++z, ++at) {
        sum += changes[at];
        // Shells that overlap count as one solid: inside is where the winding number is not 0.
        changes[at] = clamp(sum, 0, most);
    }
}
