// What a ray sees that leaves the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, is declared.
#include "camera/environment.glsl"

// Radiance from a unit direction in voxel space.
vec3 backgroundLight(vec3 direction) {
    vec3 d = vec3(dot(params.mapFromVoxel0.xyz, direction), dot(params.mapFromVoxel1.xyz, direction),
                  dot(params.mapFromVoxel2.xyz, direction));
    return environmentLight(d, params.background);
}
