// What a point is made of: an object's medium, or what surrounds them all.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Objects are numbered so that the first of those which hold a point rules it. A path carries one bit
// for each object it is in; what it is in is a state that interfaces change, never looked up anew, so
// that rounding can neither lose a boundary nor make one be met twice. Blurred boundaries are no
// objects: one region is everywhere, and its index and coefficients vary.
//
// Coefficients are a region's own: no look-up mixes them with those beyond its boundary. Most are one
// number for all of it, and cost no look-up.
#include "lib/crystal.glsl"
#include "transport/domain.glsl"
#include "transport/index_field.glsl"
#include "transport/level_set.glsl"

#if !defined(VARIES) || !defined(OPAQUE) || !defined(METALS) || !defined(ROUGH) || !defined(COATS) || \
    !defined(CRYSTALS)
#error VARIES, OPAQUE, METALS, ROUGH, COATS must be 0 or 1, CRYSTALS 0 to 2
#endif
const bool kVaries = VARIES == 1; // some object's coefficients vary within it
const bool kOpaqueObjects = OPAQUE == 1 && kObjects > 0; // some object is opaque
const bool kMetals = METALS == 1; // some object is metal
const bool kRoughBoundaries = ROUGH == 1;   // some object's boundary is rough
const bool kCoats = COATS == 1;   // some matt object's index is above that of what surrounds it
const bool kCrystals = CRYSTALS > 0; // some object is a uniaxial crystal
const bool kVaryingCrystals = CRYSTALS == 2; // some crystal varies within
const bool kOpaqueVoxels = OPAQUE == 1 && kObjects == 0; // blurred: opaque material ends paths
// A page of voxels along z for each region that varies.
layout(binding = kAbsorptionsUnit) uniform sampler3D absorptions; // [1/voxel], g
layout(binding = kScatteringsUnit) uniform sampler3D scatterings; // [1/voxel]
layout(binding = kEmissionsUnit) uniform sampler3D emissions;     // [radiance/voxel]

struct Coefficients {
    vec3 absorption; // [1/voxel]
    vec3 scattering; // [1/voxel]
    float g;         // mean cosine of scattering [1]
    vec3 emission;   // [radiance/voxel]
};

// +1 outside the object, −1 inside: turns its distance into that from this side.
float sideOf(ObjectSet objects, int k) {
    return contains(objects, k) ? -1.0 : 1.0;
}

const float kTouch = 0.1;         // objects this close touch [voxel]

// A point that lies on a boundary or a face is this close to it [voxel].
float roundingAt(vec3 x) {
    return 1.5e-7 * (1.0 + max(x.x, max(x.y, x.z)));
}

// The objects that hold a path's start at x. One that lies on a boundary, or on a face of the domain that a
// boundary lies along, is before the boundary or, if `behind`, past it: the sign of a distance of rounding's
// size tells nothing.
ObjectSet objectsAt(vec3 x, vec3 direction, bool behind) {
    ObjectSet inside = holding(x);
    ObjectSet close = closeTo(x);
    ObjectSet rest = close;
    for (int i = 0; i < slotsOf(close); ++i) {
        int k = objectAt(rest);
        float free = kObjects == 1 ? clearanceAt(x) : 0.0;
        bool holds = free < 0.0;
        if (freeBy(abs(free)) < leastLeap()) {
            vec4 found = distanceAt(k, x);
            float slope = dot(found.xyz, direction);
            float error = liesAlongFace(x, found.xyz) ? kFlush : roundingAt(x);
            bool told = abs(found.w) > error || abs(slope) < 1.0e-5; // or it runs along it
            holds = told ? found.w < 0.0 : (slope < 0.0) == behind;
        }
        inside = changed(inside, k, holds);
    }
    return inside;
}

// The region that rules where these objects are.
int regionOf(ObjectSet objects) {
    return kObjects == 0 ? 0 : firstOf(objects);
}

bool isOpaque(int region) {
    return kOpaqueObjects && scene.regions[region].index.z == 1.0;
}

bool isMetal(int region) {
    return kMetals && scene.regions[region].metalIndex.w == 1.0;
}

// Opaque, and no mirror: light ends there.
bool isMatt(int region) {
    return isOpaque(region) && !isMetal(region);
}

bool indexVariesIn(int region) {
    return kField > 0 && (kObjects == 0 || scene.regions[region].index.y == 1.0);
}

bool isCrystal(int region) {
    return kCrystals && kObjects > 0 && scene.regions[region].axis.w > 0.0;
}

#include "transport/varying_crystal.glsl"

// The index of a region at x; of a crystal n_o, if that varies one of it.
float indexOf(int region, vec3 x) {
    if (kObjects == 0 || indexVariesIn(region)) return indexAt(x);
    return dispersed(scene.regions[region].index.x, scene.regions[region].index.w);
}

// A crystal that does not vary.
Uniaxial evenUniaxialOf(int region) {
    vec4 axis = scene.regions[region].axis;
    return Uniaxial(dispersed(scene.regions[region].index.x, scene.regions[region].index.w),
                    dispersed(axis.w, scene.regions[region].extraordinary.w), axis.xyz);
}

// A crystal at x. What is isotropic there has no axis.
Uniaxial uniaxialOf(int region, vec3 x) {
#if CRYSTALS == 2
    if (crystalVaries(region)) return varyingUniaxialAt(region, x);
#endif
    return evenUniaxialOf(region);
}

// Whether both waves of a crystal go as one, along the o-wave's way: they part by less than 0.01 rad.
bool goesTogether(int region) {
    const float kWeak = 0.01;
    RegionParams here = scene.regions[region];
    bool alike = here.emission.w == kAsOrdinary || (here.emission.w < 0.0 && here.absorption.w < 0.0 &&
                                                    here.extraordinary.xyz == here.absorption.xyz);
    return transport.tolerance.z > 0.0 && abs(here.axis.w - here.index.x) <= kWeak && alike;
}

// The phase that the o-wave gains on the e-wave along a straight way.
float phaseAlong(int region, vec3 direction, float extent) {
    float c = dot(direction, scene.regions[region].axis.xyz);
    return transport.tolerance.z * extent * indexDifference(evenUniaxialOf(region), c) / wavelength();
}

// Where light of wave vector w goes in a region of index n, of length 1; of a crystal that varies but its e-rays.
vec3 directionIn(int region, int mode, vec3 w, float n) {
#if CRYSTALS == 2
    if (crystalVaries(region)) return w / length(w);
#endif
    if (isCrystal(region)) return rayDirection(evenUniaxialOf(region), mode, w);
    return w / n; // devices' roots are not as exact
}

bool coefficientsVaryIn(int region) {
    return kObjects == 0 || (kVaries && scene.regions[region].absorption.w >= 0.0);
}

// Of sharp boundaries; blurred media are the entry file's.
Coefficients coefficientsAt(int region, vec3 x) {
    RegionParams here = scene.regions[region];
    Coefficients found = Coefficients(here.absorption.xyz, here.scattering.xyz, here.scattering.w,
                                      here.emission.xyz);
    if (kVaries && here.absorption.w >= 0.0) {
        vec3 at = (texelAt(x) + vec3(0.0, 0.0, here.absorption.w)) * scene.page.xyz;
        vec4 absorption = textureLod(absorptions, at, 0.0);
        found = Coefficients(max(absorption.xyz, vec3(0.0)), textureLod(scatterings, at, 0.0).xyz,
                             absorption.w, textureLod(emissions, at, 0.0).xyz);
    }
    return found;
}

// σ of light polarised along a crystal's axis, where that across it is `across` [1/voxel].
vec3 absorptionAlongAxis(int region, vec3 x, vec3 across) {
    RegionParams here = scene.regions[region];
    if (here.emission.w == kAsOrdinary) return across;
    if (kVaries && here.emission.w >= 0.0) {
        vec3 at = (texelAt(x) + vec3(0.0, 0.0, here.emission.w)) * scene.page.xyz;
        return max(textureLod(absorptions, at, 0.0).xyz, vec3(0.0));
    }
    return here.extraordinary.xyz;
}

// The same of light of a mode along a direction.
Coefficients coefficientsFor(int mode, int region, vec3 x, vec3 direction) {
    Coefficients found = coefficientsAt(region, x);
    if (isCrystal(region) && mode == kExtraordinary) {
        Uniaxial crystal = uniaxialOf(region, x);
        found.absorption = extraordinaryLoss(crystal, dot(direction, crystal.axis), found.absorption,
                                             absorptionAlongAxis(region, x, found.absorption));
    }
    return found;
}
