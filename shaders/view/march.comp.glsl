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
const uint kRays = 0u, kSteps = 1u, kTrapped = 2u, kCounters = 3u;

void count(uint counter, uint amount) {
    uint slot = (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
    uint before = atomicAdd(counters[slot * kCounters + counter].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(counters[slot * kCounters + counter].y, 1u);
}

vec3 coordinate(vec3 x) {
    return (x + 1.5) / vec3(params.size.xyz + 2);
}

vec4 fieldAt(vec3 at) {
    return kPath == kStraight ? vec4(0.0, 0.0, 0.0, params.march.z) : textureLod(field, at, 0.0);
}

struct Gathered {
    vec3 light; // L/n²
    vec3 through;
};

// Adds a piece of length ds [voxel] with the medium as sampled at coordinate `at`.
Gathered gather(Gathered g, vec3 at, vec3 direction, float n, float ds) {
    if (!kDims && !kShines) return g;
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
    if (!kDims) {
        g.light += shine * (ds / (n * n));
        return g;
    }
    vec3 depth = sigma * ds;
    float scale = ds / (n * n);
    if (kColour) {
        Attenuation red = attenuationOf(depth.x);
        Attenuation green = attenuationOf(depth.y);
        Attenuation blue = attenuationOf(depth.z);
        if (kShines) g.light += g.through * vec3(red.mean, green.mean, blue.mean) * shine * scale;
        g.through *= vec3(red.through, green.through, blue.through);
    } else {
        Attenuation grey = attenuationOf(depth.x);
        float added = kShines ? g.through.x * grey.mean * shine.x * scale : 0.0;
        if (kOpaque) g.light += vec3(added); // surfaces may be coloured in a grey medium
        else g.light.x += added;
        g.through.x *= grey.through;
    }
    return g;
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
    return textureLod(surface, coordinate(x), 0.0).yzw * arriving * (share * 0.3183098861837907);
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
    vec3 centre = 0.5 * (low + high);
    vec3 halfSize = high - centre;
    Ray ray;
    ray.x = hits ? clamp(vec3(eye + enter * towards), low, high) : vec3(eye);
    ray.w = start;
    Gathered gathered = Gathered(vec3(0.0), vec3(1.0));
    float pathLength = 0.0;
    float opticalLength = 0.0;
    float indexAtExit = params.march.y;
    bool stopped = false;
    bool trapped = false;
    int steps = 0;

    if (hits) {
        ray.w *= fieldAt(coordinate(ray.x)).w;
        int limit = params.size.w;
        trapped = true;
        for (; steps < limit; ++steps) {
            vec4 sampled;
            vec3 where;
            float tau = params.march.x;
            if (kPath == kEuler) {
                where = coordinate(ray.x);
                sampled = fieldAt(where);
                tau /= sampled.w;
            }
            bool last = any(greaterThan(abs(ray.x + tau * ray.w - centre), halfSize));
            if (last) tau = min(tau, timeToLeave(ray.x, ray.w, low, high));
            vec3 middle = verletMiddle(ray, tau);
            if (kPath != kEuler) {
                where = coordinate(middle);
                sampled = fieldAt(where);
            }
            float ds = tau * sampled.w;
            if (kOpaque) {
                vec3 seen = kPath == kEuler ? ray.x : middle;
                if (textureLod(surface, where, 0.0).x > 0.5) {
                    // The surface lies between the last sample and this one.
                    vec3 outside = seen - ds * ray.w / sampled.w;
                    vec3 inside = seen;
                    for (int i = 0; i < 12; ++i) {
                        vec3 half_ = 0.5 * (outside + inside);
                        if (opacityAt(half_) > 0.5) inside = half_;
                        else outside = half_;
                    }
                    ds = max(dot(inside - ray.x, ray.w) / sampled.w, 0.0);
                    gathered = gather(gathered, where, ray.w / length(ray.w), sampled.w, ds);
                    pathLength += ds;
                    opticalLength += ds * sampled.w;
                    ray.x = inside;
                    gathered.light += (kColour ? gathered.through : vec3(gathered.through.x)) *
                                      surfaceLight(inside) / (sampled.w * sampled.w);
                    stopped = true;
                    trapped = false;
                    break;
                }
            }
            gathered = gather(gathered, where, ray.w / sampled.w, sampled.w, ds);
            pathLength += ds;
            opticalLength += ds * sampled.w;
            ray = kPath == kStraight ? Ray(ray.x + tau * ray.w, ray.w)
                  : kPath == kEuler  ? eulerStep(ray, sampled, tau * sampled.w)
                                     : verletStep(ray, sampled, tau);
            if (last) {
                if (timeToLeave(ray.x, ray.w, low, high) <= 1.0e-3 * params.march.x) {
                    trapped = false;
                    break;
                }
                ray.x = clamp(ray.x, low, high);
            }
        }
        if (!stopped) ray.x = clamp(ray.x, low, high);
        indexAtExit = fieldAt(coordinate(ray.x)).w;
        count(kRays, 1u);
        count(kSteps, uint(steps));
        if (trapped) count(kTrapped, 1u);
    }

    if (!kColour) {
        gathered.through = vec3(gathered.through.x);
        if (!kOpaque) gathered.light = vec3(gathered.light.x);
    }
    vec3 direction = ray.w / length(ray.w);
    vec3 light = gathered.light;
    if (!stopped) { // a trapped ray sees what it would see going straight on
        vec3 sky = backgroundLight(direction);
        light += gathered.through * sky / (params.march.y * params.march.y);
    }
    bool eyeInside = hits && enter == 0.0LF;
    float n = eyeInside ? fieldAt(coordinate(vec3(eye))).w : params.march.y;
    vec3 turned = direction - start;
    // Where no gradient acted the direction is the same but for rounding.
    bool changed = hits && (stopped || trapped || dot(turned, turned) > 1.0e-12 ||
                            gathered.through != vec3(1.0) || gathered.light != vec3(0.0));
    colours[at] = vec4(light * (n * n), changed ? 1.0 : 0.0);
    if (params.march.w == 1.0) {
        PixelPath path;
        path.place = vec4(ray.x, opticalLength);
        path.direction = vec4(direction, pathLength);
        path.through = vec4(stopped ? vec3(0.0) : gathered.through, float(steps));
        path.error = vec4(hits ? abs(length(ray.w) - indexAtExit) : 0.0, hits ? 0.0 : 1.0, 0.0, 0.0);
        paths[at] = path;
    }
}
