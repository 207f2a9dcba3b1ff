// What a step does to the patches of a wavefront: the light that they leave in voxels, and what becomes
// of them.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A patch carries a flux, spread over it as its corners' weights say. In a step it sweeps from where its
// corners were to where they are: straight rays between both, evenly spread over the patch and shifted
// from step to step, leave flux × length in voxels. Inverted patches do so as well, and so no light is
// lost behind a caustic, where the sources discard them (Ihrke et al. 2007, §5.2.3).
#include "lib/box.glsl"
#include "shared/bindings.h"
#include "shared/front_params.h"
#include "transport/path.glsl"
#include "transport/index_field.glsl" // which steps of rays call for

#if !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || !defined(OPAQUE)
#error CHANNELS must be 1 or 3, MEDIUM 0 to 2, DIRECTION and OPAQUE 0 or 1
#endif
const bool kVolume = true;
const bool kMedium = MEDIUM > 0;    // something absorbs or scatters
const bool kDense = MEDIUM == 2;    // a voxel may have an optical depth above 0.25
const bool kColour = CHANNELS == 3; // media or mirrors' tints differ by wavelength
const bool kDirection = DIRECTION == 1;
const bool kOpaqueVoxels = OPAQUE == 1 && kObjects == 0;
const bool kMeetsAnything = kObjects > 0 || kOpaqueVoxels;

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { FrontParams params; };
layout(std430, binding = kFrontBeforeBuffer) readonly buffer Before { FrontCorner before[]; };
layout(std430, binding = kFrontAfterBuffer) buffer After { FrontCorner after[]; };
layout(std430, binding = kFrontPatchesBuffer) buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFrontDepthsBuffer) readonly buffer Depths { FrontDepth depths[]; };
layout(std430, binding = kFrontHitsBuffer) readonly buffer Hits { FrontHit hits[]; };
layout(std430, binding = kFrontBacksBuffer) writeonly buffer Backs { FrontBack backs[]; };
layout(std430, binding = kFrontEnergyBuffer) buffer Energy { FrontEnergy energy[]; };
layout(std430, binding = kFrontCountersBuffer) buffer Counters { uint counters[]; };
layout(std430, binding = kFrontPlacesBuffer) writeonly buffer Places { uint places[]; };
#include "lightsim/deposit.glsl"

// Four values at a patch's corners, and between them.
struct Bilinear {
    vec3 first;
    vec3 alongU;
    vec3 alongV;
    vec3 twist;
};

Bilinear bilinearOf(vec3 a, vec3 b, vec3 c, vec3 d) {
    return Bilinear(a, b - a, c - a, a - b - c + d);
}

vec3 at(Bilinear values, vec2 p) {
    return values.first + p.x * values.alongU + p.y * (values.alongV + p.x * values.twist);
}

vec3 meanOf(Bilinear values) {
    return at(values, vec2(0.5));
}

// The longer one of opposite edges, along both coordinates [voxel].
vec2 edgesOf(Bilinear place) {
    return vec2(max(length(place.alongU), length(place.alongU + place.twist)),
                max(length(place.alongV), length(place.alongV + place.twist)));
}

// A patch before a step and after it.
struct Sweep {
    Bilinear start;
    Bilinear end;
    Bilinear before; // weights
    Bilinear after;
    vec3 absorbed;  // [1/voxel]
    vec3 scattered;
    bool inside;    // all of it is in the domain
};

bool isAlive(FrontCorner corner) {
    return int(corner.state.x) == kAlive;
}

bool isInside(Bilinear place) {
    vec3 low = min(min(place.first, place.first + place.alongU),
                   min(place.first + place.alongV, place.first + place.alongU + place.alongV + place.twist));
    vec3 high = max(max(place.first, place.first + place.alongU),
                    max(place.first + place.alongV, place.first + place.alongU + place.alongV + place.twist));
    return all(greaterThanEqual(low, vec3(-0.5))) &&
           all(lessThanEqual(high, 2.0 * transport.halfSize.xyz - 0.5));
}

Sweep sweepOf(uint first, uvec4 corner, FrontCorner to[4], FrontDepth depth[4]) {
    Sweep sweep;
    sweep.start = bilinearOf(before[first].place.xyz, before[first + corner.y].place.xyz,
                           before[first + corner.z].place.xyz, before[first + corner.w].place.xyz);
    sweep.before = bilinearOf(before[first].weight.xyz, before[first + corner.y].weight.xyz,
                            before[first + corner.z].weight.xyz, before[first + corner.w].weight.xyz);
    sweep.end = bilinearOf(to[0].place.xyz, to[1].place.xyz, to[2].place.xyz, to[3].place.xyz);
    sweep.after = bilinearOf(to[0].weight.xyz, to[1].weight.xyz, to[2].weight.xyz, to[3].weight.xyz);
    float extent = depth[0].absorbed.w + depth[1].absorbed.w + depth[2].absorbed.w + depth[3].absorbed.w;
    float share = extent > 0.0 ? 1.0 / extent : 0.0;
    sweep.absorbed =
        share * (depth[0].absorbed + depth[1].absorbed + depth[2].absorbed + depth[3].absorbed).xyz;
    sweep.scattered =
        share * (depth[0].scattered + depth[1].scattered + depth[2].scattered + depth[3].scattered).xyz;
    sweep.inside = isInside(sweep.start) && isInside(sweep.end);
    return sweep;
}

// The part of a straight way within the domain.
vec2 partInside(vec3 x, vec3 along) {
    vec2 span = boxSpan(x, along, vec3(-0.5), 2.0 * transport.halfSize.xyz - 0.5);
    return clamp(span, vec2(0.0), vec2(1.0));
}

// The larger one of a patch's channels.
float mostOf(vec3 flux) {
    return kColour ? max(flux.x, max(flux.y, flux.z)) : flux.x;
}

// Rays along both coordinates: as many as its edges call for, unless they would be too faint.
vec2 raysOf(Sweep sweep, float flux) {
    vec2 edges = max(edgesOf(sweep.start), edgesOf(sweep.end));
    vec2 wanted = max(params.detail.x * edges, vec2(1.0));
    float most = max(flux / params.faint.y, 1.0);
    wanted *= min(sqrt(most / (wanted.x * wanted.y)), 1.0);
    return max(ceil(wanted - 0.05), vec2(1.0));
}

// Lays down the light of a sweep. Takes from the flux what media and opaque voxels take.
void layDown(Sweep sweep, bool single, uint seed, inout vec3 flux, inout FrontEnergy sums) {
    vec2 counts = single ? vec2(1.0) : raysOf(sweep, mostOf(flux));
    float rays = counts.x * counts.y;
    vec3 each = flux / (rays * max(meanOf(sweep.before), vec3(1.0e-30)));
    Load load = Load(vec3(0.0), vec3(0.0), fract(0.61803399 * float(seed)), 0u, 0u, 0.5, 1.0, 0u);
    Path path = pathFrom(vec3(0.0), vec3(0.0), 0);
    vec3 stopped = vec3(0.0);
    vec2 number = vec2(0.0);
    for (float i = 0.0; i < rays; i += 1.0) {
        vec2 p = (number + 0.5) / counts;
        number.x += 1.0;
        if (number.x >= counts.x) number = vec2(0.0, number.y + 1.0);
        vec3 x = at(sweep.start, p);
        vec3 along = at(sweep.end, p) - x;
        path.throughput = each * at(sweep.before, p);
        if (!sweep.inside) {
            vec2 part = partInside(x, along);
            if (part.y <= part.x) continue;
            x += part.x * along;
            along *= part.y - part.x;
        }
        if (dot(along, along) < 1.0e-10) continue;
        float share = deposit(path, load, x, along, sweep.absorbed, sweep.scattered);
        if (kOpaqueVoxels && share < 1.0) stopped += path.throughput;
    }
    vec3 absorbed = load.absorbed + stopped;
    if (kMedium || kOpaqueVoxels) {
        flux = max(flux - absorbed - load.scattered, vec3(0.0));
        sums.absorbed.xyz += absorbed;
        sums.scattered.xyz += load.scattered;
    }
    sums.scattered.w += float(load.deposits);
    if (load.fullest >= kNearFull) atomicOr(counters[kFrontNearFull], 1u);
}

// Over all corners.
float brightestOf(Bilinear weight) {
    float near = max(mostOf(weight.first), mostOf(weight.first + weight.alongU));
    float far = max(mostOf(weight.first + weight.alongV),
                    mostOf(weight.first + weight.alongU + weight.alongV + weight.twist));
    return max(near, far);
}

// The larger angle between rays at the ends of opposite edges, along both coordinates [rad], nearly.
vec2 anglesOf(FrontCorner corner[4]) {
    vec3 d[4];
    for (int i = 0; i < 4; ++i) d[i] = normalize(corner[i].wave.xyz);
    return vec2(max(length(d[1] - d[0]), length(d[3] - d[2])), max(length(d[2] - d[0]), length(d[3] - d[1])));
}

// How a patch is cut that has become wide, or soon will.
uint cutOf(vec2 edges, vec2 angles, bool single, float flux) {
    if (single || params.list.w == 0u || flux < params.faint.x) return kFrontGoes;
    edges = max(edges, angles * params.faint.z);
    bvec2 wide = greaterThan(edges, vec2(params.detail.y));
    return wide.x && wide.y ? kFrontSplits : wide.x ? kFrontSplitsU : wide.y ? kFrontSplitsV : kFrontGoes;
}

// What becomes of a patch whose corners disagree: smaller ones, or its middle's ray. It is as large as it
// was before the step, or would be within reach, as at a light.
uint partedBy(Sweep sweep, vec2 angles, float flux) {
    vec2 edges = edgesOf(sweep.start) + params.time.y * angles;
    bool large = max(edges.x, edges.y) > params.detail.z && flux > 0.5 * params.faint.x;
    return large && params.list.w != 0u ? kFrontQuarters : kFrontThins;
}

bool isInSameObjects(FrontCorner to[4]) {
    uvec2 objects = uvec2(0u);
    bool known = false;
    bool same = true;
    for (int i = 0; i < 4; ++i) {
        if (!isAlive(to[i])) continue;
        same = same && (!known || to[i].state.yz == objects);
        objects = to[i].state.yz;
        known = true;
    }
    return same;
}

bool endsAtAnything(FrontCorner corner) {
    return int(corner.state.x) == kMeets || int(corner.state.x) == kStopped;
}

// Whether four corners meet the same and go on the same ways.
bool agree(FrontHit hit[4]) {
    bool same = endsAtAnything(hit[0].end);
    for (int i = 1; i < 4; ++i)
        same = same && hit[i].end.state == hit[0].end.state && hit[i].after == hit[0].after &&
               (hit[i].mirrored.x == 1.0) == (hit[0].mirrored.x == 1.0);
    return same;
}

void addFlux(inout vec4 sum, vec3 flux) {
    sum.xyz += flux;
}

// A patch at an interface: the weights and fluxes of what goes on and of what is reflected. Returns what
// becomes of it.
uint scatter(uint first, FrontHit hit[4], inout FrontPatch part, inout FrontEnergy sums) {
    bool passes = hit[0].after.z == 0u;
    if (!passes && part.state.x >= params.list.z) {
        addFlux(sums.deep, part.flux.xyz);
        return kFrontEnds;
    }
    if (!passes) ++part.state.x;
    vec3 all = vec3(0.0);
    vec3 mirrored = vec3(0.0);
    float most = 0.0;
    float mostBack = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 weight = hit[i].end.weight.xyz;
        vec3 back = hit[i].mirrored.x * weight;
        all += weight;
        mirrored += back;
        most = max(most, mostOf(weight - back));
        mostBack = max(mostBack, mostOf(back * hit[i].mirrored.yzw));
        FrontCorner corner = hit[i].end;
        corner.wave = hit[i].onward;
        corner.weight.xyz = weight - back;
        corner.state = uvec4(kAlive, hit[i].after.xy, 0u);
        after[first + i] = corner;
        backs[first + i] = FrontBack(hit[i].back, vec4(back * hit[i].mirrored.yzw, 0.0));
    }
    vec3 returned = part.flux.xyz * mirrored / max(all, vec3(1.0e-30));
    vec3 onward = part.flux.xyz - returned;
    vec3 tinted = returned * hit[0].mirrored.yzw;
    addFlux(sums.absorbed, returned - tinted);
    bool goes = hit[0].mirrored.x < 1.0;
    bool comesBack = hit[0].mirrored.x > 0.0 || mostBack > 0.0;
    if (goes && most < params.limits.x) {
        addFlux(sums.dim, onward);
        goes = false;
    }
    if (comesBack && mostBack < params.limits.x) {
        addFlux(sums.dim, tinted);
        comesBack = false;
    }
    if (goes && comesBack && (mostOf(part.flux.xyz) < params.faint.w || params.list.w == 0u)) {
        bool stronger = mostOf(onward) >= mostOf(tinted); // too faint to part: all goes that way
        goes = stronger;
        comesBack = !stronger;
        onward += tinted;
        tinted = onward;
    }
    part.state.zw = hit[0].end.state.yz;
    part.flux.xyz = goes ? onward : vec3(0.0);
    part.back.xyz = comesBack ? tinted : vec3(0.0);
    return goes && comesBack ? kFrontParts : goes ? kFrontGoes : comesBack ? kFrontBack : kFrontEnds;
}

// A patch that has met nothing, or all of whose light has come somewhere.
uint goOn(Sweep sweep, FrontCorner to[4], bool single, FrontPatch part, inout FrontEnergy sums) {
    bool left = true;
    for (int i = 0; i < 4; ++i) left = left && int(to[i].state.x) == kLeft;
    if (left) {
        addFlux(sums.escaped, part.flux.xyz);
        return kFrontEnds;
    }
    if (kMedium && brightestOf(sweep.after) < params.limits.y) {
        addFlux(sums.dim, part.flux.xyz);
        return kFrontEnds;
    }
    return cutOf(edgesOf(sweep.end), anglesOf(to), single, mostOf(part.flux.xyz));
}

// New patches that it makes.
uint newOnes(uint becomes) {
    bool two = becomes == kFrontSplitsU || becomes == kFrontSplitsV || becomes == kFrontParts;
    return two ? 1u : becomes == kFrontSplits || becomes == kFrontQuarters ? 3u : 0u;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    takeLine(0u);
    uint number = params.list.y + item;
    FrontPatch part = patches[number];
    places[number] = 0u;
    if (part.state.y == kFrontEnds) return;
    part.back = vec4(0.0);
    FrontEnergy sums = energy[item];
    bool single = part.flux.w == 1.0;
    uint first = 4u * number;
    uvec4 corner = single ? uvec4(0u) : uvec4(0u, 1u, 2u, 3u);
    FrontCorner to[4];
    FrontDepth depth[4];
    for (int i = 0; i < 4; ++i) to[i] = after[first + corner[i]];
    for (int i = 0; i < 4; ++i) depth[i] = depths[4u * item + corner[i]];
    bool met = false;
    FrontHit hit[4];
    if (kMeetsAnything) {
        for (int i = 0; i < 4; ++i) met = met || endsAtAnything(to[i]);
        for (int i = 0; i < 4; ++i) hit[i] = hits[4u * item + corner[i]];
        for (int i = 0; i < 4; ++i) {
            if (met) to[i] = hit[i].end;
            if (met) depth[i] = hit[i].depth;
        }
    }
    Sweep sweep = sweepOf(first, corner, to, depth);
    uint becomes = kFrontEnds;
    bool whole = !kMeetsAnything || (met ? agree(hit) : kObjects == 0 || isInSameObjects(to));
    if (whole) {
        layDown(sweep, single, number, part.flux.xyz, sums);
        if (!met) {
            becomes = goOn(sweep, to, single, part, sums);
        } else if (int(to[0].state.x) == kStopped) {
            addFlux(sums.absorbed, part.flux.xyz);
        } else {
            becomes = scatter(first, hit, part, sums);
        }
    } else {
        FrontCorner from[4];
        for (int i = 0; i < 4; ++i) from[i] = before[first + corner[i]];
        becomes = partedBy(sweep, anglesOf(from), mostOf(part.flux.xyz));
    }
    sums.absorbed.w += 1.0;
    energy[item] = sums;
    part.state.y = becomes;
    patches[number] = part;
    places[number] = newOnes(becomes);
    if (becomes == kFrontEnds) atomicAdd(counters[kFrontEnded], 1u);
    if (becomes > kFrontGoes) atomicOr(counters[kFrontChanged], 1u);
    vec3 left = becomes == kFrontEnds ? vec3(0.0) : part.flux.xyz + part.back.xyz;
    float mean = kColour ? dot(left, vec3(1.0 / 3.0)) : left.x;
    atomicAdd(counters[kFrontFlux], uint(mean * params.limits.w));
}
