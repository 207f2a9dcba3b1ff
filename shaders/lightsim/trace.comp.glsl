// Photons through the volume (Sun et al. 2008, §4.4): along curved paths where the index varies, by Snell's
// and Fresnel's laws at sharp boundaries. Every voxel they cross gets its exact share.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// At an interface a photon goes one way, by its number. A work item carries one photon for some steps;
// survivors go on the next list.
#include "shared/bindings.h"
#include "shared/lightsim_params.h"
#include "transport/integrate.glsl"
#include "transport/interface.glsl"
#include "transport/path.glsl"

#if !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || !defined(VOLUME) || !defined(SURFACES) || \
    !defined(SURFACE_FLOW) || !defined(BOUNCES)
#error CHANNELS must be 1 or 3, MEDIUM 0 to 2, DIRECTION, VOLUME, SURFACES, SURFACE_FLOW, BOUNCES 0 or 1
#endif
const bool kVolume = VOLUME == 1; // voxels receive light
const bool kMedium = MEDIUM > 0;    // something absorbs or scatters
const bool kDense = MEDIUM == 2;    // a voxel may have an optical depth above 0.25
const bool kColour = CHANNELS == 3; // media or mirrors' tints differ by wavelength
const bool kDirection = DIRECTION == 1;

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { PhotonParams params; };
layout(std430, binding = kCountBuffer) buffer Count { uint nextCount; uint overflowed; };
layout(std430, binding = kPhotonsBuffer) buffer Photons { Photon photons[]; };
layout(std430, binding = kObjectsBuffer) buffer InObjects { ObjectSet inObjects[]; }; // of many
#if CRYSTALS > 0
layout(std430, binding = kPolarisationsBuffer) buffer Polarisations { vec4 polarisations[]; }; // w: the mode
#endif
layout(std430, binding = kListBuffer) readonly buffer List { uint list[]; };
layout(std430, binding = kNextListBuffer) writeonly buffer NextList { uint nextList[]; };
#include "lightsim/medium.glsl"
#include "lightsim/deposit.glsl"
#include "lightsim/step_limit.glsl"
#include "lightsim/chance.glsl"
#if BOUNCES == 1
#include "lib/lambert.glsl"
#endif
#if SURFACES == 1
#include "lightsim/surface_deposit.glsl"
#include "transport/opaque_voxels.glsl"
layout(binding = kOpacityFieldUnit) uniform sampler3D opacityField;

float opacityAt(vec3 x) {
    return textureLod(opacityField, coordinate(x), 0.0).x;
}

// A photon's light where it lands, `normal` on either side.
void land(Path path, inout Load load, vec3 x, vec3 normal) {
    if (!isCounted(load)) return;
    ivec3 along = axisVector(axisOf(normal));
    Light light = lightOf(params.limits.z * path.throughput, normalize(path.ray.w), params.colour.xyz);
    uint fullest = putOnSurface(fineVoxelAt(x), along, light, load.phase);
    if (fullest != kMissedSurface) load.fullest = max(load.fullest, fullest);
}

// Opaque voxels stop photons on their faces; the surface is close by.
void landOnVoxels(inout Path path, inout Load load) {
    vec3 direction = normalize(path.ray.w);
    vec3 x = opaqueBetween(path.ray.x - 1.5 * direction, path.ray.x + direction);
    vec3 normal = opaqueNormalAt(x);
    land(path, load, x, normal);
#if BOUNCES == 1
    path.ray.x = x;
    load.outward = normal;
    load.albedo = textureLod(opacityField, coordinate(x - 0.5 * normal), 0.0).yzw;
#endif
}
#endif

const bool kSamples = kVolume || kMedium || kOpaqueVoxels;
const bool kMeasures = false;
const bool kEqualSteps = false;
#include "transport/trace.glsl"

float stepLimit(Ray ray, float n) {
    return leafLimitFrom(ray.x, ray.w / n) / n;
}

// Where coefficients vary within an object they are taken as one over a voxel, elsewhere over a leaf.
float pieceLimit(int region, vec3 x, vec3 direction, float n) {
    return !kMedium                                         ? 1.0e9
           : kObjects == 0                                  ? leafLimitFrom(x, direction)
           : kVaries && coefficientsVaryIn(region) ? 1.0
                                                            : 1.0e9;
}

void fade(inout Path path) {
    float brightest = kColour ? max(path.throughput.x, max(path.throughput.y, path.throughput.z))
                              : path.throughput.x;
    if (path.status == kAlive && brightest < params.limits.y) path.status = kFaded;
}

void onPiece(inout Path path, inout Load load, Piece piece) {
    Extinction medium = extinctionOf(piece, path.mode);
    float share = deposit(path, load, piece.start, piece.along, medium.absorbed, medium.scattered);
    if (kOpaqueVoxels && share < 1.0) {
        path.status = kStopped;
        path.ray.x = piece.start + share * piece.along;
    }
    if (kMedium) fade(path);
}

void onSurface(inout Path path, inout Load load, Interface at) {
#if SURFACES == 1
    land(path, load, at.x, at.normal);
#endif
#if BOUNCES == 1
    load.outward = -at.normal;
    load.albedo = scene.regions[at.there].albedo.xyz;
    if (isCoated(at)) load.albedo = albedoOfCoated(load.albedo, at.beyond / at.n);
#endif
}

// Numbers for a rough interface: of photons that start side by side they lie evenly at the first one.
void chooseFacet(inout Interface at, uint id, int depth) {
    uint seed = pcgHash(params.depth.y + 0x51ED270Bu * uint(depth));
    uint x = id * 3242174889u + seed;
    uint y = id * 2447445414u + pcgHash(seed);
    if (depth > 1) {
        x = pcgHash(id ^ seed);
        y = pcgHash(x);
    }
    at.facetPlace = vec2(uniformOf(x), uniformOf(y));
    at.facetSeed = pcgHash(id + seed);
}

// One of several, by their shares.
Outgoing chosen(inout Load load, Outgoing outgoing[kMostOutgoing], int rays, uint seed) {
    float left = 1.0;
    int taken = 0;
    for (int i = rays - 1; i > 0 && taken == 0; --i) {
        float share = min(outgoing[i].share / left, 1.0);
        if (isWithin(load.chance, load.worth, share, seed + uint(i))) taken = i;
        left = max(left - outgoing[i].share, 1.0e-6);
    }
    return outgoing[taken];
}

void onInterface(inout Path path, inout Load load, Interface at) {
    if (path.depth >= int(params.depth.x)) {
        path.status = kDeep;
    } else {
        ++path.depth;
        if (kRoughBoundaries) chooseFacet(at, load.id, path.depth);
        Outgoing outgoing[kMostOutgoing];
        int rays = scatterAt(at, path.ray.w, path.objects, outgoing);
        Outgoing ray = outgoing[0];
        uint seed = load.id ^ pcgHash(params.depth.y + uint(path.depth));
        if (kCrystals) ray = chosen(load, outgoing, rays, seed);
        else if (rays > 1 && isWithin(load.chance, load.worth, outgoing[1].share, seed)) ray = outgoing[1];
        // A mirror's tint: what it does not send back it has absorbed.
        vec3 sent = path.throughput * ray.tint;
        load.absorbed += path.throughput - sent;
        path.throughput = sent;
        path.ray.w = ray.w;
        path.objects = ray.objects;
        path.departs = ray.departs;
        path.mode = ray.mode;
        path.polarisation = ray.polarisation;
        fade(path);
    }
}

bool onEnd(inout Path path, inout Load load) {
    return false;
}

#if BOUNCES == 1
#include "lightsim/bounce.glsl"
#endif

Path pathOf(Photon photon, uint id) {
    uint steps = BOUNCES == 1 ? photon.count.y & kStepBits : photon.count.y;
    Path path = pathFrom(photon.place.xyz, photon.wave.xyz, int(min(steps + params.list.y, params.list.z)));
    path.throughput = photon.weight.xyz;
    if (kObjects > 0) {
        path.objects = ObjectSet(photon.count.w & 0xFFFFu);
        if (kMany) path.objects = inObjects[id];
        path.depth = int(photon.count.w >> 16u);
        path.departs = photon.place.w;
    }
#if CRYSTALS > 0
    path.mode = int(polarisations[id].w);
    path.polarisation = polarisations[id].xyz;
#endif
    path.steps = int(steps);
    path.error = photon.wave.w;
    // Cut open by the domain's face.
    if (isOpaque(regionOf(path.objects))) path.status = kStopped;
    return path;
}

// As it is kept until the next launch, for which it is listed if it goes on.
void keep(Path path, Load load) {
    Photon photon;
    photon.place = vec4(path.ray.x, path.departs);
    photon.wave = vec4(path.ray.w, path.error);
    photon.weight = vec4(path.throughput, load.phase);
    photon.absorbed = vec4(load.absorbed, load.chance);
    photon.scattered = vec4(load.scattered, load.worth);
    uint steps = uint(path.steps);
#if BOUNCES == 1
    steps |= uint(load.bounces) << kBounceShift;
#endif
    photon.count = uvec4(path.status, steps, load.deposits,
                         firstBits(path.objects) | uint(path.depth) << 16u);
    photons[load.id] = photon;
    if (kMany) inObjects[load.id] = path.objects;
#if CRYSTALS > 0
    polarisations[load.id] = vec4(path.polarisation, float(path.mode));
#endif
    if (path.status == kAlive) nextList[atomicAdd(nextCount, 1u)] = load.id;
    if (load.fullest >= kNearFull) atomicOr(overflowed, 1u);
}

void main() {
    if (gl_GlobalInvocationID.x >= params.list.x) return;
    uint id = list[gl_GlobalInvocationID.x];
    takeLine(lineOf(id));
    Photon photon = photons[id];
    Path path = pathOf(photon, id);
    Load load = Load(photon.absorbed.xyz, photon.scattered.xyz, photon.weight.w, photon.count.z, 0u,
                     photon.absorbed.w, photon.scattered.w, id
#if BOUNCES == 1
                     , int(photon.count.y >> kBounceShift), vec3(0.0), vec3(0.0)
#endif
    );
#if SURFACES == 1
    if (path.status == kStopped) land(path, load, path.ray.x, faceNormal(path.ray.x));
    bool begun = path.status == kAlive;
#endif
    trace(path, load);
#if SURFACES == 1
    if (kOpaqueVoxels && begun && path.status == kStopped) landOnVoxels(path, load);
#endif
    if (path.status == kAlive && path.steps >= int(params.list.z)) path.status = kTrapped;
#if BOUNCES == 1
    if (path.status == kStopped) bounce(path, load);
#endif
    if ((kOpaqueVoxels || kOpaqueObjects) && path.status == kStopped) {
        load.absorbed += path.throughput; // opaque material takes what arrives
#if BOUNCES == 1
        path.throughput = leftOver(path, load); // told apart by its status
#else
        path.throughput = vec3(0.0);
#endif
    }
    keep(path, load);
}
