// What the voxelising kernels are told. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

struct StripParams {
    ivec4 size;  // voxels of the strip along x, y, z; w: sub-samples along a voxel's edge
    ivec4 place; // x: first row of the strip [voxel], y: edge of the square view [sample]
};

// One triangle in sub-samples from the domain's low corner: x and y across the axis it is drawn
// along, depth along it.
struct Facet {
    vec4 corners; // x, y of corner a, then of corner b
    vec4 rest;    // x, y of corner c, then the depth's rise per sample along x and y
    vec4 depth;   // at corner a, least, most; w: +1 where the axis enters the solid, else -1
};
