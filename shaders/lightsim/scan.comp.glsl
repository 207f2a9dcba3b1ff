// Prefix sums: what is before each count of a list. By runs of kScanRun counts, a work item each: first
// their sums, then, those being scanned in their turn, each run from its own start.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/front_params.h"

#ifndef SUMS
#error SUMS must be 1 to sum runs up, 0 to tell what is before each count
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { uvec4 list; }; // x: counts
layout(std430, binding = kScanCountsBuffer) buffer Counts { uint counts[]; };
layout(std430, binding = kScanSumsBuffer) buffer Sums { uint sums[]; };

void main() {
    uint run = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    uint first = run * uint(kScanRun);
    if (first >= list.x) return;
    uint last = min(first + uint(kScanRun), list.x);
    uint sum = SUMS == 1 ? 0u : sums[run];
    for (uint i = first; i < last; ++i) {
        uint count = counts[i];
        if (SUMS == 0) counts[i] = sum;
        sum += count;
    }
    if (SUMS == 1) sums[run] = sum;
}
