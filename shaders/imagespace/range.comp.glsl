// The least and the greatest depth of the back faces (Oliveira, Brauwers 2007, the second pass): each work item
// reduces a run of texels, all of them together two words. Positive floats compare as their bits do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(binding = kBacksUnit) uniform sampler2DArray backs;
layout(std430, binding = kDepthRangeBuffer) buffer Range { uint least; uint greatest; };

const int kRun = 32;

void main() {
    ivec2 size = textureSize(backs, 0).xy;
    int runs = (size.x + kRun - 1) / kRun;
    int row = int(gl_GlobalInvocationID.x) / runs;
    int first = (int(gl_GlobalInvocationID.x) - row * runs) * kRun;
    float low = 3.0e38;
    float high = 0.0;
    if (row < size.y) {
        for (int x = first; x < min(first + kRun, size.x); ++x) {
            float depth = abs(texelFetch(backs, ivec3(x, row, 0), 0).w);
            if (depth > 0.0) low = min(low, depth);
            high = max(high, depth);
        }
    }
    if (high > 0.0) {
        atomicMin(least, floatBitsToUint(low));
        atomicMax(greatest, floatBitsToUint(high));
    }
}
