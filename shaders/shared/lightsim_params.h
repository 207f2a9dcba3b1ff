// What the photon kernels are told, and photons. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

struct EmissionParams {
    mat4 clipFromVoxel; // the light's view of one window of its photon map
    vec4 right;         // voxel space; for a point light right, up, forward span its view
    vec4 up;
    vec4 forward; // xyz: directional light's direction of travel, or the view's axis
    vec4 window;  // tangents, or offsets [voxel], at the window's low corner, and its extents
    vec4 origin;  // xyz: the light in voxels; w: 1 if photons start there, 0 at the
                  // map's depth, 2 on the domain's faces
    vec4 low;     // the domain's low corner [voxel]
    vec4 high;    // the domain's high corner [voxel]
    vec4 weight;  // x: 1 for a point light; yzw: the source's share of the batch's unit, rgb
    ivec4 map;    // x, y: pixels of the map; z: the seed; w: its first photon
    ivec4 batch;  // this map's pixels are every z-th of a larger one's, from x, y on
    vec4 axis;    // xyz: about which the source shines (Source::Spread in libcore/lightsim/sources.h),
                  // w: 0 all round, 1 by the cosine about it, 2 in a cone about it
    vec4 cone;    // x, y: the angles between which that fades [rad]; zw: where in its pixel a ray goes
    vec4 polarizer; // xyz: E of what starts lies in the plane of this and the ray; 0: it is unpolarised
    vec4 absorption; // of the medium round all objects, rgb [1/voxel]
    vec4 scattering; // the same
    ivec4 tiles;    // x: edge of tiles of the larger map [pixel], y: tiles along x, 0: all is aimed at
};

struct PhotonParams {
    ivec4 size;   // voxels along x, y, z
    ivec4 first;  // xyz: voxels that the first brick has before them
    ivec4 bricks; // x, y: how far apart bricks along y, z are in the table; z: how many bricks apart
                  // those along z are in the atlas; w: how many texels apart its planes are
    uvec4 list;   // x: photons in the list, y: steps of this launch, or work items of
                  // energy.comp, z: step limit of a photon, w: photons in the map
    uvec4 depth;  // x: most interfaces that a photon meets, y: differs by seed and batch, z: most
                  // times that surfaces send it on
    vec4 limits;  // x: shortest step [voxel], y: a photon dimmer than this is dropped,
                  // z: fixed-point unit of one voxel's length at weight 1
    vec4 colour;  // xyz: the light's RGB over their sum, the weights of its direction
};

struct ResolveParams {
    ivec4 size;   // voxels along x, y, z; w: bricks that receive
    ivec4 first;  // xyz: as PhotonParams::first; w: axis to smooth
    ivec4 bricks; // the domain's bricks along x, y, z; w: as PhotonParams::bricks
    ivec4 atlas;  // the atlases' bricks along x, y, z
    ivec4 apart;  // x: as PhotonParams::bricks.z; y: the same of the atlas of totals, z: of one plane
    vec4 fluence; // per channel: fluence of one unit of fixed point [W/m²]; plain.comp: the source's
                  // irradiance, or intensity over the square of a voxel's edge [W/m²]
    vec4 colour;  // as PhotonParams::colour; w: direction, per unit of fixed point [W/m²]
};

struct Photon {
    vec4 place;     // x [voxel]; w: how steeply it leaves the interface it is on, 0: on none
    vec4 wave;      // w = n dx/ds; w: adaptive, its error so far, estimated [voxel]
    vec4 weight;    // what is left of its power, rgb or the first alone, of one that opaque material has taken what
                    // one more bounce would send on; w: the rounding phase
    vec4 absorbed;  // weight absorbed so far; w: decides which way it goes, in (0, 1)
    vec4 scattered; // weight scattered so far; w: what share of that number's digits is left
    uvec4 count;    // x: its status (kNone...), y: steps, and from bit 24 on bounces, z: deposits, w: of few
                    // objects those it is in, a bit each, and from bit 16 on the interfaces it has met
};

// A batch's energy in weights and numbers, summed up by a work item.
struct EnergySum {
    vec4 remaining; // weight in the photons, whatever their status; w: the largest error [voxel]
    vec4 absorbed;  // w: the mean of rgb of what of it surfaces would send on if they still did
    vec4 scattered;
    vec4 escaped;
    vec4 dropped; // mean of rgb, of photons that: x: met too many interfaces, y: used up their steps,
                  // z: were left when few were, w: had become dim
    uvec4 count;  // photons traced, steps, deposits, trapped
};
