// Which fine voxels opaque surfaces cross (MEASURE 0), and how much of them is in each (MEASURE 1).
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A work item a voxel of the domain. A surface is a boundary with opaque material on one side, or what
// a face of the domain cuts open.
#include "lightsim/plane_area.glsl"
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "transport/opaque_voxels.glsl"
#include "transport/regions.glsl"
#include "transport/surface_voxels.glsl"

#ifndef MEASURE
#error MEASURE must be 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { LayoutParams params; };
layout(std430, binding = kVoxelListBuffer) readonly buffer VoxelList { uint voxelList[]; };
layout(std430, binding = kMasksBuffer) buffer Masks { uint masks[]; };             // a record's, without its number
layout(std430, binding = kAreasBuffer) writeonly buffer Areas { uvec2 areas[]; }; // area [voxel face], normal
layout(binding = kOpacityFieldUnit) uniform sampler3D opacityField;

float opacityAt(vec3 x) {
    return textureLod(opacityField, coordinate(x), 0.0).x;
}

// The gradient and the distance of a boundary, outward of what it bounds.
vec4 boundaryAt(int k, vec3 x) {
    if (kObjects > 0) return distanceAt(k, x);
    vec3 normal = opaqueNormalAt(x);
    float here = opacityAt(x);
    float slope = 2.0 * (opacityAt(x - 0.25 * normal) - opacityAt(x + 0.25 * normal));
    float distance = (0.5 - here) / max(slope, 1.0e-3);
    // Opacity bends at voxels' middles: what it is there tells how far to trust the slope.
    float there = opacityAt(x - clamp(distance, -2.0, 2.0) * normal);
    float fall = abs(here - there);
    return vec4(normal, fall > 1.0e-3 ? clamp(distance, -2.0, 2.0) * abs(here - 0.5) / fall : distance);
}

ObjectSet objectsHolding(vec3 x) {
    ObjectSet inside = holding(x);
    ObjectSet close = closeTo(x);
    ObjectSet rest = close;
    for (int i = 0; i < slotsOf(close); ++i) {
        int k = objectAt(rest);
        inside = changed(inside, k, distanceAt(k, x).w < 0.0);
    }
    return inside;
}

bool isOpaqueAt(vec3 x) {
    return kObjects > 0 ? isMatt(regionOf(objectsHolding(x))) : opacityAt(x) > 0.5;
}

// 1 where what object k holds is opaque and what is beside it is not, −1 the other way round, else 0.
float opaqueSideOf(int k, ObjectSet inside) {
    if (kObjects == 0) return 1.0;
    bool within = isMatt(regionOf(changed(inside, k, true)));
    bool beside = isMatt(regionOf(changed(inside, k, false)));
    return float(within) - float(beside);
}

struct Cover {
    float area;  // [face of a voxel]
    float most;  // the largest part of it, −1 where nothing touches
    vec3 normal; // of that part, outward
};
const Cover kBare = Cover(0.0, -1.0, vec3(0.0));

void take(inout Cover cover, float area, vec3 normal) {
    if (area > cover.most) cover.normal = normal;
    cover.most = max(cover.most, area);
    cover.area += area;
}

// The boundaries near a voxel of the domain: of one alone, what else holds the voxel is known.
struct Near {
    ObjectSet close;
    ObjectSet inside; // the objects that hold the middle
    bool one;
};

Near nearTo(vec3 middle) {
    if (kObjects == 0) return Near(ObjectSet(0u), ObjectSet(0u), true);
    ObjectSet close = closeTo(middle);
    return Near(close, holding(middle), kObjects == 1 || close == changed(ObjectSet(0u), firstOf(close), true));
}

// A surface so near a fine voxel touches it: light may be put there, whose beams are not just on the surface
// [fine voxel].
const float kTouches = 0.15;

// What of boundary k is in a fine voxel around x.
bool covers(int k, Near near, vec3 x, float edge, inout Cover cover) {
    vec4 found = boundaryAt(k, x);
    float reach = (0.5 * (abs(found.x) + abs(found.y) + abs(found.z)) + kTouches) * edge;
    if (abs(found.w) > reach || dot(found.xyz, found.xyz) < 0.01) return false;
    ObjectSet inside = near.inside;
    if (!near.one) inside = objectsHolding(x);
    float side = opaqueSideOf(k, inside);
    if (side == 0.0) return false;
    take(cover, planeAreaIn(found.xyz, found.w, edge), side * normalize(found.xyz));
    return true;
}

// What of the domain's faces is in it, if they cut something opaque open.
bool coversFaces(vec3 x, float edge, inout Cover cover) {
    bool any = false;
    vec3 off = fromCentre(x);
    for (int axis = 0; axis < 3; ++axis) {
        if (abs(off[axis]) < transport.halfSize[axis] - edge) continue;
        vec3 normal = vec3(0.0);
        normal[axis] = off[axis] < 0.0 ? -1.0 : 1.0;
        if (!isOpaqueAt(clampToDomain(x + 0.5 * edge * normal))) continue;
        take(cover, edge * edge, normal);
        any = true;
    }
    return any;
}

bool isAtFace(vec3 x) {
    return any(greaterThan(abs(fromCentre(x)), transport.halfSize.xyz - 1.0));
}

// By floats: software devices divide whole numbers one by one.
vec3 middleOf(ivec3 voxel, int place) {
    float edge = float(params.size.w);
    float row = floor((float(place) + 0.5) / edge);
    float slab = floor((row + 0.5) / edge);
    vec3 within = vec3(float(place) - edge * row, row - edge * slab, slab);
    return vec3(voxel) - 0.5 + (within + 0.5) / edge;
}

const float kSmooth = 0.004; // how far a distance's slope may be from 1 where no crease is near

void mark(ivec3 voxel, int k, Near near, uint record) {
    int fine = params.size.w * params.size.w * params.size.w;
    float edge = 1.0 / float(params.size.w);
    vec3 middle = vec3(voxel);
    vec4 found = boundaryAt(k, middle);
    float spread = abs(found.x) + abs(found.y) + abs(found.z);
    bool even = kObjects > 0 && abs(length(found.xyz) - 1.0) < kSmooth;
    // Curvature adds less than a tenth of a voxel; over a crease distances grow by little more than 1 a voxel.
    float reach = even ? 0.5 * spread * edge + 0.1 : 1.2 * edge;
    if (kObjects > 0 && abs(found.w) > (even ? 0.5 * spread + 0.2 : 1.3)) return;
    int place = 0;
    while (place < fine) {
        // Look for the next that may be, so that lanes of a vector look boundaries up together.
        bool may = false;
        while (place < fine && !may) {
            vec3 off = middleOf(voxel, place) - middle;
            may = kObjects == 0 || (even ? abs(found.w + dot(found.xyz, off)) < reach
                                            : abs(found.w) < 1.2 * length(off) + reach);
            if (!may) ++place;
        }
        if (may) {
            Cover cover = kBare;
            if (covers(k, near, middleOf(voxel, place), edge, cover)) masks[record + (place >> 5)] |= 1u << (place & 31);
            ++place;
        }
    }
}

void markFaces(ivec3 voxel, uint record) {
    int fine = params.size.w * params.size.w * params.size.w;
    float edge = 1.0 / float(params.size.w);
    for (int place = 0; place < fine; ++place) {
        Cover cover = kBare;
        if (coversFaces(middleOf(voxel, place), edge, cover)) masks[record + (place >> 5)] |= 1u << (place & 31);
    }
}

const int kFlatEdge = 4;

void measure(ivec3 voxel) {
    int record = surfaceRecordOf(voxel);
    float edge = 1.0 / float(params.size.w);
    Near near = nearTo(vec3(voxel));
    ObjectSet close = near.close;
    int slots = kObjects > 0 ? slotsOf(close) : 1;
    bool atFace = isAtFace(vec3(voxel));
    // A curved surface is a plane in cubes of a quarter of a voxel, near enough.
    int parts = clamp(kFlatEdge / params.size.w, 1, kFlatEdge);
    for (int word = 0; word < int(surface.table.z); ++word) {
        uvec2 found = surfaceWord(record, word);
        uint bits = found.x;
        uint number = found.y;
        while (bits != 0u) {
            vec3 x = middleOf(voxel, 32 * word + findLSB(bits));
            bits &= bits - 1u;
            Cover cover = kBare;
            ObjectSet rest = close;
            for (int i = 0; i < slots; ++i) {
                int k = kObjects > 0 ? objectAt(rest) : 0;
                Cover whole = kBare; // touched alone it has a normal, and no area
                if (covers(k, near, x, edge, whole)) take(cover, 0.0, whole.normal);
                for (int part = 0; part < parts * parts * parts; ++part) {
                    vec3 off = vec3(part % parts, part / parts % parts, part / (parts * parts)) + 0.5;
                    covers(k, near, x + (off / float(parts) - 0.5) * edge, edge / float(parts), cover);
                }
            }
            if (atFace) coversFaces(x, edge, cover);
            areas[number++] = uvec2(floatBitsToUint(cover.area), packSnorm4x8(vec4(cover.normal, 0.0)));
        }
    }
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= uint(params.list.x)) return;
    int place = int(voxelList[item]);
    ivec3 voxel = ivec3(place % params.size.x, place / params.size.x % params.size.y,
                        place / (params.size.x * params.size.y));
#if MEASURE == 1
    measure(voxel);
#else
    uint record = item * uint(params.list.y);
    Near near = nearTo(vec3(voxel));
    ObjectSet close = near.close;
    ObjectSet rest = close;
    int slots = kObjects > 0 ? slotsOf(close) : 1;
    for (int i = 0; i < slots; ++i) {
        int k = kObjects > 0 ? objectAt(rest) : 0;
        mark(voxel, k, near, record);
    }
    if (isAtFace(vec3(voxel))) markFaces(voxel, record);
#endif
}
