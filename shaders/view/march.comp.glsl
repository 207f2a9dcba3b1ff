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
#error PATH must be 0 to 5, SOURCE 0 to 2, CHANNELS 0, 1 or 3, EMISSION and OPAQUE 0 or 1
#endif
const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
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
#include "medium/sample.glsl"
// All below are padded by one voxel.
layout(binding = 1) uniform sampler3D dimming;  // grey: (σ_t, source); colour: σ_t [1/voxel]
layout(binding = 2) uniform sampler3D source;   // colour only; radiance per voxel of length
layout(binding = 3) uniform sampler3D lobes;    // light_direction in voxel space, g
layout(binding = 4) uniform sampler3D emission;
layout(binding = 5) uniform sampler3D surface;  // opacity, albedo
layout(binding = 6) uniform sampler3D fluence;  // for opaque surfaces

// Counters are spread over slots so that pixels do not queue for one.
const uint kSlots = 64u;
const uint kRays = 0u, kSteps = 1u, kTrappedRays = 2u, kWorst = 3u, kOver = 4u, kCounters = 5u;

void count(uint counter, uint amount) {
    uint slot = (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
    uint before = atomicAdd(counters[slot * kCounters + counter].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(counters[slot * kCounters + counter].y, 1u);
}

// The largest estimate of a ray's error, as the bits of a float, and the rays above the tolerance.
void noteError(float error) {
    uint slot = (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
    atomicMax(counters[slot * kCounters + kWorst].x, floatBitsToUint(error));
    if (error > params.tracing.x) count(kOver, 1u);
}

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
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
    float error; // adaptive: the steps' own estimates of how far off the exit is, added up [voxel]
    vec3 met;    // a point inside opaque material, when stopped; the ray is still outside it
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


// One step of τ of the schemes with one look-up, `sampled` at `where`: Euler's at its start, Verlet's in
// its middle.
Walk takeStep(Walk walk, vec4 sampled, vec3 where, float tau) {
    float ds = tau * sampled.w;
    if (kOpaque && opacityAt(where) > 0.5) {
        walk.fate = kStopped;
        walk.met = where;
        return walk;
    }
    if (kDims || kShines)
        walk = gather(walk, coordinate(where), walk.ray.w / sampled.w, sampled.w, ds);
    Ray next = kPath == kStraight ? Ray(walk.ray.x + tau * walk.ray.w, walk.ray.w)
               : kPath == kEuler  ? eulerStep(walk.ray, sampled, ds)
                                  : verletStep(walk.ray, sampled, tau);
    float optical =
        kPath == kVerlet ? verletOptical(walk.ray.w, next.w, tau) : ds * sampled.w;
    walk.opticalLength += optical;
    walk.pathLength += kPath == kVerlet ? sqrt(optical * tau) : ds;
    walk.ray = next;
    ++walk.steps;
    return walk;
}

// One step of τ of several look-ups, already made: what it meets on its way, voxel by voxel.
Walk follow(Walk walk, Advance step, float tau) {
    float ds = sqrt(abs(step.optical * tau));
    if (kDims || kShines || kOpaque) {
        Ray start = walk.ray;
        int pieces = max(int(ceil(ds)), 1);
        for (int i = 0; i < pieces && walk.fate == kWalking; ++i) {
            Ray at = between(start, step.ray, tau, (float(i) + 0.5) / float(pieces));
            float n = length(at.w);
            if (kOpaque && opacityAt(at.x) > 0.5) {
                walk.fate = kStopped;
                walk.met = at.x;
            } else {
                if (kDims || kShines)
                    walk = gather(walk, coordinate(at.x), at.w / n, n, ds / float(pieces));
                walk.ray = at;
            }
        }
        if (kOpaque && walk.fate == kStopped) return walk;
    }
    walk.opticalLength += step.optical;
    walk.pathLength += ds * sign(tau);
    walk.ray = step.ray;
    return walk;
}

// Where the opaque surface lies between the last point outside it and the one inside, and what it sends
// to the eye.
Walk meetSurface(Walk walk) {
    vec3 outside = walk.ray.x;
    vec3 inside = walk.met;
    for (int i = 0; i < 12; ++i) {
        vec3 middle = 0.5 * (outside + inside);
        if (opacityAt(middle) > 0.5) inside = middle;
        else outside = middle;
    }
    float n = length(walk.ray.w);
    float ds = length(inside - walk.ray.x);
    if (kDims || kShines)
        walk = gather(walk, coordinate(0.5 * (walk.ray.x + inside)), walk.ray.w / n, n, ds);
    walk.pathLength += ds;
    walk.opticalLength += ds * n;
    walk.ray.x = inside;
    vec3 through = kColour ? walk.through : vec3(walk.through.x);
    walk.light += through * surfaceLight(inside) / (n * n);
    return walk;
}

bool isOutside(vec3 x, vec3 centre, vec3 halfSize) {
    return any(greaterThan(abs(x - centre), halfSize));
}

// The share of a step that ends outside after which its interpolant leaves the domain.
float shareInside(Ray start, Ray end, float tau, vec3 centre, vec3 halfSize) {
    float inside = 0.0;
    float outside = 1.0;
    for (int i = 0; i < 22; ++i) {
        float middle = 0.5 * (inside + outside);
        if (isOutside(between(start, end, tau, middle).x, centre, halfSize)) outside = middle;
        else inside = middle;
    }
    return outside;
}

// A straight piece, forward or back, from close to a face onto it.
vec3 ontoFace(vec3 x, vec3 w, vec3 centre, vec3 halfSize) {
    vec3 times = (halfSize - (x - centre) * sign(w)) / max(abs(w), vec3(1.0e-20));
    float time = min(times.x, min(times.y, times.z));
    if (abs(time) < 1.0e-2) x += time * w;
    return clamp(x, centre - halfSize, centre + halfSize);
}

// Steps of several look-ups, until the ray leaves, stops or has used up its steps; or `once`. A step that
// ends outside is made again, as long as its interpolant stays in the domain.
Walk walkByStages(Walk walk, vec3 centre, vec3 halfSize, bool once) {
    float next = once ? params.march.x : params.tracing.w;
    float tau = next;
    bool landing = false;
    bool walking = true;
    vec4 first = kPath == kAdaptive ? fieldAt(walk.ray.x) : vec4(0.0);
    while (walking) {
        Advance step;
        if (kPath == kAdaptive) step = embeddedStep(walk.ray, first, tau);
        else if (kPath == kRk4) step = rk4Step(walk.ray, tau);
        else step = sharmaStep(walk.ray, tau);
        ++walk.steps;
        bool good = true;
        float off = 0.0;
        if (kPath == kAdaptive) {
            // An error of the direction counts by how far the ray may still go; all errors of a
            // crossing add up to the tolerance.
            float reach = params.tracing.y;
            off = length(step.offX) + length(step.offW) * reach / step.last.w;
            float allowed = params.tracing.x * tau * step.last.w / reach;
            float least = params.tracing.z;
            good = landing || off <= allowed || tau <= least;
            float change = 0.9 * pow(max(allowed / max(off, 1.0e-30), 1.0e-6), 1.0 / 3.0);
            if (!landing) next = clamp(tau * clamp(change, 0.2, 4.0), least, params.march.x);
        }
        if (good && !landing && isOutside(step.ray.x, centre, halfSize)) {
            next = tau * shareInside(walk.ray, step.ray, tau, centre, halfSize);
            landing = true;
        } else if (good) {
            walk = follow(walk, step, tau);
            walk.error += off;
            first = step.last;
            walking = !landing && !once;
            if (landing && walk.fate == kWalking) {
                walk.ray.x = ontoFace(walk.ray.x, walk.ray.w, centre, halfSize);
                walk.fate = kLeft;
            }
        }
        tau = next;
        if (walk.fate == kWalking && walk.steps >= params.size.w) walk.fate = kTrapped;
        walking = walking && walk.fate == kWalking;
    }
    return walk;
}

// Steps of one look-up, as long as the next one stays inside. What is rare stands outside this loop:
// software devices walk every branch of a loop in every round.
Walk walkByLooks(Walk walk, vec3 centre, vec3 halfSize) {
    float tau = params.march.x;
    bool inside = true;
    while (inside && walk.fate == kWalking) {
        vec3 at = walk.ray.x;
        vec4 sampled = vec4(0.0, 0.0, 0.0, 1.0);
        if (kPath == kEuler) {
            sampled = fieldAt(at);
            tau = params.march.x / sampled.w;
        }
        inside = !isOutside(walk.ray.x + tau * walk.ray.w, centre, halfSize) &&
                 walk.steps < params.size.w;
        if (!inside) break;
        if (kPath != kEuler) {
            at = verletMiddle(walk.ray, tau);
            sampled = fieldAt(at);
        }
        walk = takeStep(walk, sampled, at, tau);
    }
    if (walk.fate == kWalking && walk.steps >= params.size.w) walk.fate = kTrapped;
    return walk;
}

// A run of equal Verlet steps, from and to the ray's own coordinates.
Walk walkByVerlet(Walk walk, vec3 centre, vec3 halfSize) {
    float tau = params.march.x;
    Jet jet = jetAt(walk.ray.x, walk.ray.w);
    walk.opticalLength += verletOpticalEnd(walk.ray.w, jet.force, tau);
    walk.ray = toVerlet(walk.ray, jet.force, jet.bend, tau);
    walk = walkByLooks(walk, centre, halfSize);
    jet = jetAt(walk.ray.x, walk.ray.w);
    walk.ray = fromVerlet(walk.ray, jet.force, jet.bend, tau);
    walk.opticalLength -= verletOpticalEnd(walk.ray.w, jet.force, tau);
    return walk;
}

// The last step of a straight or an Euler ray ends on the face, unless the field turns the ray back.
Walk reachFace(Walk walk, vec3 centre, vec3 halfSize) {
    vec4 sampled = fieldAt(walk.ray.x);
    vec3 low = centre - halfSize;
    vec3 high = centre + halfSize;
    float whole = kPath == kEuler ? params.march.x / sampled.w : params.march.x;
    float tau = min(whole, timeToLeave(walk.ray.x, walk.ray.w, low, high));
    walk = takeStep(walk, sampled,
                    kPath == kEuler ? walk.ray.x : verletMiddle(walk.ray, tau), tau);
    if (walk.fate == kWalking &&
        timeToLeave(walk.ray.x, walk.ray.w, low, high) <= 1.0e-3 * params.march.x)
        walk.fate = kLeft;
    if (walk.fate != kStopped) walk.ray.x = clamp(walk.ray.x, low, high);
    return walk;
}

// From the entry to where the ray leaves, stops or has used up its steps.
Walk walkThrough(Walk walk, vec3 centre, vec3 halfSize) {
    while (walk.fate == kWalking) {
        if (kPath > kVerlet) {
            walk = walkByStages(walk, centre, halfSize, false);
        } else if (kPath == kVerlet) {
            walk = walkByVerlet(walk, centre, halfSize);
            if (walk.fate == kWalking) walk = walkByStages(walk, centre, halfSize, true);
        } else {
            walk = walkByLooks(walk, centre, halfSize);
            if (walk.fate == kWalking) walk = reachFace(walk, centre, halfSize);
        }
    }
    if (kOpaque && walk.fate == kStopped) walk = meetSurface(walk);
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
    Walk walk = Walk(ray, vec3(0.0), vec3(1.0), 0.0, 0.0, 0, kWalking, 0.0, vec3(0.0));

    if (hits) {
        walk.ray.w *= jetAt(walk.ray.x, start).n;
        walk = walkThrough(walk, 0.5 * (low + high), 0.5 * (high - low));
        count(kRays, 1u);
        count(kSteps, uint(walk.steps));
        if (walk.fate == kTrapped) count(kTrappedRays, 1u);
        if (kPath == kAdaptive) noteError(walk.error);
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
    float n = eyeInside ? jetAt(vec3(eye), start).n : params.march.y;
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
        float atExit = hits ? jetAt(walk.ray.x, walk.ray.w).n : 1.0;
        path.error = vec4(abs(length(walk.ray.w) - atExit), hits ? 0.0 : 1.0, 0.0, 0.0);
        paths[at] = path;
    }
}
