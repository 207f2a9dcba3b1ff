// The patches of a wavefront's next step, each made of one of this step.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a patch is cut new corners stand in the middles of its edges and of itself. An edge is bent as
// the front is, across whose normals, the rays, it runs at both ends.
#include "shared/bindings.h"
#include "shared/front_params.h"
#include "transport/params.glsl"
#include "transport/status.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { FrontParams params; };
layout(std430, binding = kFrontCornersBuffer) readonly buffer Corners { FrontCorner corners[]; };
layout(std430, binding = kFrontPatchesBuffer) readonly buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFrontBacksBuffer) readonly buffer Backs { FrontBack backs[]; };
layout(std430, binding = kPlacesBuffer) readonly buffer Places { uint places[]; };
layout(std430, binding = kNextCornersBuffer) writeonly buffer NextCorners { FrontCorner nextCorners[]; };
layout(std430, binding = kNextPatchesBuffer) writeonly buffer NextPatches { FrontPatch nextPatches[]; };

const float kSameTime = 0.25; // clocks so near tell of one front [voxel]

bool isAlive(FrontCorner corner) {
    return int(corner.state.x) == kAlive;
}

bool isOutside(vec3 x) {
    return any(greaterThan(abs(x - (transport.halfSize.xyz - 0.5)), transport.halfSize.xyz));
}

// The objects and the status of a corner between two others: outside the domain those of the one that is
// outside, inside of the other.
uvec4 stateBetween(FrontCorner a, FrontCorner b, vec3 x) {
    if (a.state.x == b.state.x) return a.state;
    if (isAlive(a) || isAlive(b)) return isAlive(a) != isOutside(x) ? a.state : b.state;
    return uvec4(isOutside(x) ? kLeft : kNone, 0u, 0u, 0u);
}

// In the middle between two corners.
FrontCorner between(FrontCorner a, FrontCorner b) {
    FrontCorner middle;
    float na = length(a.wave.xyz);
    float nb = length(b.wave.xyz);
    vec3 da = a.wave.xyz / na;
    vec3 db = b.wave.xyz / nb;
    vec3 edge = b.place.xyz - a.place.xyz;
    middle.place = 0.5 * (a.place + b.place);
    if (abs(a.place.w - b.place.w) < kSameTime && dot(da, db) > 0.5)
        middle.place.xyz += 0.125 * (db * dot(db, edge) - da * dot(da, edge));
    middle.state = stateBetween(a, b, middle.place.xyz);
    float n = !isAlive(a) && isAlive(b) ? nb : isAlive(a) && !isAlive(b) ? na : 0.5 * (na + nb);
    vec3 sum = da + db;
    float size = length(sum);
    middle.wave = vec4(size > 1.0e-6 ? (n / size) * sum : n * da, min(a.wave.w, b.wave.w));
    middle.weight = 0.5 * (a.weight + b.weight);
    return middle;
}

vec3 meanOf(FrontCorner a, FrontCorner b, FrontCorner c, FrontCorner d) {
    return 0.25 * (a.weight.xyz + b.weight.xyz + c.weight.xyz + d.weight.xyz);
}

void put(uint place, FrontPatch part, FrontCorner a, FrontCorner b, FrontCorner c, FrontCorner d) {
    nextPatches[place] = part;
    nextCorners[4u * place] = a;
    nextCorners[4u * place + 1u] = b;
    nextCorners[4u * place + 2u] = c;
    nextCorners[4u * place + 3u] = d;
}

// The first half of a patch, or the second, each with the flux that its corners' weights tell.
FrontPatch halfOf(FrontPatch part, vec3 own, vec3 other) {
    part.flux.xyz *= own / max(own + other, vec3(1.0e-30));
    return part;
}

void splitU(uint place, FrontPatch part, FrontCorner a, FrontCorner b, FrontCorner c, FrontCorner d) {
    FrontCorner low = between(a, b);
    FrontCorner high = between(c, d);
    vec3 near = meanOf(a, low, c, high);
    vec3 far = meanOf(low, b, high, d);
    put(place, halfOf(part, near, far), a, low, c, high);
    put(place + 1u, halfOf(part, far, near), low, b, high, d);
}

void splitV(uint place, FrontPatch part, FrontCorner a, FrontCorner b, FrontCorner c, FrontCorner d,
            bool both) {
    FrontCorner left = between(a, c);
    FrontCorner right = between(b, d);
    vec3 near = meanOf(a, b, left, right);
    vec3 far = meanOf(left, right, c, d);
    FrontPatch low = halfOf(part, near, far);
    FrontPatch high = halfOf(part, far, near);
    if (both) {
        splitU(place, low, a, b, left, right);
        splitU(place + 2u, high, left, right, c, d);
    } else {
        put(place, low, a, b, left, right);
        put(place + 1u, high, left, right, c, d);
    }
}

FrontCorner reflected(uint number, FrontCorner corner, FrontPatch part) {
    corner.wave = backs[number].wave;
    corner.weight = backs[number].weight;
    corner.state.yz = part.state.zw;
    return corner;
}

void reflect(uint place, uint first, FrontPatch part, FrontCorner a, FrontCorner b, FrontCorner c,
             FrontCorner d) {
    part.flux.xyz = part.back.xyz;
    put(place, part, reflected(first, a, part), reflected(first + 1u, b, part),
        reflected(first + 2u, c, part), reflected(first + 3u, d, part));
}

void main() {
    uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (number >= params.list.x) return;
    FrontPatch part = patches[number];
    uint becomes = part.state.y;
    if (becomes == kFrontEnds) return;
    uint place = places[number];
    uint first = 4u * number;
    FrontCorner a = corners[first];
    FrontCorner b = corners[first + 1u];
    FrontCorner c = corners[first + 2u];
    FrontCorner d = corners[first + 3u];
    if (becomes == kFrontSplitsU) splitU(place, part, a, b, c, d);
    else if (becomes == kFrontSplitsV || becomes == kFrontSplits)
        splitV(place, part, a, b, c, d, becomes == kFrontSplits);
    else if (becomes == kFrontThins) {
        part.flux.w = 1.0;
        FrontCorner middle = between(between(a, b), between(c, d));
        put(place, part, middle, middle, middle, middle);
    } else {
        if (becomes != kFrontBack) put(place, part, a, b, c, d);
        if (becomes != kFrontGoes) reflect(place + (becomes == kFrontParts ? 1u : 0u), first, part, a, b, c, d);
    }
}
