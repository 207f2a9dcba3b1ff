// A photon's step through a varying index: as long as its leaf of the octree lets it be.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sun et al. 2008, §4.4. The entry file has kPath, the PhotonParams and the field.
#include "lib/octree.glsl"
#include "lib/ray.glsl"

const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
const int kPath = PATH; // straight where the index does not vary

layout(binding = 2) uniform usampler3D leaves; // per 2×2×2 voxels

// A step of several look-ups, of at most τ; the adaptive one is made again, shorter, until its error is
// what it may be. `longest` is what the next one may be.
struct Leap {
    Advance step;
    float tau;
    float longest;
    float off; // estimated error of where the photon leaves [voxel]
};

Leap leapOf(Ray ray, vec4 first, float tau, float longest) {
    Leap leap;
    leap.tau = tau;
    leap.longest = longest;
    leap.off = 0.0;
    if (kPath == kAdaptive) {
        bool good = false;
        for (int tries = 0; tries < 12 && !good; ++tries) {
            leap.step = embeddedStep(ray, first, leap.tau);
            leap.off = leap.step.offX + leap.step.offW * params.tracing.z / leap.step.last.w;
            // Below one rounding of w no step gets any better.
            float allowed = max(params.tracing.y * leap.tau * leap.step.last.w, 6.0e-8 * params.tracing.z);
            float change = 0.9 * sqrt(sqrt(allowed / max(leap.off, 1.0e-30)));
            leap.longest = leap.tau * clamp(change, 0.2, 4.0);
            good = leap.off <= allowed;
            if (!good) leap.tau = leap.longest;
        }
    } else if (kPath == kRk4) {
        leap.step = rk4Step(ray, tau);
    } else {
        leap.step = sharmaStep(ray, tau);
    }
    return leap;
}

struct Step {
    vec3 next;   // where it ends [voxel]
    float ds;    // [voxel]
    float tau;   // ds / n
    vec3 middle; // w on the way of a Verlet step
    Leap leap;   // the rest of one of several look-ups
};

// From x along w, where the field is `sampled`: to the leaf's face, within its limits, and never beyond
// the domain. Adaptive ones are not above `longest` [dτ, voxel].
Step stepFrom(vec3 x, vec3 w, vec4 sampled, float longest) {
    ivec3 size = params.size.xyz;
    vec3 centre = 0.5 * vec3(size) - 0.5;
    vec3 halfSize = 0.5 * vec3(size);
    vec3 direction = w / sampled.w;
    vec3 signs = vec3(direction.x < 0.0 ? -1.0 : 1.0, direction.y < 0.0 ? -1.0 : 1.0,
                      direction.z < 0.0 ? -1.0 : 1.0);
    vec3 inverses = 1.0 / max(abs(direction), vec3(1.0e-12));
    vec3 reach = (halfSize - (x - centre) * signs) * inverses;
    float toFace = max(min(reach.x, min(reach.y, reach.z)), 0.0);
    uint leaf = texelFetch(leaves, clamp(ivec3(x + 0.5 + 1.0e-4 * signs), ivec3(0), size - 1) >> 1, 0).x;
    uint level = leafLevel(leaf);
    Step made;
    made.ds = min(distanceToLeafFace(x, signs, inverses, level), leafLimit(leaf));
    made.ds = min(min(max(made.ds, params.limits.x), params.tracing.x), toFace);
    made.tau = made.ds / sampled.w;
    made.middle = kPath == kVerlet ? halfKick(w, sampled, made.tau) : w;
    made.next = x + made.tau * made.middle;
    if (kPath > kVerlet) {
        made.leap = leapOf(Ray(x, w), sampled, min(made.tau, longest), longest);
        made.next = made.leap.step.ray.x;
    }
    made.next = clamp(made.next, centre - halfSize, centre + halfSize);
    return made;
}

// The field where a step made in whole ended, at x.
vec4 fieldBehind(Step made, vec3 x, vec4 before) {
    return kPath == kAdaptive ? made.leap.step.last : kPath > kStraight ? fieldAt(x) : before;
}

// w behind it, from the field at either end.
vec3 waveBehind(Step made, vec3 w, vec4 before, vec4 after) {
    if (kPath == kEuler) w = eulerStep(Ray(vec3(0.0), w), before, made.ds).w;
    if (kPath == kVerlet) w = halfKick(made.middle, after, made.tau);
    if (kPath > kVerlet) w = made.leap.step.ray.w;
    // Linear look-ups are the gradient of no potential, so |w| would drift from n over many turns.
    // A share a step keeps it there, and takes little of n's own wavering within a voxel into w.
    if (kField == 1 && kPath > kEuler) w *= mix(1.0, after.w * inversesqrt(dot(w, w)), 0.1);
    return w;
}
