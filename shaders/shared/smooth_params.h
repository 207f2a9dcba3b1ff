// How one axis of a box of voxels is walked. Read by C++ and GLSL.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kOutputs = 8; // that an item makes in a row

struct SmoothParams {
    ivec4 counts;  // items along a, b, c; w: voxels along the axis
    ivec4 strides; // floats from one a, b, c to the next; w: along the axis
    ivec4 first;   // x, y: an item's first output along the axis per a, b; z: radius; w unused
};
