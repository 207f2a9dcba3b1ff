// The domain's faces, where paths enter and leave.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/box.glsl"
#include "lib/ray.glsl"
#include "transport/params.glsl"

vec3 fromCentre(vec3 x) {
    return x - (transport.halfSize.xyz - 0.5);
}

bool isOutside(vec3 x) {
    return any(greaterThan(abs(fromCentre(x)), transport.halfSize.xyz));
}

vec3 clampToDomain(vec3 x) {
    return clamp(x, vec3(-0.5), 2.0 * transport.halfSize.xyz - 0.5);
}

float timeToFace(vec3 x, vec3 d) {
    return timeToLeave(x, d, vec3(-0.5), 2.0 * transport.halfSize.xyz - 0.5);
}

// The same for a direction of length 1, by fewer branches.
float wayToFace(vec3 x, vec3 direction) {
    vec3 reach = (transport.halfSize.xyz - fromCentre(x) * signsOf(direction)) * inversesOf(direction);
    return max(min(reach.x, min(reach.y, reach.z)), 0.0);
}

// On a face, on the way out.
bool isLeaving(Ray ray) {
    return any(greaterThanEqual(fromCentre(ray.x) * sign(ray.w), transport.halfSize.xyz - 1.0e-4));
}

// A boundary that lies along a face this close to it is on it: samples tell no better [voxel].
const float kFlush = 0.02;

// Whether a boundary of this normal (of any length) at x lies along a face of the domain.
bool liesAlongFace(vec3 x, vec3 normal) {
    vec3 near = vec3(greaterThan(abs(fromCentre(x)), transport.halfSize.xyz - kFlush));
    return any(greaterThan(near * abs(normal), vec3(0.999 * length(normal))));
}

// The share of a step that ends outside after which its interpolant leaves the domain.
float shareInside(Ray start, Ray end, float tau) {
    float inside = 0.0;
    float outside = 1.0;
    for (int i = 0; i < 12; ++i) { // a straight piece makes good what is left
        float middle = 0.5 * (inside + outside);
        if (isOutside(between(start, end, tau, middle).x)) outside = middle;
        else inside = middle;
    }
    return outside;
}

// A straight piece, forward or back, from close to a face onto it.
vec3 ontoFace(Ray ray) {
    vec3 signs = signsOf(ray.w);
    vec3 face = (1.0 + signs) * transport.halfSize.xyz - 0.5;
    vec3 times = (face - ray.x) * signs / max(abs(ray.w), vec3(1.0e-20));
    float time = min(times.x, min(times.y, times.z));
    vec3 x = ray.x;
    if (abs(time) < 1.0e-2) x += time * ray.w;
    return clampToDomain(x);
}

// Outward, at a point on a face.
vec3 faceNormal(vec3 x) {
    vec3 off = fromCentre(x);
    vec3 left = transport.halfSize.xyz - abs(off);
    float least = min(left.x, min(left.y, left.z));
    return left.x == least   ? vec3(sign(off.x), 0.0, 0.0)
           : left.y == least ? vec3(0.0, sign(off.y), 0.0)
                             : vec3(0.0, 0.0, sign(off.z));
}
