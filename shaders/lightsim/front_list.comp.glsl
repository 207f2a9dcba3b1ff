// The patches that those of a step become, where they are not one each.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One stays in its place, the others stand behind all that there were, in the order of what they are made
// of. Where a patch is cut new corners stand in the middles of its edges and of itself. An edge is bent as
// the front is, across whose normals, the rays, it runs at both ends.
#include "shared/bindings.h"
#include "shared/front_params.h"
#include "transport/params.glsl"
#include "transport/status.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { FrontParams params; };
layout(std430, binding = kFrontBeforeBuffer) readonly buffer Before { FrontCorner before[]; };
layout(std430, binding = kFrontAfterBuffer) buffer After { FrontCorner after[]; };
layout(std430, binding = kFrontPatchesBuffer) buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFrontBacksBuffer) readonly buffer Backs { FrontBack backs[]; };
layout(std430, binding = kFrontPlacesBuffer) readonly buffer Places { uint places[]; };

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

// The corners of a patch.
struct Quad {
    FrontCorner a;
    FrontCorner b;
    FrontCorner c;
    FrontCorner d;
};

vec3 weightOf(Quad quad) {
    return 0.25 * (quad.a.weight.xyz + quad.b.weight.xyz + quad.c.weight.xyz + quad.d.weight.xyz);
}

void put(uint place, FrontPatch part, Quad quad) {
    part.state.y = kFrontGoes;
    patches[place] = part;
    after[4u * place] = quad.a;
    after[4u * place + 1u] = quad.b;
    after[4u * place + 2u] = quad.c;
    after[4u * place + 3u] = quad.d;
}

// A half of a patch, with the flux that both halves' weights tell.
FrontPatch shareOf(FrontPatch part, vec3 own, vec3 other) {
    part.flux.xyz *= own / max(own + other, vec3(1.0e-30));
    return part;
}

// In two along the first edge; the second half goes to `other`.
void splitU(uint place, uint other, FrontPatch part, Quad quad) {
    FrontCorner low = between(quad.a, quad.b);
    FrontCorner high = between(quad.c, quad.d);
    Quad near = Quad(quad.a, low, quad.c, high);
    Quad far = Quad(low, quad.b, high, quad.d);
    put(place, shareOf(part, weightOf(near), weightOf(far)), near);
    put(other, shareOf(part, weightOf(far), weightOf(near)), far);
}

// In two along the second edge, or in four.
void splitV(uint place, uint other, FrontPatch part, Quad quad, bool both) {
    FrontCorner left = between(quad.a, quad.c);
    FrontCorner right = between(quad.b, quad.d);
    Quad near = Quad(quad.a, quad.b, left, right);
    Quad far = Quad(left, right, quad.c, quad.d);
    FrontPatch first = shareOf(part, weightOf(near), weightOf(far));
    FrontPatch second = shareOf(part, weightOf(far), weightOf(near));
    if (both) {
        splitU(place, other, first, near);
        splitU(other + 1u, other + 2u, second, far);
    } else {
        put(place, first, near);
        put(other, second, far);
    }
}

FrontCorner reflected(uint number, FrontPatch part) {
    FrontCorner corner = after[number];
    corner.wave = backs[number].wave;
    corner.weight = backs[number].weight;
    corner.state.yz = part.state.zw;
    return corner;
}

void reflect(uint place, uint first, FrontPatch part) {
    part.flux.xyz = part.back.xyz;
    put(place, part, Quad(reflected(first, part), reflected(first + 1u, part), reflected(first + 2u, part),
                          reflected(first + 3u, part)));
}

void main() {
    uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (number >= params.list.x) return;
    uint becomes = patches[number].state.y;
    if (becomes == kFrontEnds || becomes == kFrontGoes) return;
    FrontPatch part = patches[number];
    uint other = params.list.w + places[number];
    uint first = 4u * number;
    if (becomes == kFrontParts || becomes == kFrontBack) {
        reflect(becomes == kFrontParts ? other : number, first, part);
        if (becomes == kFrontParts) patches[number].state.y = kFrontGoes;
        return;
    }
    bool asBefore = becomes == kFrontQuarters || becomes == kFrontThins;
    Quad quad;
    if (asBefore) quad = Quad(before[first], before[first + 1u], before[first + 2u], before[first + 3u]);
    else quad = Quad(after[first], after[first + 1u], after[first + 2u], after[first + 3u]);
    if (becomes == kFrontSplitsU) {
        splitU(number, other, part, quad);
    } else if (becomes == kFrontThins) {
        part.flux.w = 1.0;
        FrontCorner middle = between(between(quad.a, quad.b), between(quad.c, quad.d));
        put(number, part, Quad(middle, middle, middle, middle));
    } else {
        splitV(number, other, part, quad, becomes != kFrontSplitsV);
    }
}
