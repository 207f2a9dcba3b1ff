// What an object, or what surrounds them all, does to light on its way through.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included behind medium/surface.glsl. Coefficients are a region's own: no look-up mixes them with
// those beyond its boundary. Most are one number for all of it, and cost no look-up.
#ifndef VARIES
#error VARIES must be 0 or 1
#endif
const bool kVaries = VARIES == 1; // some region's coefficients vary within it
#if VARIES
// A page of padded voxels along z for each region that varies.
layout(binding = 12) uniform sampler3D absorptions; // [1/voxel], g
layout(binding = 13) uniform sampler3D scatterings; // [1/voxel]
layout(binding = 14) uniform sampler3D emissions;   // [radiance/voxel]
#endif

struct Coefficients {
    vec3 absorption; // [1/voxel]
    vec3 scattering; // [1/voxel]
    float g;         // mean cosine of scattering [1]
    vec3 emission;   // [radiance/voxel]
};

bool variesIn(int region) {
    return kVaries && surfaces.regions[region].absorption.w >= 0.0;
}

Coefficients coefficientsAt(int region, vec3 x) {
    RegionParams here = surfaces.regions[region];
    Coefficients found = Coefficients(here.absorption.xyz, here.scattering.xyz, here.scattering.w,
                                      here.emission.xyz);
#if VARIES
    if (here.absorption.w >= 0.0) {
        vec3 at = (x + vec3(1.5, 1.5, 1.5 + here.absorption.w)) * surfaces.page.xyz;
        vec4 absorption = textureLod(absorptions, at, 0.0);
        found = Coefficients(max(absorption.xyz, vec3(0.0)), textureLod(scatterings, at, 0.0).xyz,
                             absorption.w, textureLod(emissions, at, 0.0).xyz);
    }
#endif
    return found;
}
