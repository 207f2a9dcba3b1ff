// Light that meets nothing on its way through an even medium: what voxels get of it, by Beer's law.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Of one source, where its map is not aimed at; photons bring the rest.
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lightsim/spread.glsl"
#include "lightsim/totals.glsl"

layout(std140, binding = kEmissionBlock) uniform Emission { EmissionParams emission; };
layout(std430, binding = kBrickListBuffer) readonly buffer BrickList { uint list[]; };
layout(std430, binding = kAimsBuffer) readonly buffer Aims { uint aims[]; };

const int kLines = 32; // that go through a voxel of which photons bring a part, along an edge of the map, at most

bool isPoint() {
    return emission.weight.x == 1.0;
}

// A place as the light sees it, in pixels of the map; z: how far ahead.
vec3 onMap(vec3 x) {
    vec3 way = x - (isPoint() ? emission.origin.xyz : vec3(0.0));
    float ahead = isPoint() ? max(dot(way, emission.forward.xyz), 1.0e-6) : 1.0;
    vec2 at = vec2(dot(way, emission.right.xyz), dot(way, emission.up.xyz)) / ahead;
    return vec3((at - emission.window.xy) / emission.window.zw * vec2(emission.map.xy), ahead);
}

bool isOnMap(vec2 pixel) {
    return all(greaterThanEqual(pixel, vec2(0.0))) && all(lessThan(pixel, vec2(emission.map.xy)));
}

bool isPlain(vec2 pixel) {
    ivec2 tile = ivec2(pixel) / emission.tiles.x;
    return isOnMap(pixel) && aims[tile.y * emission.tiles.y + tile.x] == 0u;
}

// Of a part of the map: 0 if none of its tiles is plain, 1 if all are, 2 if some are or it is not told.
int plainIn(vec2 low, vec2 high) {
    const int kMost = 4; // tiles asked for, along an edge
    ivec2 from = max(ivec2(floor(low)), ivec2(0)) / emission.tiles.x;
    ivec2 to = min(ivec2(floor(high)), emission.map.xy - 1) / emission.tiles.x;
    if (any(lessThan(high, vec2(0.0))) || any(greaterThanEqual(low, vec2(emission.map.xy)))) return 0;
    if (any(greaterThanEqual(to - from, ivec2(kMost)))) return 2;
    bool any = false;
    bool every = isOnMap(low) && isOnMap(high);
    ivec2 at = from;
    while (at.y <= to.y) {
        bool plain = aims[at.y * emission.tiles.y + at.x] == 0u;
        any = any || plain;
        every = every && plain;
        ++at.x;
        if (at.x > to.x) at = ivec2(from.x, at.y + 1);
    }
    return every ? 1 : any ? 2 : 0;
}

vec3 directionTo(vec3 x) {
    return isPoint() ? normalize(x - emission.origin.xyz) : emission.forward.xyz;
}

// A voxel's mean, over what the source sends: fluence, of intensity times voxel².
vec3 lightAt(vec3 x, vec3 direction) {
    // Where light enters through a face, depth grows from one face of the voxel to the other.
    vec3 face = mix(emission.high.xyz, emission.low.xyz, greaterThan(direction, vec3(0.0)));
    vec3 depths = abs(x - face) * inversesOf(direction);
    float depth = min(depths.x, min(depths.y, depths.z));
    float extent = depth / dot(abs(x - face), vec3(equal(depths, vec3(depth))));
    float share = 1.0;
    if (isPoint()) {
        vec3 way = x - emission.origin.xyz;
        float far = dot(way, way);
        share = shareTowards(emission.axis, emission.cone, direction) / far * (1.0 + 1.0 / (12.0 * far));
    }
    vec3 light;
    for (int c = 0; c < 3; ++c) {
        float sigmaT = emission.absorption[c] + emission.scattering[c];
        light[c] = share * attenuationOf(sigmaT * max(depth - 0.5 * extent, 0.0)).through *
                   attenuationOf(sigmaT * extent).mean;
    }
    return light;
}

// Half of what a voxel covers on the map, at most [pixel].
vec2 reachOf(vec3 at) {
    vec2 reach = 0.5 * vec2(dot(abs(emission.right.xyz), vec3(1.0)), dot(abs(emission.up.xyz), vec3(1.0)));
    // Within 45 degrees of the view's axis, seen from the voxel's nearest corner.
    if (isPoint()) reach = vec2(2.0) / max(at.z - 1.0, 1.0e-3);
    return reach * vec2(emission.map.xy) / emission.window.zw;
}

// The share of a voxel that light crosses on lines through plain pixels, of all through a part of the map. These are
// the lines on which photons go through the others: both together are the whole.
float plainShare(vec3 x, vec2 low, vec2 high) {
    ivec2 from = ivec2(floor(low));
    ivec2 count = ivec2(floor(high)) - from + 1;
    ivec2 stride = (count + kLines - 1) / kLines;
    float all = 0.0;
    float plain = 0.0;
    ivec2 at = ivec2(0);
    while (at.y < count.y) {
        vec2 pixel = vec2(from + at) + 0.5;
        vec2 place = emission.window.xy + pixel / vec2(emission.map.xy) * emission.window.zw;
        vec3 across = place.x * emission.right.xyz + place.y * emission.up.xyz;
        vec3 start = isPoint() ? emission.origin.xyz : across;
        vec3 direction = isPoint() ? normalize(emission.forward.xyz + across) : emission.forward.xyz;
        vec2 span = boxSpan(start, direction, x - 0.5, x + 0.5);
        float chord = max(span.y - span.x, 0.0);
        all += chord;
        plain += isPlain(pixel) ? chord : 0.0;
        at.x += stride.x;
        if (at.x >= count.x) at = ivec2(0, at.y + stride.y);
    }
    // Of photons further apart than voxels are wide none may go through it.
    return all > 0.0 ? plain / all : isPlain(0.5 * (low + high)) ? 1.0 : 0.0;
}

void main() {
    int slot = slotOf();
    if (slot >= params.size.w) return;
    ivec3 inBrick = voxelInBrick();
    int brick = int(list[slot]);
    ivec3 place = ivec3(brick % params.bricks.x, brick / params.bricks.x % params.bricks.y,
                        brick / (params.bricks.x * params.bricks.y));
    ivec3 voxel = (place << kBrickBits) + inBrick - params.first.xyz;
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, params.size.xyz))) return;
    vec3 x = vec3(voxel);
    vec3 middle = onMap(x);
    if (isPoint() && dot(x - emission.origin.xyz, emission.forward.xyz) < -1.0) return;
    vec2 reach = reachOf(middle);
    int plain = plainIn(middle.xy - reach, middle.xy + reach);
    if (plain == 0) return;
    vec3 direction = directionTo(x);
    vec3 light = params.fluence.xyz * lightAt(x, direction);
    if (plain == 2) light *= plainShare(x, middle.xy - reach, middle.xy + reach);
    ivec3 texel = texelInAtlas(slot, inBrick, params.apart.y);
    for (int c = 0; c < FLUENCE; ++c) give(texel, c, light[c]);
    float power = dot(light, vec3(1.0));
    for (int i = 0; i < 3 && kDirection; ++i) give(texel, FLUENCE + i, power * direction[i]);
}
