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
layout(std430, binding = kFrontCornersBuffer) buffer Corners { FrontCorner corners[]; };
layout(std430, binding = kFrontPatchesBuffer) buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFlightsBuffer) readonly buffer Flights { FrontFlight flights[]; };
layout(std430, binding = kHitsBuffer) readonly buffer Hits { FrontHit hits[]; };
layout(std430, binding = kFrontBacksBuffer) writeonly buffer Backs { FrontBack backs[]; };
layout(std430, binding = kFrontBooksBuffer) buffer Books { FrontBooks books[]; };
layout(std430, binding = kFrontCountersBuffer) buffer Counters { uint counters[]; };
layout(std430, binding = kPlacesBuffer) writeonly buffer Places { uint places[]; };
#include "lightsim/deposit.glsl"

const uint kChildren[8] = uint[8](0u, 1u, 2u, 2u, 4u, 2u, 1u, 1u); // of what becomes of a patch

// Four values at a patch's corners, as a polynomial of its coordinates.
struct Spread {
    vec3 first;
    vec3 alongU;
    vec3 alongV;
    vec3 twist;
};

Spread spreadOf(vec3 a, vec3 b, vec3 c, vec3 d) {
    return Spread(a, b - a, c - a, a - b - c + d);
}

vec3 at(Spread spread, vec2 p) {
    return spread.first + p.x * spread.alongU + p.y * (spread.alongV + p.x * spread.twist);
}

vec3 meanOf(Spread spread) {
    return at(spread, vec2(0.5));
}

// The longer one of opposite edges, along both coordinates [voxel].
vec2 edgesOf(Spread place) {
    return vec2(max(length(place.alongU), length(place.alongU + place.twist)),
                max(length(place.alongV), length(place.alongV + place.twist)));
}

// A patch before a step and after it.
struct Sweep {
    Spread start;
    Spread end;
    Spread before; // weights
    Spread after;
    vec3 absorbed;  // [1/voxel]
    vec3 scattered;
    bool inside;    // all of it is in the domain
};

bool isAlive(FrontCorner corner) {
    return int(corner.state.x) == kAlive;
}

Sweep sweepOf(FrontCorner a, FrontCorner b, FrontCorner c, FrontCorner d, FrontFlight to[4]) {
    Sweep sweep;
    sweep.start = spreadOf(a.place.xyz, b.place.xyz, c.place.xyz, d.place.xyz);
    sweep.before = spreadOf(a.weight.xyz, b.weight.xyz, c.weight.xyz, d.weight.xyz);
    sweep.end = spreadOf(to[0].end.place.xyz, to[1].end.place.xyz, to[2].end.place.xyz, to[3].end.place.xyz);
    sweep.after = spreadOf(to[0].end.weight.xyz, to[1].end.weight.xyz, to[2].end.weight.xyz,
                           to[3].end.weight.xyz);
    float extent = to[0].absorbed.w + to[1].absorbed.w + to[2].absorbed.w + to[3].absorbed.w;
    float share = extent > 0.0 ? 1.0 / extent : 0.0;
    sweep.absorbed = share * (to[0].absorbed + to[1].absorbed + to[2].absorbed + to[3].absorbed).xyz;
    sweep.scattered = share * (to[0].scattered + to[1].scattered + to[2].scattered + to[3].scattered).xyz;
    bool starts = isAlive(a) && isAlive(b) && isAlive(c) && isAlive(d);
    ivec4 status = ivec4(to[0].end.state.x, to[1].end.state.x, to[2].end.state.x, to[3].end.state.x);
    sweep.inside = starts && all(notEqual(status, ivec4(kLeft)));
    return sweep;
}

// The part of a straight way within the domain.
vec2 partInside(vec3 x, vec3 along) {
    vec2 span = boxSpan(x, along, vec3(-0.5), 2.0 * transport.halfSize.xyz - 0.5);
    return clamp(span, vec2(0.0), vec2(1.0));
}

// Lays down the light of a sweep. Takes from the flux what media and opaque voxels take.
void layDown(Sweep sweep, bool single, uint patchNumber, inout vec3 flux, inout FrontBooks book) {
    vec2 edges = max(edgesOf(sweep.start), edgesOf(sweep.end));
    vec2 counts = single ? vec2(1.0) : max(ceil(params.detail.x * edges - 0.05), vec2(1.0));
    vec2 shift = single ? vec2(0.5) : params.shift.xy;
    float rays = counts.x * counts.y;
    vec3 each = flux / (rays * max(meanOf(sweep.before), vec3(1.0e-30)));
    Load load = Load(vec3(0.0), vec3(0.0), fract(0.61803399 * float(patchNumber)), 0u, 0u, 0.5, 1.0, 0u);
    Path path = pathFrom(vec3(0.0), vec3(0.0), 0);
    vec3 stopped = vec3(0.0);
    vec2 number = vec2(0.0);
    for (float i = 0.0; i < rays; i += 1.0) {
        vec2 p = (number + shift) / counts;
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
        book.absorbed.xyz += absorbed;
        book.scattered.xyz += load.scattered;
    }
    book.scattered.w += float(load.deposits);
    if (load.fullest >= kNearFull) atomicOr(counters[kFrontNearFull], 1u);
}

float brightestOf(vec3 weight) {
    return kColour ? max(weight.x, max(weight.y, weight.z)) : weight.x;
}

// Over all corners.
float brightestOf(Spread weight) {
    float near = max(brightestOf(weight.first), brightestOf(weight.first + weight.alongU));
    float far = max(brightestOf(weight.first + weight.alongV),
                    brightestOf(weight.first + weight.alongU + weight.alongV + weight.twist));
    return max(near, far);
}

// How a patch of such edges is cut.
uint cutOf(vec2 edges, bool single) {
    if (single || params.list.w == 0u) return kFrontGoes;
    bvec2 wide = greaterThan(edges, vec2(params.detail.y));
    return wide.x && wide.y ? kFrontSplits : wide.x ? kFrontSplitsU : wide.y ? kFrontSplitsV : kFrontGoes;
}

// What becomes of a patch whose corners disagree: smaller ones, or its middle's ray.
uint partedBy(Sweep sweep) {
    vec2 edges = max(edgesOf(sweep.start), edgesOf(sweep.end));
    bool large = max(edges.x, edges.y) > params.detail.z;
    return large && params.list.w != 0u ? kFrontSplits : kFrontThins;
}

bool isInSameObjects(FrontFlight to[4]) {
    uvec2 objects = uvec2(0u);
    bool known = false;
    bool same = true;
    for (int i = 0; i < 4; ++i) {
        if (!isAlive(to[i].end)) continue;
        same = same && (!known || to[i].end.state.yz == objects);
        objects = to[i].end.state.yz;
        known = true;
    }
    return same;
}

bool endsAtAnything(FrontFlight flight) {
    return int(flight.end.state.x) == kMeets || int(flight.end.state.x) == kStopped;
}

// Whether four corners meet the same and go on the same ways.
bool agree(FrontHit hit[4]) {
    bool same = endsAtAnything(hit[0].flight);
    for (int i = 1; i < 4; ++i)
        same = same && hit[i].flight.end.state == hit[0].flight.end.state && hit[i].after == hit[0].after &&
               (hit[i].mirrored.x == 1.0) == (hit[0].mirrored.x == 1.0);
    return same;
}

void book(inout vec4 sum, vec3 flux) {
    sum.xyz += flux;
}

// A patch at an interface: the weights and fluxes of what goes on and of what is reflected. Returns what
// becomes of it.
uint scatter(uint first, Sweep sweep, FrontHit hit[4], bool single, inout FrontPatch part,
             inout FrontBooks books) {
    bool passes = hit[0].after.z == 0u;
    if (!passes && part.state.x >= params.list.z) {
        book(books.deep, part.flux.xyz);
        return kFrontEnds;
    }
    if (!passes) ++part.state.x;
    vec3 all = vec3(0.0);
    vec3 mirrored = vec3(0.0);
    float most = 0.0;
    float mostBack = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 weight = hit[i].flight.end.weight.xyz;
        vec3 back = hit[i].mirrored.x * weight;
        all += weight;
        mirrored += back;
        most = max(most, brightestOf(weight - back));
        mostBack = max(mostBack, brightestOf(back * hit[i].mirrored.yzw));
        FrontCorner corner = hit[i].flight.end;
        corner.wave = hit[i].onward;
        corner.weight.xyz = weight - back;
        corner.state = uvec4(kAlive, hit[i].after.xy, 0u);
        corners[first + i] = corner;
        backs[first + i] = FrontBack(hit[i].back, vec4(back * hit[i].mirrored.yzw, 0.0));
    }
    vec3 returned = part.flux.xyz * mirrored / max(all, vec3(1.0e-30));
    vec3 onward = part.flux.xyz - returned;
    vec3 tinted = returned * hit[0].mirrored.yzw;
    book(books.absorbed, returned - tinted);
    bool goes = hit[0].mirrored.x < 1.0;
    bool comesBack = hit[0].mirrored.x > 0.0 || mostBack > 0.0;
    if (goes && most < params.limits.x) {
        book(books.dim, onward);
        goes = false;
    }
    if (comesBack && mostBack < params.limits.x) {
        book(books.dim, tinted);
        comesBack = false;
    }
    part.state.zw = hit[0].flight.end.state.yz;
    part.flux.xyz = goes ? onward : vec3(0.0);
    part.back.xyz = comesBack ? tinted : vec3(0.0);
    return goes && comesBack ? kFrontParts : goes ? kFrontGoes : comesBack ? kFrontBack : kFrontEnds;
}

// A patch that has met nothing, or all of whose light has come somewhere.
uint goOn(uint first, Sweep sweep, FrontFlight to[4], bool single, inout FrontPatch part,
          inout FrontBooks books) {
    bool left = true;
    for (int i = 0; i < 4; ++i) {
        left = left && int(to[i].end.state.x) == kLeft;
        corners[first + i] = to[i].end;
    }
    if (left) {
        book(books.escaped, part.flux.xyz);
        return kFrontEnds;
    }
    if (kMedium && brightestOf(sweep.after) < params.limits.y) {
        book(books.dim, part.flux.xyz);
        return kFrontEnds;
    }
    return cutOf(edgesOf(sweep.end), single);
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    uint number = params.list.y + item;
    FrontPatch part = patches[number];
    part.back = vec4(0.0);
    FrontBooks sums = books[item];
    bool single = part.flux.w == 1.0;
    uint first = 4u * number;
    uvec4 corner = single ? uvec4(0u) : uvec4(0u, 1u, 2u, 3u);
    FrontFlight to[4];
    for (int i = 0; i < 4; ++i) to[i] = flights[4u * item + corner[i]];
    bool met = false;
    FrontHit hit[4];
    if (kMeetsAnything) {
        for (int i = 0; i < 4; ++i) met = met || endsAtAnything(to[i]);
        for (int i = 0; i < 4; ++i) hit[i] = hits[4u * item + corner[i]];
        for (int i = 0; i < 4; ++i) if (met) to[i] = hit[i].flight;
    }
    Sweep sweep = sweepOf(corners[first], corners[first + corner.y], corners[first + corner.z],
                          corners[first + corner.w], to);
    uint becomes = kFrontEnds;
    bool whole = !kMeetsAnything || (met ? agree(hit) : kObjects == 0 || isInSameObjects(to));
    if (whole) {
        layDown(sweep, single, number, part.flux.xyz, sums);
        if (!met) {
            becomes = goOn(first, sweep, to, single, part, sums);
        } else if (int(to[0].end.state.x) == kStopped) {
            book(sums.absorbed, part.flux.xyz);
        } else {
            becomes = scatter(first, sweep, hit, single, part, sums);
        }
    } else {
        becomes = partedBy(sweep);
    }
    sums.absorbed.w += 1.0;
    books[item] = sums;
    part.state.y = becomes;
    patches[number] = part;
    places[number] = kChildren[becomes];
    vec3 left = becomes == kFrontEnds ? vec3(0.0) : part.flux.xyz + part.back.xyz;
    float mean = kColour ? dot(left, vec3(1.0 / 3.0)) : left.x;
    atomicAdd(counters[kFrontFlux], uint(mean * params.limits.w));
}
