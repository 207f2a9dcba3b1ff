// How a path is stepped through a varying index: the one place that knows the integrators.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two kinds of steps. Those of one look-up are made in runs, while no interface and no face is near.
// Those of any length, of several look-ups, end on their own interpolant wherever they must.
#include "lib/ray.glsl"
#include "shared/bindings.h"
#include "transport/domain.glsl"
#include "transport/index_field.glsl"

#ifndef INTEGRATOR
#error INTEGRATOR must be 0 (straight), 1 Euler, 2 Verlet, 3 Sharma, 4 RK4 or 5 adaptive
#endif
#ifndef FAINT
#error FAINT must be 0 or 1 (of an index that a file holds in double: kicks may be below a rounding of w)
#endif
const bool kFaint = FAINT == 1;
const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
const int kIntegrator = INTEGRATOR;
const bool kRuns = kIntegrator == kEuler || kIntegrator == kVerlet; // one look-up a step

// A step of dτ of any length, from a ray whose field, for adaptive steps, is `first`.
Step stepBy(Ray ray, vec4 first, float tau) {
    if (kIntegrator == kAdaptive) return embeddedStep(ray, first, tau);
    if (kIntegrator == kRk4) return rk4Step(ray, tau);
    if (kIntegrator == kEuler) {
        vec4 field = fieldAt(ray.x);
        Ray end = eulerStep(ray, field, tau * field.w);
        return Step(end, Ray(end.x - ray.x, end.w - ray.w), 0.0, field, 0.0, 0.0);
    }
    return sharmaStep(ray, tau);
}


// Whether an adaptive step's error is what it may be, and how long the next may be.
struct Control {
    bool good;
    float next;  // [dτ, voxel]
    float error; // of where the path leaves, estimated [voxel]
};

// An error of the direction counts by how far the path may still go; all errors of a crossing add up to
// the tolerance. Below one rounding of w no step gets any better.
Control controlOf(Step made, float tau) {
    float crossing = transport.tolerance.y;
    float error = made.errorX + made.errorW * crossing / made.last.w;
    float allowed = max(transport.tolerance.x * tau * made.last.w / crossing, kRounding * crossing);
    float least = transport.steps.y;
    float change = 0.9 * sqrt(sqrt(allowed / max(error, 1.0e-30)));
    return Control(error <= allowed || tau <= least,
                   clamp(tau * clamp(change, 0.2, 4.0), least, transport.steps.x), error);
}

// x and w gone on by a step's change. What rounding keeps back of one step goes to the next (Kahan
// 1965): kicks of the same small size would be rounded the same way every time, which bends a path by
// 1e-5 more or less than it should be.
void goOn(inout Ray ray, inout Ray lost, Ray change) {
    precise vec3 dx = change.x + lost.x;
    precise vec3 dw = change.w + lost.w;
    precise vec3 x = ray.x + dx;
    precise vec3 w = ray.w + dw;
    precise vec3 doneX = x - ray.x;
    precise vec3 doneW = w - ray.w;
    lost = Ray(dx - doneX, dw - doneW);
    ray = Ray(x, w);
}
