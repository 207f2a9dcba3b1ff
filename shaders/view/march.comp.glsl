// Curved viewing rays: one per pixel, backwards from the eye through the volume (003, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is gathered is L/n², which is conserved along a curved ray; L is not.
#include "shared/view_params.h"
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lib/phase.glsl"
#include "lib/ray.glsl"

#if !defined(PATH) || !defined(CHANNELS) || !defined(SOURCE) || !defined(EMISSION) || \
    !defined(OPAQUE) || !defined(MAP) || !defined(PATHS)
#error PATH must be 0 to 5, SOURCE 0 to 2, CHANNELS 0, 1, 3, EMISSION, OPAQUE, MAP, PATHS 0 or 1
#endif
const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
const int kPath = PATH;
const float kRounding = 6.0e-8; // of a float, relative
const bool kDims = CHANNELS > 0;    // something absorbs or scatters
const bool kColour = CHANNELS == 3; // it does so, or shines, by wavelength
const bool kShines = SOURCE > 0;    // light is scattered towards the eye, or emitted
const bool kLobes = SOURCE == 2;    // scattering prefers a direction
const bool kEmission = EMISSION == 1; // emitted light kept apart from scattered: only with lobes
const bool kOpaque = OPAQUE == 1;   // opaque material ends rays
const bool kMap = MAP == 1;         // an environment map surrounds the scene, not a colour
const bool kPaths = PATHS == 1;     // each ray's path is written, beside its colour

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params { ViewParams params; };
#include "view/environment.glsl"
layout(std430, binding = 0) buffer Colours { vec4 colours[]; };
layout(std430, binding = 1) writeonly buffer Paths { PixelPath paths[]; };
layout(std430, binding = 2) buffer Counters { uvec2 counters[]; }; // (low, high): see kSlots
#include "medium/sample.glsl"
// All below are padded by one voxel.
layout(binding = 1) uniform sampler3D dimming;  // grey: (σ_t, source); colour: σ_t [1/voxel]
layout(binding = 2) uniform sampler3D source;   // colour only; radiance per voxel of length
layout(binding = 3) uniform sampler3D lobes;    // light_direction in voxel space, g
layout(binding = 4) uniform sampler3D emission;
layout(binding = 5) uniform sampler3D surface;  // opacity, albedo
layout(binding = 6) uniform sampler3D fluence;  // for opaque surfaces

#include "view/sight.glsl"

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
}

#include "view/gather.glsl"
#include "view/walk.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= params.picture.x || pixel.y >= params.picture.w) return;
    int at = pixel.y * params.picture.x + pixel.x;
    pixel.y += params.picture.z;

    Sight sight = sightOf(pixel);
    bool hits = sight.hits;
    Ray ray = Ray(sight.start, sight.direction);
    Walk walk = Walk(ray, Ray(vec3(0.0), vec3(0.0)), vec3(0.0), vec3(1.0), 0.0, 0.0, 0, kWalking, 0.0, ray.x, ray.x);

    float entry = 1.0; // the index where the ray enters
    if (hits) {
        entry = indexAt(walk.ray.x);
        walk.ray.w *= entry;
        walk = walkThrough(walk, 0.5 * vec3(params.size.xyz) - 0.5, 0.5 * vec3(params.size.xyz));
        count(kRays, 1u);
        count(kSteps, uint(walk.steps));
        if (walk.fate == kTrapped) count(kTrappedRays, 1u);
        // Roundings of every step add up like a walk at random.
        if (kPath == kAdaptive)
            noteError(walk.error + kRounding * params.tracing.y * sqrt(float(walk.steps)));
    }
    if (!kColour) {
        walk.through = vec3(walk.through.x);
        if (!kOpaque) walk.light = vec3(walk.light.x);
    }
    vec3 direction = walk.ray.w / length(walk.ray.w);
    vec3 light = walk.light;
    bool stopped = kOpaque && walk.fate == kStopped;
    if (!stopped) { // a trapped ray sees what it would see going straight on
        vec3 sky = backgroundLight(direction);
        light += walk.through * sky / (params.march.y * params.march.y);
    }
    float n = sight.within ? entry : params.march.y;
    vec3 turned = direction - sight.direction;
    // Where no gradient acted the direction is the same but for rounding.
    bool changed = hits && (stopped || dot(turned, turned) > 1.0e-12 ||
                            walk.through != vec3(1.0) || walk.light != vec3(0.0));
    putColour(at, vec4(light * (n * n), changed ? 1.0 : 0.0));
    if (kPaths && params.pattern.z == 1.0) {
        PixelPath path;
        path.place = vec4(walk.ray.x, walk.opticalLength);
        path.direction = vec4(direction, walk.pathLength);
        path.through = vec4(stopped ? vec3(0.0) : walk.through, float(walk.steps));
        float atExit = hits ? indexAt(walk.ray.x) : 1.0;
        path.error = vec4(abs(length(walk.ray.w) - atExit), hits ? 0.0 : 1.0, 0.0, 0.0);
        paths[at] = path;
    }
}
