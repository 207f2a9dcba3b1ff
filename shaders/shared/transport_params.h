// What the transport core is told: the domain, and how long steps may be. Read by C++ and GLSL;
// vec4-sized members only. SPDX-License-Identifier: GPL-3.0-or-later

struct TransportParams {
    vec4 halfSize;  // xyz: half the domain's size [voxel]
    vec4 scale;     // xyz: 1 / texels of textures of voxels
    vec4 steps;     // x: longest dτ, y: adaptive, shortest dτ, z: by stages, first dτ,
                    // w: longest step [voxel]
    vec4 tolerance; // adaptive, x: error allowed where a path leaves, y: length of a crossing [voxel];
                    // z: of a voxel's edge 2π lengths of a wave of 1 µm; 0: modes keep no phases [rad µm]
};
