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
    !defined(OPAQUE)
#error PATH, SOURCE must be 0 to 2, CHANNELS 0, 1 or 3, EMISSION and OPAQUE 0 or 1
#endif
const int kStraight = 0, kEuler = 1, kVerlet = 2;
const int kPath = PATH;
const bool kDims = CHANNELS > 0;    // something absorbs or scatters
const bool kColour = CHANNELS == 3; // it does so, or shines, by wavelength
const bool kShines = SOURCE > 0;    // light is scattered towards the eye, or emitted
const bool kLobes = SOURCE == 2;    // scattering prefers a direction
const bool kEmission = EMISSION == 1; // emitted light kept apart from scattered: only with lobes
const bool kOpaque = OPAQUE == 1;   // opaque material ends rays

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params { ViewParams params; };
#include "view/environment.glsl"
layout(std430, binding = 0) writeonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 1) writeonly buffer Paths { PixelPath paths[]; };
layout(std430, binding = 2) buffer Counters { uvec2 counters[]; }; // (low, high): see kSlots
layout(binding = 0) uniform sampler3D field;    // (½∇n², n); this and all below padded by one voxel
layout(binding = 1) uniform sampler3D dimming;  // grey: (σ_t, source); colour: σ_t [1/voxel]
layout(binding = 2) uniform sampler3D source;   // colour only; radiance per voxel of length
layout(binding = 3) uniform sampler3D lobes;    // light_direction in voxel space, g
layout(binding = 4) uniform sampler3D emission;
layout(binding = 5) uniform sampler3D surface;  // opacity, albedo
layout(binding = 6) uniform sampler3D fluence;  // for opaque surfaces

// Counters are spread over slots so that pixels do not queue for one.
const uint kSlots = 64u;
const uint kRays = 0u, kSteps = 1u, kTrappedRays = 2u, kCounters = 3u;

void count(uint counter, uint amount) {
    uint slot = (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
    uint before = atomicAdd(counters[slot * kCounters + counter].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(counters[slot * kCounters + counter].y, 1u);
}

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
}

vec4 fieldAt(vec3 at) {
    return kPath == kStraight ? vec4(0.0, 0.0, 0.0, params.march.z) : textureLod(field, at, 0.0);
}

// A ray on its way, and what it has met.
const int kWalking = 0, kLeft = 1, kStopped = 2, kTrapped = 3;
struct Walk {
    Ray ray;
    vec3 light; // L/n²
    vec3 through;
    float pathLength;    // [voxel]
    float opticalLength; // [voxel]
    int steps;
    int fate;
};

// Adds a piece of length ds [voxel] with the medium as sampled at coordinate `at`.
Walk gather(Walk walk, vec3 at, vec3 direction, float n, float ds) {
    vec3 sigma = vec3(0.0);
    vec3 shine = vec3(0.0);
    vec4 medium = textureLod(dimming, at, 0.0);
    if (kColour) {
        sigma = medium.xyz;
        if (kShines) shine = textureLod(source, at, 0.0).xyz;
    } else {
        sigma = vec3(medium.x);
        if (kShines) shine = vec3(medium.y);
    }
    if (kLobes) {
        // One lobe round the mean direction; its length m makes the first moment right as g m.
        vec4 lobe = textureLod(lobes, at, 0.0);
        float m = length(lobe.xyz);
        float cosine = m > 0.0 ? -dot(lobe.xyz, direction) / m : 0.0;
        shine *= henyeyGreenstein(lobe.w * min(m, 1.0), cosine);
        if (kEmission) shine += textureLod(emission, at, 0.0).xyz;
    }
    float scale = ds / (n * n);
    vec3 depth = sigma * ds;
    if (!kDims) {
        walk.light += shine * scale;
    } else if (kColour) {
        Attenuation red = attenuationOf(depth.x);
        Attenuation green = attenuationOf(depth.y);
        Attenuation blue = attenuationOf(depth.z);
        if (kShines)
            walk.light += walk.through * vec3(red.mean, green.mean, blue.mean) * shine * scale;
        walk.through *= vec3(red.through, green.through, blue.through);
    } else {
        Attenuation grey = attenuationOf(depth.x);
        float added = kShines ? walk.through.x * grey.mean * shine.x * scale : 0.0;
        if (kOpaque) walk.light += vec3(added); // surfaces may be coloured in a grey medium
        else walk.light.x += added;
        walk.through.x *= grey.through;
    }
    return walk;
}

float opacityAt(vec3 x) {
    return textureLod(surface, coordinate(x), 0.0).x;
}

// Light leaving an opaque surface at x towards the eye: a Lambertian reflector under the stored
// light. Of fluence φ the part m is a beam along the mean direction, the rest comes from all sides
// and gives an irradiance of a quarter of it.
vec3 surfaceLight(vec3 x) {
    if (params.light.x == 0.0) return vec3(0.0);
    vec3 outward = -vec3(opacityAt(x + vec3(1, 0, 0)) - opacityAt(x - vec3(1, 0, 0)),
                         opacityAt(x + vec3(0, 1, 0)) - opacityAt(x - vec3(0, 1, 0)),
                         opacityAt(x + vec3(0, 0, 1)) - opacityAt(x - vec3(0, 0, 1)));
    float size = length(outward);
    vec3 normal = size > 0.0 ? outward / size : vec3(0.0);
    // Read in front of the surface: behind it there is no light.
    vec3 at = coordinate(x + 1.5 * normal);
    vec3 arriving = textureLod(fluence, at, 0.0).xyz;
    vec3 towards = textureLod(lobes, at, 0.0).xyz;
    float share = max(-dot(towards, normal), 0.0) + 0.25 * max(1.0 - length(towards), 0.0);
    // Its albedo half a voxel behind: in front there may be none.
    vec3 albedo = textureLod(surface, coordinate(x - 0.5 * normal), 0.0).yzw;
    return albedo * arriving * (share * 0.3183098861837907);
}

// One step of τ (Euler: of tau = ds/n, sampled at its start), or, into opaque material, part of it.
Walk takeStep(Walk walk, vec4 sampled, vec3 where, float tau) {
    float ds = tau * sampled.w;
    if (kOpaque && textureLod(surface, where, 0.0).x > 0.5) {
        walk.fate = kStopped;
        return walk;
    }
    if (kDims || kShines) walk = gather(walk, where, walk.ray.w / sampled.w, sampled.w, ds);
    walk.pathLength += ds;
    walk.opticalLength += ds * sampled.w;
    walk.ray = kPath == kStraight ? Ray(walk.ray.x + tau * walk.ray.w, walk.ray.w)
               : kPath == kEuler  ? eulerStep(walk.ray, sampled, ds)
                                  : verletStep(walk.ray, sampled, tau);
    ++walk.steps;
    return walk;
}

// Where the opaque surface lies between the last sample outside it and the one inside, and what it
// sends to the eye.
Walk meetSurface(Walk walk, vec4 sampled, vec3 inside, float tau) {
    vec3 outside = inside - tau * walk.ray.w;
    for (int i = 0; i < 12; ++i) {
        vec3 between = 0.5 * (outside + inside);
        if (opacityAt(between) > 0.5) inside = between;
        else outside = between;
    }
    float ds = max(dot(inside - walk.ray.x, walk.ray.w) / sampled.w, 0.0);
    if (kDims || kShines)
        walk = gather(walk, coordinate(walk.ray.x + (0.5 * ds / sampled.w) * walk.ray.w),
                      walk.ray.w / sampled.w, sampled.w, ds);
    walk.pathLength += ds;
    walk.opticalLength += ds * sampled.w;
    walk.ray.x = inside;
    vec3 through = kColour ? walk.through : vec3(walk.through.x);
    walk.light += through * surfaceLight(inside) / (sampled.w * sampled.w);
    return walk;
}

// From the entry to where the ray leaves, stops or has used up its steps. What is rare stands
// outside the inner loop: software devices walk every branch of a loop in every round.
Walk walkThrough(Walk walk, vec3 low, vec3 high) {
    int limit = params.size.w;
    vec3 centre = 0.5 * (low + high);
    vec3 halfSize = high - centre;
    vec4 sampled = vec4(0.0, 0.0, 0.0, 1.0);
    vec3 at = walk.ray.x;
    float tau = params.march.x;
    while (walk.fate == kWalking) {
        bool inside = true;
        while (inside && walk.fate == kWalking) {
            if (kPath == kEuler) {
                at = walk.ray.x;
                sampled = fieldAt(coordinate(at));
                tau = params.march.x / sampled.w;
            }
            inside = all(lessThanEqual(abs(walk.ray.x + tau * walk.ray.w - centre), halfSize)) &&
                     walk.steps < limit;
            if (!inside) break;
            if (kPath != kEuler) {
                at = verletMiddle(walk.ray, tau);
                sampled = fieldAt(coordinate(at));
            }
            walk = takeStep(walk, sampled, coordinate(at), tau);
        }
        if (walk.fate == kStopped) break;
        if (walk.steps >= limit) {
            walk.fate = kTrapped;
            break;
        }
        // The step that would leave ends on the face, unless the field turns the ray back there.
        tau = min(tau, timeToLeave(walk.ray.x, walk.ray.w, low, high));
        if (kPath != kEuler) {
            at = verletMiddle(walk.ray, tau);
            sampled = fieldAt(coordinate(at));
        }
        walk = takeStep(walk, sampled, coordinate(at), tau);
        if (walk.fate == kStopped) break;
        if (timeToLeave(walk.ray.x, walk.ray.w, low, high) <= 1.0e-3 * params.march.x)
            walk.fate = kLeft;
        walk.ray.x = clamp(walk.ray.x, low, high);
        tau = params.march.x;
    }
    if (kOpaque && walk.fate == kStopped) walk = meetSurface(walk, sampled, at, tau);
    return walk;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= params.picture.x || pixel.y >= params.picture.w) return;
    int at = pixel.y * params.picture.x + pixel.x;
    pixel.y += params.picture.z;

    // Set up in double: a distant eye must not jitter the point of entry.
    vec2 s = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(params.picture.xy) + vec2(-1.0, 1.0);
    bool perspective = params.eyeHigh.w == 1.0;
    dvec3 eye = dvec3(params.eyeHigh.xyz) + dvec3(params.eyeLow.xyz);
    dvec3 offset = double(s.x) * dvec3(params.right.xyz) + double(s.y) * dvec3(params.up.xyz);
    dvec3 towards = dvec3(params.forward.xyz) + (perspective ? offset : dvec3(0.0));
    towards /= sqrt(dot(towards, towards));
    if (!perspective) eye += offset;
    dvec3 far = dvec3(params.size.xyz) - 0.5;
    double enter = 0.0LF;
    double leave = 1.0e300LF;
    for (int i = 0; i < 3; ++i) {
        if (towards[i] == 0.0LF) {
            if (eye[i] < -0.5LF || eye[i] > far[i]) leave = -1.0LF;
        } else {
            double a = (-0.5LF - eye[i]) / towards[i];
            double b = (far[i] - eye[i]) / towards[i];
            enter = max(enter, min(a, b));
            leave = min(leave, max(a, b));
        }
    }
    bool hits = enter < leave;

    vec3 start = vec3(towards);
    vec3 low = vec3(-0.5);
    vec3 high = vec3(params.size.xyz) - 0.5;
    Ray ray = Ray(hits ? clamp(vec3(eye + enter * towards), low, high) : vec3(eye), start);
    Walk walk = Walk(ray, vec3(0.0), vec3(1.0), 0.0, 0.0, 0, kWalking);

    if (hits) {
        walk.ray.w *= fieldAt(coordinate(walk.ray.x)).w;
        walk = walkThrough(walk, low, high);
        count(kRays, 1u);
        count(kSteps, uint(walk.steps));
        if (walk.fate == kTrapped) count(kTrappedRays, 1u);
    }
    if (!kColour) {
        walk.through = vec3(walk.through.x);
        if (!kOpaque) walk.light = vec3(walk.light.x);
    }
    vec3 direction = walk.ray.w / length(walk.ray.w);
    vec3 light = walk.light;
    if (walk.fate != kStopped) { // a trapped ray sees what it would see going straight on
        vec3 sky = backgroundLight(direction);
        light += walk.through * sky / (params.march.y * params.march.y);
    }
    bool eyeInside = hits && enter == 0.0LF;
    float n = eyeInside ? fieldAt(coordinate(vec3(eye))).w : params.march.y;
    vec3 turned = direction - start;
    // Where no gradient acted the direction is the same but for rounding.
    bool changed = hits && (walk.fate == kStopped || dot(turned, turned) > 1.0e-12 ||
                            walk.through != vec3(1.0) || walk.light != vec3(0.0));
    colours[at] = vec4(light * (n * n), changed ? 1.0 : 0.0);
    if (params.march.w == 1.0) {
        PixelPath path;
        path.place = vec4(walk.ray.x, walk.opticalLength);
        path.direction = vec4(direction, walk.pathLength);
        path.through = vec4(walk.fate == kStopped ? vec3(0.0) : walk.through, float(walk.steps));
        float atExit = hits ? fieldAt(coordinate(walk.ray.x)).w : 1.0;
        path.error = vec4(abs(length(walk.ray.w) - atExit), hits ? 0.0 : 1.0, 0.0, 0.0);
        paths[at] = path;
    }
}
