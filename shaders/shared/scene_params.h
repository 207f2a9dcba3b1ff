// What bounds objects, and what they are made of. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

const float kAsOrdinary = -2.0;

// What an object is made of, or what surrounds them all.
struct RegionParams {
    vec4 index;      // x: n; y: 1 if it varies; z: 1 if opaque; w: Cauchy's B [µm²]
    vec4 absorption; // rgb [1/voxel]; w: where coefficients vary, their page's first texel; else −1
    vec4 scattering;  // rgb [1/voxel]; w: g
    vec4 emission;    // rgb [radiance/voxel]; w: where a crystal's absorption of light polarised along its axis
                      // varies, its page's first texel; else −1; kAsOrdinary: it is `absorption`
    vec4 albedo;      // rgb; w: of a crystal 1 if it varies, 2 if its n_o does, too: then `index` and `axis` have
                      // the n_o and n_e that are furthest apart
    vec4 reflectance; // rgb: tint of what its boundary mirrors; w: GGX's α of it
    vec4 metalIndex;      // rgb; w: 1 if it is metal
    vec4 metalExtinction; // rgb
    vec4 axis;          // of a crystal: xyz, of length 1; w: n_e, while `index` has n_o; 0: it is none
    vec4 extraordinary; // rgb: its absorption of light polarised along the axis, while `absorption` has that of
                        // light across it [1/voxel]; w: Cauchy's B of n_e [µm²]
};

// Of many objects: the box of blocks of cells that an object's boundary or inside is in.
struct BlockBox {
    ivec4 low;  // xyz: its first block; w: where its blocks begin in their list
    ivec4 size; // xyz: blocks along x, y, z
};

struct SceneParams {
    vec4 clearance; // xyz: 1 / voxels that the clearances span; w: voxels along a cube's edge
    vec4 texel;     // xyz: 1 / texels of the distances
    vec4 reach;     // xyz: where distances end [voxel]; w: an object's blocks of cells along z, of few
    vec4 page;      // xyz: 1 / texels of coefficients that vary
    vec4 low;       // xyz: low corner of the box that all boundaries are in [voxel]
    vec4 high;      // xyz: its high corner
    vec4 crystals; // xyz: the voxel where coefficients of crystals that vary begin, of a domain's first
    RegionParams regions[kMostObjects + 1]; // of each object, then of what surrounds them
    BlockBox boxes[kMostObjects];           // of each object
};
