// One axis of a separable Gaussian over a box of voxels; edges clamp.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sum of differences from the centre, so that a constant stays exactly constant whatever the
// weights' rounding. An item makes several outputs in a row of the axis: the taps k before and k
// behind all of them are two windows that slide by one voxel, one load each, as k grows.
#include "shared/bindings.h"
#include "shared/smooth_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { SmoothParams params; };
layout(std430, binding = kSourceBuffer) readonly buffer Source { float source[]; };
layout(std430, binding = kTargetBuffer) writeonly buffer Target { float target[]; };
layout(std430, binding = kWeightsBuffer) readonly buffer Weights { float weights[]; };

void main() {
    int item = int(gl_GlobalInvocationID.x);
    int a = item % params.counts.x;
    int b = item / params.counts.x;
    int c = int(gl_GlobalInvocationID.y);
    if (b >= params.counts.y) return;
    int row = a * params.strides.x + b * params.strides.y + c * params.strides.z;
    int first = a * params.first.x + b * params.first.y;
    int last = params.counts.w - 1;
    int stride = params.strides.w;

    float centre[kOutputs], before[kOutputs], behind[kOutputs], sum[kOutputs];
    for (int j = 0; j < kOutputs; ++j) {
        centre[j] = source[row + min(first + j, last) * stride];
        before[j] = behind[j] = centre[j];
        sum[j] = 0.0;
    }
    for (int k = 1; k <= params.first.z; ++k) {
        for (int j = kOutputs - 1; j > 0; --j) before[j] = before[j - 1];
        for (int j = 0; j < kOutputs - 1; ++j) behind[j] = behind[j + 1];
        before[0] = source[row + max(first - k, 0) * stride];
        behind[kOutputs - 1] = source[row + min(first + kOutputs - 1 + k, last) * stride];
        float weight = weights[k];
        for (int j = 0; j < kOutputs; ++j) {
            // Not to be contracted or reordered: the same bits on every device.
            precise float both = (before[j] - centre[j]) + (behind[j] - centre[j]);
            precise float term = weight * both;
            precise float next = sum[j] + term;
            sum[j] = next;
        }
    }
    for (int j = 0; j < kOutputs; ++j) {
        precise float result = centre[j] + sum[j];
        if (first + j <= last) target[row + (first + j) * stride] = result;
    }
}
