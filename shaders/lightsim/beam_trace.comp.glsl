// Points of beams: a light's rays, each along one kind of path to the event that follows it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A kind of path is the list of branches taken at the interfaces met (beam_kind.glsl). Kinds that take as many are
// a generation, traced together. A point goes on from that of the generation before, one interface short of it,
// where that is known, else it starts at the light.
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "lib/attenuation.glsl"
#include "lib/octahedral.glsl"
#include "lib/random.glsl"
#include "transport/integrate.glsl"
#include "transport/interface.glsl"
#include "transport/path.glsl"

#if !defined(CHANNELS) || !defined(MEDIUM) || !defined(EXTENDED)
#error CHANNELS must be 1 or 3, MEDIUM 0 to 2, EXTENDED 0 or 1
#endif
const bool kExtended = EXTENDED == 1; // sources differ by direction
const bool kMedium = MEDIUM > 0;    // something absorbs or scatters
const bool kColour = CHANNELS == 3; // media or mirrors' tints differ by wavelength

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) buffer Points { BeamPoint points[]; };
layout(std430, binding = kParentsBuffer) readonly buffer Parents { BeamPoint parents[]; };
layout(std430, binding = kWantedBuffer) readonly buffer Wanted { uint wanted[]; };
layout(std430, binding = kObjectsBuffer) buffer InObjects { ObjectSet inObjects[]; }; // of many
layout(std430, binding = kParentObjectsBuffer) readonly buffer ParentObjects { ObjectSet parentObjects[]; };
layout(binding = kOpacityFieldUnit) uniform sampler3D opacityField;
#include "lightsim/beam_kind.glsl"
#include "lightsim/beam_node.glsl"
#include "lightsim/medium.glsl"
#include "lightsim/spread.glsl"
#include "lightsim/step_limit.glsl"
#include "transport/opaque_voxels.glsl"

struct Load {
    uint kind;      // of path, that it is to take
    int taken;      // branches taken so far
    uint met;       // hash of what was met
    int object;     // of the boundary that it stopped at
    float mirrored; // share that the interface there reflects; in scenes with crystals, but as an e-wave,
    vec2 extraordinary; // and the shares of e-waves on and back
    vec3 outward;   // normal of the surface it landed on
    vec3 clear;     // opaque voxels: the last point known to be outside them
};

const bool kSamples = kMedium || kOpaqueVoxels;
const bool kMeasures = false;
const bool kEqualSteps = false;
#include "transport/trace.glsl"

float opacityAt(vec3 x) {
    return textureLod(opacityField, coordinate(x), 0.0).x;
}

float stepLimit(Ray ray, float n) {
    return leafLimitFrom(ray.x, ray.w / n) / n;
}

float pieceLimit(int region, vec3 x, vec3 direction, float n) {
    return !kMedium                                ? 1.0e9
           : kObjects == 0                         ? leafLimitFrom(x, direction)
           : kVaries && coefficientsVaryIn(region) ? 1.0
                                                   : 1.0e9;
}

void dim(inout Path path, vec3 sigma, float extent) {
    path.throughput.x *= attenuationOf(sigma.x * extent).through;
    if (kColour) {
        path.throughput.y *= attenuationOf(sigma.y * extent).through;
        path.throughput.z *= attenuationOf(sigma.z * extent).through;
    }
}

// The first point along a piece, looked for every half voxel, that is in opaque voxels; its end if none is.
vec3 opaqueOn(Piece piece, inout Load load, out bool found) {
    int looks = max(int(ceil(2.0 * length(piece.along))), 1);
    vec3 at = piece.start;
    found = false;
    for (int i = 1; i <= looks && !found; ++i) {
        at = piece.start + (float(i) / float(looks)) * piece.along;
        found = opacityAt(at) > 0.5;
        if (!found) load.clear = at;
    }
    return at;
}

void onPiece(inout Path path, inout Load load, Piece piece) {
    float extent = piece.extent;
    bool stops = false;
    vec3 end = piece.start + piece.along;
    if (kOpaqueVoxels) end = opaqueOn(piece, load, stops);
    if (stops) {
        vec3 at = opaqueBetween(load.clear, end);
        extent = max(dot(at - piece.start, piece.direction), 0.0);
        path.status = kStopped;
        path.ray.x = at;
        load.outward = opaqueNormalAt(at);
    }
    if (kMedium) {
        Extinction medium = extinctionOf(piece, path.mode);
        dim(path, medium.absorbed + medium.scattered, extent);
    }
}

void remember(inout Load load, int object, int there) {
    load.met = pcgHash(load.met ^ uint(object + 1 + 128 * (there + 1)));
}

void onSurface(inout Path path, inout Load load, Interface at) {
    remember(load, at.object, at.there);
    load.outward = -at.normal;
}

uint branchOf(Interface at, Outgoing ray) {
    vec3 direction = ray.w;
    int region = regionOf(ray.objects);
    if (isCrystal(region)) direction = rayDirection(uniaxialOf(region, at.x), ray.mode, ray.w);
    return (dot(direction, at.normal) < 0.0 ? 1u : 0u) | (ray.mode == kExtraordinary ? 2u : 0u);
}

// A path's mode and polarisation in one word.
int packedState(Path path) {
    float degree = length(path.polarisation);
    vec2 at = degree > 0.0 ? octahedralOf(path.polarisation / degree) : vec2(0.0);
    uvec2 place = uvec2(round((0.5 + 0.5 * at) * 2047.0));
    return int(uint(path.mode) | uint(round(min(degree, 1.0) * 255.0)) << 2u | place.x << 10u | place.y << 21u);
}

void unpackState(inout Path path, uint state) {
    path.mode = int(state & 3u);
    vec2 at = vec2(state >> 10u & 2047u, state >> 21u) / 2047.0;
    path.polarisation = float(state >> 2u & 255u) / 255.0 * fromOctahedral(2.0 * at - 1.0);
}

// As onInterface(), where there are up to four branches.
void onCrystal(inout Path path, inout Load load, Interface at, Outgoing outgoing[kMostOutgoing], int rays) {
    bool waits = load.taken == int(params.generation.x);
    uint wanted = waits ? 0u : branchAt(load.kind, load.taken);
    vec4 shares = vec4(0.0);
    int taken = -1;
    for (int i = 0; i < rays; ++i) {
        uint branch = branchOf(at, outgoing[i]);
        shares[branch] = outgoing[i].share;
        if (branch == wanted) taken = i;
    }
    if (waits) {
        path.status = path.depth >= int(params.list.w) ? kDeep : kMeets;
        load.object = at.object;
        load.mirrored = shares.y;
        load.extraordinary = shares.zw;
        remember(load, at.object, at.there);
        return;
    }
    ++load.taken;
    ++path.depth;
    remember(load, at.object + 256 * int(wanted), at.there);
    if (taken < 0) path.status = kFaded; // there is no such branch
    Outgoing ray = outgoing[max(taken, 0)];
    path.throughput *= ray.share * ray.tint;
    path.ray.w = ray.w;
    path.objects = ray.objects;
    path.departs = ray.departs;
    path.mode = ray.mode;
    path.polarisation = ray.polarisation;
}

void onInterface(inout Path path, inout Load load, Interface at) {
    Outgoing outgoing[kMostOutgoing];
    int rays = scatterAt(at, path.ray.w, path.objects, outgoing);
    if (kCrystals) {
        onCrystal(path, load, at, outgoing, rays);
        return;
    }
    if (load.taken == int(params.generation.x)) {
        path.status = path.depth >= int(params.list.w) ? kDeep : kMeets;
        load.object = at.object;
        load.mirrored = rays > 1 ? outgoing[1].share : 1.0;
        remember(load, at.object, at.there);
        return;
    }
    bool back = branchAt(load.kind, load.taken) == 1u;
    ++load.taken;
    ++path.depth;
    remember(load, at.object, back ? -1 : at.there);
    if (rays == 1 && !back) path.status = kFaded; // there is no way on
    Outgoing ray = outgoing[0];
    if (back) ray = outgoing[1];
    path.throughput *= ray.share * ray.tint;
    path.ray.w = ray.w;
    path.objects = ray.objects;
    path.departs = ray.departs;
}

bool onEnd(inout Path path, inout Load load) {
    return false;
}

// A ray from the light through a place on its map, if it meets the domain.
Path pathFromLight(ivec2 map) {
    vec2 share = params.batch.xy + params.batch.zw * vec2(map);
    bool point = params.forward.w == 1.0;
    // On the border of a point's window rounding would decide whether a ray meets the domain.
    if (point) share = clamp(share, 1.0e-5, 1.0 - 1.0e-5);
    vec2 at = params.window.xy + params.window.zw * share;
    bool within = params.origin.w == 1.0;
    vec3 direction = params.forward.xyz;
    vec3 x = params.origin.xyz;
    float weight = 1.0;
    if (point) {
        direction = normalize(direction + at.x * params.right.xyz + at.y * params.up.xyz);
        float q = 1.0 / (1.0 + dot(at, at));
        weight = q * sqrt(q); // solid angle over that of a part of the map straight ahead
        if (kExtended) weight *= shareTowards(params.axis, params.cone, direction);
    } else {
        x = at.x * params.right.xyz + at.y * params.up.xyz;
    }
    vec3 high = 2.0 * transport.halfSize.xyz - 0.5;
    Path path = pathFrom(x, direction, 1 << 16);
    path.throughput = vec3(weight);
    if (kExtended && weight == 0.0) {
        path.status = kNone;
        return path;
    }
    if (!within) {
        vec2 span = boxSpan(x, direction, vec3(-0.5), high);
        if (point) span.x = max(span.x, 0.0);
        if (span.x >= span.y) {
            path.status = kNone;
            return path;
        }
        path.ray.x = clampToDomain(x + span.x * direction);
    } else if (isLeaving(path.ray)) { // on a face of the domain: half of its rays go elsewhere
        path.status = kNone;
        return path;
    }
    if (kCrystals) path.polarisation = polarisedAcross(params.polarizer.xyz, direction);
    path.objects = objectsAt(path.ray.x, direction, within);
    path.ray.w *= indexOf(regionOf(path.objects), path.ray.x);
    return path;
}

// From the interface that the kind before stopped at.
Path pathFromParent(uint id, inout Load load) {
    BeamPoint parent = parents[id];
    Path path = pathFrom(parent.place.xyz, parent.wave.xyz, 1 << 16);
    path.throughput = parent.weight.xyz;
    path.objects = ObjectSet(parent.event.w & 0xFFFFu);
    if (kMany) path.objects = parentObjects[id];
    path.depth = int(parent.event.w >> 16u);
    if (kCrystals) unpackState(path, uint(parent.map.w));
    load.met = parent.event.y;
    load.taken = int(params.generation.x) - 1;
    int object = int(parent.event.z);
    if (kObjects > 0 && parent.event.x == uint(kMeets)) {
        Hit hit = Hit(0.0, object, distanceAt(object, path.ray.x).xyz, 0);
        Interface at = interfaceAt(path, hit);
        scatterAndLand(path, load, at, isCoated(at));
    } else {
        path.status = kNone;
    }
    return path;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    takeLine(0u);
    bool goesOn = params.generation.y == 1u;
    uint id = goesOn ? item : params.list.y + item;
    Load load = Load(0u, 0, 1u, -1, 1.0, vec2(0.0), vec3(0.0), vec3(0.0));
    Path path;
    int place;
    if (goesOn) {
        uint parent = wantedPoint(wanted[item]);
        place = parents[parent].map.x;
        load.kind = kindAfter(uint(parents[parent].map.y), int(params.generation.x) - 1, wantedBranch(wanted[item]));
        path = pathFromParent(parent, load);
    } else {
        place = points[id].map.x;
        load.kind = uint(points[id].map.y);
        path = pathFromLight(placeFrom(place));
    }
    load.clear = path.ray.x;
    if (path.status == kAlive) {
        if (isOpaque(regionOf(path.objects)) || (kOpaqueVoxels && opacityAt(path.ray.x) > 0.5)) {
            path.status = kStopped; // cut open by the domain's face
            load.outward = faceNormal(path.ray.x);
        } else {
            trace(path, load);
        }
    }
    if (path.status == kAlive) path.status = kTrapped;
    if (load.taken < int(params.generation.x)) path.status = path.status == kTrapped ? kTrapped : kNone;
    BeamPoint point;
    point.place = vec4(path.ray.x, kCrystals ? load.extraordinary.x : 0.0);
    point.wave = vec4(path.status == kStopped ? load.outward : path.ray.w,
                      kCrystals ? load.extraordinary.y : 0.0);
    point.weight = vec4(path.throughput, load.mirrored);
    point.event = uvec4(path.status, load.met, uint(load.object), firstBits(path.objects) | uint(path.depth) << 16u);
    point.map = ivec4(place, load.kind, packSnorm2x16(octahedralOf(path.ray.w)),
                      kCrystals ? packedState(path) : 0);
    points[id] = point;
    if (kMany) inObjects[id] = path.objects;
}
