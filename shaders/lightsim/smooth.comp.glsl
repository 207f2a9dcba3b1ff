// One axis of the 3×3×3 smoothing of the light (Sun et al. 2008, §4.4): weights 1 2 1.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights 1 2 1 raise an exponential, which light in a medium is, by a quarter of its square
// slope; where a face cuts a neighbour off they are far more off. Here exponentials stay as they are:
// a neighbour beyond a face goes on from those inside, and where a voxel and its neighbours tell the
// same exponential the mean of both halves of 1 2 1 is a harmonic one. Either is a mean of the
// neighbours' values: what has no negative value gets none.
#include "lightsim/atlas.glsl"

#ifndef OPAQUE
#error OPAQUE must be 0 or 1
#endif
layout(std430, binding = kBrickListBuffer) readonly buffer BrickList { uint list[]; };
layout(r32f, binding = kTotalsImage) readonly uniform image3D sources;
layout(binding = kOpaqueUnit) uniform usampler3D opaque; // an atlas of one plane, not 0 inside opaque material
layout(r32f, binding = kSmoothedImage) writeonly uniform image3D targets;

// A voxel's value with two before it and two behind it, along the axis.
struct Row {
    float before2;
    float before;
    float here;
    float after;
    float after2;
};

Row added(Row a, Row b) {
    return Row(a.before2 + b.before2, a.before + b.before, a.here + b.here, a.after + b.after,
               a.after2 + b.after2);
}

// Light beyond the range of floats stays infinite, and is told of when it is stored.
bool isFinite(float value) {
    return abs(value) < 3.4e38;
}

// How values grow beyond a face whose first ones inside these are: by the lesser of two steps that go
// the same way, else not at all. So what is made of the first one is at most an eighth more than it.
float growthBeyond(float first, float second, float third) {
    if (min(first, min(second, third)) <= 0.0 || !isFinite(first + second + third)) return 1.0;
    float near = first / second;
    float next = second / third;
    if ((near - 1.0) * (next - 1.0) <= 0.0) return 1.0;
    return clamp(near > 1.0 ? min(near, next) : max(near, next), 1.0 / 16.0, 16.0);
}

struct Growth {
    float before; // beyond the axis's first voxel
    float after;  // and its last
};

// Of a row whose places beyond the faces repeat the outermost value. Only rows that reach them count.
Growth growthOf(Row row, int place, int count) {
    Growth growth = Growth(1.0, 1.0);
    if (count < 3) return growth;
    if (place == 0) growth.before = growthBeyond(row.here, row.after, row.after2);
    if (place == 1) growth.before = growthBeyond(row.before, row.here, row.after);
    if (place == count - 1) growth.after = growthBeyond(row.here, row.before, row.before2);
    if (place == count - 2) growth.after = growthBeyond(row.after, row.here, row.before);
    return growth;
}

Row grown(Row row, Growth growth, int place, int count) {
    if (place == 0) {
        row.before = growth.before * row.here;
        row.before2 = growth.before * row.before;
    } else if (place == 1) {
        row.before2 = growth.before * row.before;
    }
    if (place == count - 1) {
        row.after = growth.after * row.here;
        row.after2 = growth.after * row.after;
    } else if (place == count - 2) {
        row.after2 = growth.after * row.after;
    }
    return row;
}

// By what share of it 1 2 1 exceeds the middle one of three values of an exponential; 0 where their
// slope and how they bend are not of one.
float excess(float before, float here, float after) {
    float mean = 0.25 * (before + 2.0 * here + after);
    if (mean <= 0.0) return 0.0;
    float inverse = 1.0 / mean;
    float slope = 0.5 * (after - before) * inverse;
    float bend = (before - 2.0 * here + after) * inverse;
    float square = slope * slope; // an exponential's bend
    // All of it where they agree to a quarter, none where they are off by half.
    return clamp(0.5 * square - abs(bend - square), 0.0, 0.25 * square);
}

// The share of the half before the voxel in its mean. It is ½, as in 1 2 1, where the voxel and its
// neighbours do not tell one exponential: noise, edges of shadows, the surroundings of a lamp.
float shareBefore(Row row) {
    float difference = 0.5 * (row.before - row.after); // of the two halves
    if (difference == 0.0 || !isFinite(abs(row.before2) + abs(row.here) + abs(row.after2)) ||
        !isFinite(difference)) return 0.5;
    float mean = 0.25 * (row.before + 2.0 * row.here + row.after);
    vec3 found = vec3(excess(row.before2, row.before, row.here),
                      excess(row.before, row.here, row.after),
                      excess(row.here, row.after, row.after2));
    float least = min(found.x, min(found.y, found.z));
    float most = max(found.x, max(found.y, found.z));
    least = clamp(3.0 * least - most, 0.0, least);
    return clamp(0.5 - mean * least / difference, 0.0, 1.0);
}

float meanOf(Row row, float share) {
    return (1.0 - share) * (0.5 * (row.here + row.after)) + share * (0.5 * (row.before + row.here));
}

// The first of a voxel's texels, counted from the first brick's first voxel on; that of `here` where none is,
// or where it is opaque: no light comes from behind a surface.
ivec3 neighbour(ivec3 voxel, ivec3 here) {
    uint brick = brickOf(voxel, ivec2(params.bricks.x, params.bricks.x * params.bricks.y));
    if (brick == kNoBrick) return here;
    if (OPAQUE == 1 && texelFetch(opaque, texelOf(brick, voxel, params.apart.z), 0).x != 0u) return here;
    return texelOf(brick, voxel, params.apart.y);
}

float valueAt(ivec3 texel, int plane) {
    return imageLoad(sources, texel + planeAt(plane)).x;
}

void main() {
    int slot = slotOf();
    if (slot >= params.size.w) return;
    int brick = int(list[slot]);
    ivec3 inBrick = voxelInBrick();
    ivec3 p = inBrick + kBrickEdge * ivec3(brick % params.bricks.x,
                                           brick / params.bricks.x % params.bricks.y,
                                           brick / (params.bricks.x * params.bricks.y));
    int axis = params.first.w;
    int place = p[axis] - params.first[axis];
    int count = params.size[axis];
    ivec3 at = texelInAtlas(slot, inBrick, params.apart.y);
    ivec3 step = ivec3(axis == 0, axis == 1, axis == 2);
    ivec3 before = place > 0 ? neighbour(p - step, at) : at;
    ivec3 before2 = place > 1 && before != at ? neighbour(p - 2 * step, before) : before;
    ivec3 after = place < count - 1 ? neighbour(p + step, at) : at;
    ivec3 after2 = place < count - 2 && after != at ? neighbour(p + 2 * step, after) : after;
    Row power = Row(0.0, 0.0, 0.0, 0.0, 0.0);
    float sum = 0.0;
    for (int i = 0; i < FLUENCE; ++i) {
        Row row = Row(valueAt(before2, i), valueAt(before, i), valueAt(at, i), valueAt(after, i),
                      valueAt(after2, i));
        power = added(power, row);
        row = grown(row, growthOf(row, place, count), place, count);
        float mean = meanOf(row, shareBefore(row));
        imageStore(targets, at + planeAt(i), vec4(mean));
        sum += mean;
    }
    if (kDirection) {
        // By the shares of the power: then the direction, their quotient, is a mean of the neighbours'
        // directions. The power will be what its channels make of it, each by shares of its own.
        Growth growth = growthOf(power, place, count);
        power = grown(power, growth, place, count);
        float share = shareBefore(power);
        float mean = meanOf(power, share);
        float scale = mean > 0.0 ? sum / mean : 0.0;
        for (int i = FLUENCE; i < kTotals; ++i) {
            Row row = Row(0.0, valueAt(before, i), valueAt(at, i), valueAt(after, i), 0.0); // it wants no more
            float smoothed = scale * meanOf(grown(row, growth, place, count), share);
            imageStore(targets, at + planeAt(i), vec4(smoothed));
        }
    }
}
