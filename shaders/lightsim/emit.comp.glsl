// A photon from its pixel of the photon map, if the light reaches it (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lightsim/chance.glsl"
#include "shared/bindings.h"
#include "shared/lightsim_params.h"
#include "transport/path.glsl"
#include "transport/regions.glsl"

#if !defined(EXTENDED)
#error EXTENDED must be 0 or 1
#endif
const bool kExtended = EXTENDED == 1; // sources differ in weight, or by direction

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { EmissionParams params; };
layout(std430, binding = kCountBuffer) buffer Count { uint nextCount; };
layout(std430, binding = kPhotonsBuffer) writeonly buffer Photons { Photon photons[]; };
layout(std430, binding = kObjectsBuffer) writeonly buffer InObjects { ObjectSet inObjects[]; }; // of many
#if CRYSTALS > 0
layout(std430, binding = kPolarisationsBuffer) writeonly buffer Polarisations { vec4 polarisations[]; };
#endif
layout(std430, binding = kListBuffer) writeonly buffer List { uint list[]; };
layout(std430, binding = kAimsBuffer) readonly buffer Aims { uint aims[]; };
layout(binding = kPhotonMapUnit) uniform sampler2D photonMap;
#include "lightsim/spread.glsl"

// The integral of the solid angle from the view's axis to tangents (u, v), a quarter of a pyramid's.
float cornerAngle(float u, float v) {
    return atan(u * v, sqrt(1.0 + u * u + v * v));
}

// The solid angle of a pixel at tangents `at`, over that of one straight ahead of no size. It falls off
// as f = cos³ of the angle from the view's axis. A small pixel averages f to fourth order by its
// second derivatives; a large one takes the exact difference, which would cancel for a small one.
float solidAngleOf(vec2 at, vec2 edge) {
    if (max(edge.x, edge.y) > 0.1) {
        vec2 a = at - 0.5 * edge;
        vec2 b = at + 0.5 * edge;
        return (cornerAngle(b.x, b.y) - cornerAngle(a.x, b.y) - cornerAngle(b.x, a.y) +
                cornerAngle(a.x, a.y)) / (edge.x * edge.y);
    }
    float q = 1.0 / (1.0 + dot(at, at));
    vec2 bend = 15.0 * at * at * q * q - 3.0 * q; // f''/f along both edges
    return q * sqrt(q) * (1.0 + dot(edge * edge, bend) / 24.0);
}

// Every photon has one number that decides which way it goes at interfaces. The numbers are a
// lattice of rank 1 over the whole photon map, x·a + y·b modulo 1, here of 32 bits: in any patch of it
// they lie evenly in (0, 1), so that of neighbours just the share R is reflected, where numbers by
// chance would scatter by √(R (1 − R) N). This a and b, 0.6885 and 0.4172, were the best of 4000 pairs
// for squares of 4 to 32 pixels and R of 0.02 to 0.3: one photon off in a patch, where the powers of the
// plastic number have up to two, and orders that divide squares by four are no better than chance where
// a patch is none of their squares. Seeds shift the lattice.
float chanceAt(ivec2 pixel) {
    uvec2 at = uvec2(pixel * params.batch.z + params.batch.xy);
    return chanceOf(at.x * 2957188063u + at.y * 1791843177u + pcgHash(uint(params.map.z)));
}

// Whether light through a pixel meets nothing.
bool isPlain(ivec2 pixel) {
    if (params.tiles.y == 0) return false;
    ivec2 tile = (pixel * params.batch.z + params.batch.xy) / params.tiles.x;
    return aims[tile.y * params.tiles.y + tile.x] == 0u;
}

// What becomes of a photon that meets nothing [voxel].
Photon passed(Photon photon, float extent) {
    for (int c = 0; c < 3; ++c) {
        float sigmaT = params.absorption[c] + params.scattering[c];
        Attenuation along = attenuationOf(sigmaT * extent);
        float spent = photon.weight[c] * along.mean * extent; // weight times length
        photon.absorbed[c] = params.absorption[c] * spent;
        photon.scattered[c] = params.scattering[c] * spent;
        photon.weight[c] *= along.through;
    }
    photon.count.x = kLeft;
    return photon;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, params.map.xy))) return;
    uint id = uint(pixel.y * params.map.x + pixel.x) + (kExtended ? uint(params.map.w) : 0u);
    takeLine(lineOf(id));
    vec4 met = texelFetch(photonMap, pixel, 0);
    bool startsAtLight = params.origin.w == 1.0;
    bool startsOnFaces = kExtended && params.origin.w == 2.0;
    if (met.w == 0.0 && !startsAtLight && !startsOnFaces) {
        photons[id].count = uvec4(kNone);
        return;
    }

    vec2 at = params.window.xy + params.window.zw * (vec2(pixel) + 0.5) / vec2(params.map.xy);
    vec2 ray = kExtended ? at + (params.cone.zw - 0.5) * params.window.zw / vec2(params.map.xy) : at;
    vec3 direction = params.forward.xyz;
    float weight = 1.0;
    if (params.weight.x == 1.0) {
        direction = normalize(direction + ray.x * params.right.xyz + ray.y * params.up.xyz);
        weight = solidAngleOf(at, params.window.zw / vec2(params.map.xy));
        if (kExtended) weight *= shareTowards(params.axis, params.cone, direction);
    }
    if (kExtended && weight == 0.0) {
        photons[id].count = uvec4(kNone);
        return;
    }
    vec3 x = startsAtLight ? params.origin.xyz : met.xyz;
    if (startsOnFaces) {
        x = params.weight.x == 1.0 ? params.origin.xyz : ray.x * params.right.xyz + ray.y * params.up.xyz;
        vec2 span = boxSpan(x, direction, params.low.xyz, params.high.xyz);
        if (span.x >= span.y || (params.weight.x == 1.0 && span.x < 0.0)) {
            photons[id].count = uvec4(kNone);
            return;
        }
        x += span.x * direction;
    }
    if (any(lessThan(x, params.low.xyz)) || any(greaterThan(x, params.high.xyz))) {
        // A proxy may reach beyond the domain; rounding may put a face's point just outside it.
        vec2 span = boxSpan(x, direction, params.low.xyz, params.high.xyz);
        if (span.x <= span.y && span.y > 0.0) x += max(span.x, 0.0) * direction;
        vec3 inside = clamp(x, params.low.xyz, params.high.xyz);
        if (any(greaterThan(abs(inside - x), vec3(1.0e-2)))) { // more than rounding: it misses
            photons[id].count = uvec4(kNone);
            return;
        }
        x = inside;
    }
    // A light on a face of the domain sends half of its photons elsewhere.
    if (startsAtLight && (any(lessThanEqual(max(x - params.low.xyz, direction), vec3(0.0))) ||
                          any(lessThanEqual(max(params.high.xyz - x, -direction), vec3(0.0))))) {
        photons[id].count = uvec4(kNone);
        return;
    }
    Photon photon;
    photon.place = vec4(x, 0.0);
    photon.wave = vec4(0.0);
    photon.weight = vec4(kExtended ? weight * params.weight.yzw : vec3(weight),
                         uniformOf(pcgHash(id ^ pcgHash(uint(params.map.z)))));
    photon.absorbed = vec4(0.0);
    photon.scattered = vec4(vec3(0.0), 1.0);
    photon.count = uvec4(0u);
    if (isPlain(pixel)) {
        photons[id] = passed(photon, timeToLeave(x, direction, params.low.xyz, params.high.xyz));
        return;
    }
    // A proxy may be an object's own mesh, and then starts are on both sides of the boundary by chance: a
    // voxel before it they would be surely before it, but where light grazes it.
    float back = kObjects == 0 || startsAtLight
                     ? 0.0
                     : min(boxSpan(x, -direction, params.low.xyz, params.high.xyz).y, 1.0);
    ObjectSet objects = objectsAt(x - back * direction, direction, startsAtLight);
    photon.wave = vec4(indexOf(regionOf(objects), x) * direction, 0.0);
    photon.absorbed.w = kObjects > 0 ? chanceAt(pixel) : 0.5;
    photon.count = uvec4(kAlive, 0u, 0u, firstBits(objects));
    if (kMany) inObjects[id] = objects;
    photons[id] = photon;
#if CRYSTALS > 0
    polarisations[id] = vec4(polarisedAcross(params.polarizer.xyz, direction), float(kUnsplit));
#endif
    list[atomicAdd(nextCount, 1u)] = id;
}
