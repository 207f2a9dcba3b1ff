// The patches of a wavefront that have not ended, one behind the other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/front_params.h"

#ifndef MARKS
#error MARKS must be 1 to mark those that go on, 0 to put them together
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { FrontParams params; };
layout(std430, binding = kFrontBeforeBuffer) readonly buffer Before { FrontCorner before[]; };
layout(std430, binding = kFrontAfterBuffer) writeonly buffer After { FrontCorner after[]; };
layout(std430, binding = kFrontPatchesBuffer) readonly buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFrontCompactedBuffer) writeonly buffer Compacted { FrontPatch compacted[]; };
layout(std430, binding = kFrontPlacesBuffer) buffer Places { uint places[]; };

void main() {
    uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (number >= params.list.x) return;
    bool goes = patches[number].state.y != kFrontEnds;
    if (MARKS == 1) {
        places[number] = goes ? 1u : 0u;
    } else if (goes) {
        uint place = places[number];
        compacted[place] = patches[number];
        for (uint i = 0u; i < 4u; ++i) after[4u * place + i] = before[4u * number + i];
    }
}
