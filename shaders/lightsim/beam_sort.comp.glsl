// What becomes of each cell of the light's map: it is laid down, goes on from an interface, is split, or ends.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell is a beam where its nine points met the same boundaries in the same order, and what is between them
// follows from them (Liktor and Dachsbacher 2011 split by the same two). One that is not worth splitting any
// more is laid down, or goes on, as what its points are.
#include "lightsim/beam_node.glsl"
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "shared/limits.h"
#include "transport/status.glsl"

#if !defined(CHANNELS) || !defined(CULLS) || !defined(CRYSTALS) || !defined(DISPERSION)
#error CHANNELS must be 1 or 3, CULLS and DISPERSION 0 or 1, CRYSTALS 0 to 2
#endif
const bool kCrystals = CRYSTALS > 0; // an interface has four branches
const bool kCulls = CULLS == 1; // some surfaces receive nothing

#include "lightsim/beam_kind.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) readonly buffer Points { BeamPoint points[]; };
layout(std430, binding = kBranchesBuffer) buffer Branches { uint branches[]; };
layout(std430, binding = kNodesBuffer) readonly buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kBeamsBuffer) writeonly buffer Beams { uint beams[]; };
layout(std430, binding = kSplitsBuffer) writeonly buffer Splits { uint splits[]; };
layout(std430, binding = kNextNodesBuffer) writeonly buffer NextNodes { BeamNode nextNodes[]; };
layout(std430, binding = kBeamCountsBuffer) buffer Counts { uint counts[]; };
layout(std430, binding = kBooksBuffer) buffer Books { uint books[]; };
layout(std430, binding = kWantedBuffer) writeonly buffer Wanted { uint wanted[]; };
layout(std430, binding = kSlotsBuffer) writeonly buffer Slots { uint slots[]; };

#if CULLS == 1
layout(std430, binding = kReceivingBuffer) readonly buffer Receiving { uint receiving[]; };
#if DISPERSION == 1
layout(std430, binding = kShiftedBuffer) readonly buffer Shifted { BeamPoint shifted[]; };
#endif
#endif

const int kSmallest = 2; // edge of a cell whose middle is a place on the map

// A beam's inside is a polynomial of second degree through its points. How far it bends from its corners' mean
// may be so much of its extent: what third order adds to its density goes with the square of that. Where light is
// spread so thin that it adds little to what falls on surfaces, more will do.
const float kMostBend = 0.3;
const float kCreasedBend = 0.03; // where what it falls on is no smooth surface: a box's edge is no polynomial
const float kSmooth = 0.9;       // cosine between normals of a smooth one
const float kFaint = 0.01; // share of the light's own irradiance below which it makes no difference
// A cell is split if its share of the light, times its edge, is so much: half the edge, twice the share. Of cells
// whose rays part behind interfaces there are many, along lines: there it is the share of a whole cell's light, which
// for lines gives the least error for as many cells.
const float kWorth = 0.01;
const float kBrokenWorth = 0.006;
const float kFlat = 0.1;   // a bend of so much of a fine voxel is none
const float kDot = 0.25;   // an extent of so much of one is a point,
const int kTold = 3;       // if so many points tell it

float brightest(vec3 weight) {
    return CHANNELS == 3 ? max(weight.x, max(weight.y, weight.z)) : weight.x;
}

void enter(int book, vec3 power) {
    uint slot = (gl_WorkGroupID.x + gl_WorkGroupID.y) % uint(kBookSlots);
    uint first = (slot * uint(kBooks) + uint(book)) * 3u;
    for (int c = 0; c < CHANNELS; ++c)
        if (power[c] > 0.0) atomicAdd(books[first + uint(c)], uint(power[c] * kBookUnit + 0.5));
}

int bookOf(int status) {
    return status == kStopped   ? kBookLanded
           : status == kLeft    ? kBookLeft
           : status == kDeep    ? kBookDeep
           : status == kTrapped ? kBookTrapped
                                : -1;
}

void want(uint point, uint bits) {
    uint fresh = bits & ~atomicOr(branches[point], bits);
    for (uint branch = 0u; branch < 1u << kBranchBits; ++branch) {
        if ((fresh >> branch & 1u) == 0u) continue;
        uint slot = atomicAdd(counts[kWantedCount], 1u);
        wanted[slot] = wantedAs(point, branch);
        slots[wantedAs(point, branch)] = slot;
    }
}

// Whether a brick that this box [voxel] reaches into holds surface voxels.
bool isReceived(vec3 low, vec3 high) {
#if CULLS == 1
    const int kMostBricks = 64; // asked for
    ivec3 bricks = (params.size.xyz + kBrickEdge - 1) >> kBrickBits;
    ivec3 from = clamp(ivec3(floor(low + 0.5)) >> kBrickBits, ivec3(0), bricks - 1);
    ivec3 to = clamp(ivec3(floor(high + 0.5)) >> kBrickBits, ivec3(0), bricks - 1);
    ivec3 count = to - from + 1;
    if (count.x * count.y * count.z > kMostBricks) return true;
    bool any = false;
    for (int z = from.z; z <= to.z && !any; ++z)
        for (int y = from.y; y <= to.y && !any; ++y)
            for (int x = from.x; x <= to.x && !any; ++x) {
                int brick = (z * bricks.y + y) * bricks.x + x;
                any = (receiving[brick >> 5] >> (brick & 31) & 1u) == 1u;
            }
    return any;
#else
    return true;
#endif
}

// How far from a point its light may be laid down [voxel].
float reachOf(uint id) {
#if CULLS == 1 && DISPERSION == 1
    BeamPoint there = shifted[id];
    if (landTogether(points[id], there))
        return 1.0 + max(1.0, -params.shifts[0].x) * distance(points[id].place.xyz, there.place.xyz);
#endif
    return 1.0;
}

// Whether nothing more becomes of a point's light: it is on its way nowhere, or on a surface that none asks for.
bool isIdle(BeamPoint point, float reach) {
    int status = int(point.event.x);
    if (kCulls && status == kStopped) return !isReceived(point.place.xyz - reach, point.place.xyz + reach);
    return status != kStopped && status != kMeets;
}

// Whether the map is aimed at a part of a cell: what its points say of it is not enough, since bodies may lie
// between them.
bool isAimedAt(BeamNode node) {
    vec2 low = vec2(node.place.xy);
    vec2 high = low + float(node.place.z);
    bool any = false;
    for (int i = 0; i < kMostAims; ++i)
        any = any || (all(lessThan(low, params.aims[i].zw)) && all(greaterThan(high, params.aims[i].xy)));
    return any;
}

// What of a point's light an interface sends on, but as e-waves.
float shareOn(BeamPoint point) {
    float back = point.weight.w;
    if (kCrystals) back += point.place.w + point.wave.w;
    return 1.0 - back;
}

// The shares of e-waves, on and back.
vec2 sharesOfE(BeamPoint point) {
    return kCrystals ? vec2(point.place.w, point.wave.w) : vec2(0.0);
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    item += params.list.y;
    BeamNode node = nodes[item];
    bool single = node.state.x == 1u;
    BeamPoint middle = points[node.second.x];
    int status = int(middle.event.x);
    float edge = float(node.place.z) / float(params.levels.x);
    float area = edge * edge;
    bool agree = true;
    float farthest = reachOf(node.second.x);
    bool idle = isIdle(middle, farthest);
    int idlePoints = idle ? 1 : 0;
    vec3 low = middle.place.xyz;
    vec3 high = low;
    vec3 corner[4];
    bool smoothly = true;
    float on = brightest(middle.weight.xyz) * shareOn(middle);
    vec2 ofE = brightest(middle.weight.xyz) * sharesOfE(middle);
    float back = brightest(middle.weight.xyz) * middle.weight.w;
    int landed = status == kStopped && single ? 1 : 0;
    float share = brightest(middle.weight.xyz); // of the light, the largest of its points'
    for (int i = 0; i < 9 && !single; ++i) {
        BeamPoint point = points[pointOf(node, i)];
        int its = int(point.event.x);
        agree = agree && its == status && point.event.y == middle.event.y;
        if (i != 4) {
            float reach = reachOf(pointOf(node, i));
            bool leadsNowhere = isIdle(point, reach);
            farthest = max(farthest, reach);
            idle = idle && leadsNowhere;
            idlePoints += leadsNowhere ? 1 : 0;
        }
        if (its == kStopped) {
            low = landed > 0 ? min(low, point.place.xyz) : point.place.xyz;
            high = landed > 0 ? max(high, point.place.xyz) : point.place.xyz;
            ++landed;
            smoothly = smoothly && dot(point.wave.xyz, middle.wave.xyz) > kSmooth;
        }
        if (i == 0) corner[0] = point.place.xyz;
        if (i == 2) corner[1] = point.place.xyz;
        if (i == 6) corner[2] = point.place.xyz;
        if (i == 8) corner[3] = point.place.xyz;
        if (its == kStopped || its == kMeets) share = max(share, brightest(point.weight.xyz));
        on = max(on, brightest(point.weight.xyz) * shareOn(point));
        if (kCrystals) ofE = max(ofE, brightest(point.weight.xyz) * sharesOfE(point));
        back = max(back, brightest(point.weight.xyz) * point.weight.w);
    }
    float fine = float(params.size.w);
    float extent = fine * max(high.x - low.x, max(high.y - low.y, high.z - low.z));
    bool shadowed = float(idlePoints) >= 9.0 * params.right.w;
    bool split = !single && !idle && !agree && !shadowed && (extent > kDot || landed < kTold);
    if (!single && agree && status == kStopped) {
        float dense = area * params.map.x * brightest(middle.weight.xyz);
        vec3 across = cross(corner[3] - corner[0], corner[2] - corner[1]);
        float bright = clamp(dense / max(0.5 * length(across), 1.0e-20), kFaint, 1.0); // to the light's own
        float bend = fine * distance(0.25 * (corner[0] + corner[1] + corner[2] + corner[3]), middle.place.xyz);
        float bends = (smoothly ? kMostBend : kCreasedBend) * inversesqrt(bright) * extent;
        float most = min(sqrt(params.limits.w * extent) / bright, bends);
        split = bend > max(most, kFlat) || extent > float(params.levels.w);
        vec3 reach = vec3(farthest + bend / fine);
        if (kCulls && !isReceived(low - reach, high + reach)) {
            split = false;
            landed = 0;
        }
    } else if (kCulls && idle) {
        landed = 0;
    }
    bool isStarting = params.generation.x == 0u && node.place.z > params.levels.x;
    bool isWorthIt = params.generation.x > 0u && !agree ? share * area >= kBrokenWorth : share * edge >= kWorth;
    split = split && node.place.z > kSmallest && isWorthIt;
    if (split || (isStarting && isAimedAt(node))) {
        splits[atomicAdd(counts[kSplitCount], 1u)] = item;
        return;
    }
    // Too small to be a beam: each of its points stands for its share. Those that wait at an interface go on
    // as one, from the middle if that is among them.
    bool alone = single || !agree;
    uint waits = uint(node.second.x);
    float waiting = single ? uintBitsToFloat(node.state.z) : 0.0;
    for (int i = 0; i < 9 && alone && !single; ++i) {
        if (points[pointOf(node, i)].event.x != uint(kMeets)) continue;
        waits = status == kMeets ? waits : pointOf(node, i);
        waiting += brokenShareOf(i);
    }
    BeamPoint head = middle;
    if (alone && status != kMeets && waiting > 0.0) head = points[waits];
    float least = params.limits.y / edge; // a small cell carries little: half the edge, twice the share
    if (alone) {
        on = brightest(head.weight.xyz) * shareOn(head);
        back = brightest(head.weight.xyz) * head.weight.w;
        if (kCrystals) ofE = brightest(head.weight.xyz) * sharesOfE(head);
    }
    uint follow = 0u;
    if (int(head.event.x) == kMeets) follow = (on >= least ? 1u : 0u) | (back >= least ? 2u : 0u);
    if (kCrystals && int(head.event.x) == kMeets)
        follow |= (ofE.x >= least ? 4u : 0u) | (ofE.y >= least ? 8u : 0u);
    for (int i = 0; i < 9; ++i) { // books
        if (single && i != 4) continue;
        BeamPoint point = points[pointOf(node, i)];
        float part = single ? waiting : alone ? brokenShareOf(i) : shareOf(i);
        vec3 power = area * part * point.weight.xyz;
        int its = int(point.event.x);
        int book = bookOf(its);
        if (book >= 0) enter(book, power);
        if (its == kMeets) {
            float dropped = ((follow & 1u) == 0u ? shareOn(point) : 0.0) +
                            ((follow & 2u) == 0u ? point.weight.w : 0.0);
            if (kCrystals)
                dropped += ((follow & 4u) == 0u ? point.place.w : 0.0) + ((follow & 8u) == 0u ? point.wave.w : 0.0);
            enter(kBookDim, power * dropped);
        }
        if (params.generation.x == 0u && its != kNone) enter(kBookEntered, power);
    }
    bool culled = kCulls && landed == 0 && status == kStopped;
    if (culled) atomicAdd(counts[kCulledCount], 1u);
    if (!culled && (status == kStopped || landed > 0))
        beams[atomicAdd(counts[kBeamCount], 1u)] = item | (alone ? 0x80000000u : 0u);
    if (follow != 0u) {
        BeamNode next = node;
        next.state = uvec4(alone ? 1u : 0u, follow, floatBitsToUint(waiting), node.state.w);
        if (alone) next.second.x = waits;
        nextNodes[atomicAdd(counts[kNextCount], 1u)] = next;
        atomicAdd(counts[kBranchCount], uint(bitCount(follow)));
        for (int i = 0; i < 9; ++i)
            if (!alone || i == 4) want(pointOf(next, i), follow);
    }
}
