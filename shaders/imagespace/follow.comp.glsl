// Rays followed among layers of front and back faces until they leave: through any number of interfaces, by total
// reflection, and on to plates.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// As the volume method does (view/branches.glsl): at an interface a ray parts; what is refracted is followed first,
// what is reflected waits; so the first branch to end is the one that refracts wherever it can.
#include "shared/bindings.h"
#include "shared/imagespace_params.h"
#include "lib/fresnel.glsl"

#if !defined(MAP) || !defined(AOVS) || !defined(PLATES)
#error MAP, AOVS and PLATES must be 0 or 1
#endif
const bool kMap = MAP == 1;

const int kWaiting = 4;

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };
layout(binding = kFrontsUnit) uniform sampler2DArray fronts;
#if PLATES == 1
layout(binding = kPlatesUnit) uniform sampler2DArray plates;
layout(binding = kAlbedosUnit) uniform sampler2DArray albedos;
#endif
layout(rgba32f, binding = kColoursImage) uniform image2D colours;
layout(std430, binding = kCountersBuffer) buffer Counters { uint lost; }; // rays' first branches, within the body

#include "camera/environment.glsl"
#include "imagespace/view.glsl"
#include "imagespace/paths.glsl"
#include "imagespace/march.glsl"

struct Branch {
    vec3 x;
    vec3 direction;
    vec3 throughput;
    bool inside;
    int depth;
};

// Of a matt surface, in what surrounds the scene (camera/irradiance.h).
vec3 irradianceOn(vec3 normal) {
    vec3 n = normal.x * params.worldFromCamera0.xyz + normal.y * params.worldFromCamera1.xyz +
             normal.z * params.worldFromCamera2.xyz;
    vec4 e[9] = params.irradiance;
    vec3 sum = e[0].xyz + n.y * e[1].xyz + n.z * e[2].xyz + n.x * e[3].xyz + (n.x * n.y) * e[4].xyz +
               (n.y * n.z) * e[5].xyz + (3.0 * n.z * n.z - 1.0) * e[6].xyz + (n.x * n.z) * e[7].xyz +
               (n.x * n.x - n.y * n.y) * e[8].xyz;
    return max(sum, vec3(0.0));
}

// What a pixel's ray meets first, by its own texel.
Hit firstHit(ivec2 pixel, vec3 view) {
    vec4 front = layerAt(pixel, 0);
    Hit hit = Hit(kLeaves, 0.0, pointAt(vec2(pixel), 0.0), vec3(0.0), vec3(0.0), 0);
    if (front.w != 0.0) hit = Hit(kBody, 0.0, pointAt(vec2(pixel), abs(front.w)), front.xyz, vec3(0.0), 0);
#if PLATES == 1
    vec4 plate = texelFetch(plates, ivec3(pixel, 0), 0);
    if (plate.w != 0.0 && (front.w == 0.0 || abs(plate.w) < abs(front.w)))
        hit = Hit(kPlate, 0.0, pointAt(vec2(pixel), abs(plate.w)), dot(plate.xyz, view) < 0.0 ? plate.xyz : -plate.xyz,
                  texelFetch(albedos, ivec3(pixel, 0), 0).xyz, 0);
#endif
    return hit;
}

float brightest(vec3 share) {
    return max(share.x, max(share.y, share.z));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, params.picture.xy))) return;
    vec3 view = directionThrough(vec2(pixel));
    Hit hit = firstHit(pixel, view);
    bool changed = hit.kind != kLeaves;
    SurfacePath path = freePath(pointAt(vec2(pixel), 0.0), view);
    Branch at = Branch(hit.x, view, vec3(1.0), false, 0);
    Branch waiting[kWaiting];
    int waits = 0;
    bool first = true;
    vec3 through = vec3(1.0); // of the first branch, without reflections that go along
    float extent = 0.0;
    int probes = 0;
    vec3 light = vec3(0.0);
    float n = params.optics.x;
    // Each round is an interface or an end; branches are at most one more than interfaces.
    for (int round = 0; round < 1024; ++round) {
        bool ends = hit.kind != kBody || at.depth >= params.limits.z;
        if (!ends) {
            float here = at.inside ? n : 1.0;
            float beyond = at.inside ? 1.0 : n;
            Dielectric parted = dielectricAt(here * at.direction, hit.normal, here, beyond);
            bool total = parted.reflectance >= 1.0;
            if (first && !at.inside) path.outward.w = 1.0;
            ++at.depth;
            at.x = hit.x;
            Branch mirrored = at;
            mirrored.direction = normalize(parted.reflected);
            mirrored.throughput *= parted.reflectance;
            bool follows = !total && waits < kWaiting && brightest(mirrored.throughput) >= params.optics.y &&
                           at.depth < params.limits.z;
            if (total) at.direction = mirrored.direction;
            else {
                at.direction = normalize(parted.refracted);
                at.inside = !at.inside;
                if (follows) at.throughput *= 1.0 - parted.reflectance;
                if (first) through *= 1.0 - parted.reflectance;
                if (first && !at.inside) path.place.xyz = hit.x;
            }
            if (follows) waiting[waits++] = mirrored;
        } else {
            if (hit.kind == kPlate) light += at.throughput * hit.albedo * irradianceOn(hit.normal) * 0.3183098861837907;
            else light += at.throughput * surroundingsLight(at.direction);
            if (first) {
                if (hit.kind == kPlate) {
                    path.place.xyz = hit.x;
                    path.outward = vec4(hit.normal, 2.0);
                    through = vec3(0.0);
                } else if (at.inside) {
                    path.place.xyz = at.x;
                    if (hit.kind == kLeaves) atomicAdd(lost, 1u);
                }
                path.place.w = n * extent;
                path.direction = vec4(at.direction, extent);
                path.through = vec4(through, float(probes));
                first = false;
            }
            if (waits == 0) break;
            at = waiting[--waits];
        }
        hit = march(at.x, at.direction, at.inside);
        if (at.inside && hit.kind != kLeaves) {
            vec3 kept = exp(-params.absorption.xyz * hit.t);
            at.throughput *= kept;
            if (first) {
                through *= kept;
                extent += hit.t;
            }
        }
        if (first) probes += hit.probes;
    }
    vec4 colour = params.pattern.z * vec4(light, changed ? 1.0 : 0.0);
    imageStore(colours, pixel, params.picture.z == 0 ? colour : imageLoad(colours, pixel) + colour);
    recordPath(pixel, path);
}
