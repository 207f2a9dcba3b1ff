// What a piece of a light's path goes through.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entry file says by kMedium and kColour what there is to look up.

layout(binding = kAbsorptionUnit) uniform sampler3D absorption; // padded by one; grey: (σ_a, σ_s) [1/voxel]
layout(binding = kScatteringUnit) uniform sampler3D scattering; // colour only

struct Extinction {
    vec3 absorbed;  // σ_a [1/voxel]
    vec3 scattered; // σ_s [1/voxel]
};

Extinction extinctionOf(Piece piece, int mode) {
    Extinction found = Extinction(vec3(0.0), vec3(0.0));
    if (kMedium && kObjects == 0) {
        vec3 at = coordinate(piece.middle);
        vec4 a = textureLod(absorption, at, 0.0);
        found.absorbed = kColour ? a.xyz : vec3(a.x);
        found.scattered = kColour ? textureLod(scattering, at, 0.0).xyz : vec3(a.y);
    } else if (kMedium) {
        Coefficients here = coefficientsFor(mode, piece.region, piece.middle, piece.direction);
        found = Extinction(here.absorption, here.scattering);
    }
    return found;
}
