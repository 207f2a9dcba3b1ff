// Where fine voxels that opaque surfaces cross are listed. Read by C++ and GLSL; vec4-sized members
// only. SPDX-License-Identifier: GPL-3.0-or-later

struct SurfaceParams {
    ivec4 size;  // xyz: voxels of the domain; w: fine voxels along an edge of one
    uvec4 table; // x: its entries − 1, y: how far its hash is shifted, z: words of a record,
                 // w: surface voxels in all
};
