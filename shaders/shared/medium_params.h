// Sizes for the kernels that prepare the index field. Read by C++ and GLSL.
// SPDX-License-Identifier: GPL-3.0-or-later
struct MediumParams {
    ivec4 size; // voxels along x, y, z; w: axes, 3
};
