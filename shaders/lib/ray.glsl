// One step of a ray through the index field, for view rays and photons alike.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ray is its position x [voxel] and w = n dx/ds, so |w| = n. A field sample is
// (½∇(n²) [1/voxel], n). tau is the step of the Hamiltonian form, dx/dτ = w, dw/dτ = ½∇(n²), where
// dτ = ds/n [voxel]. Steps that look the field up themselves ask the entry file for it.

struct Ray {
    vec3 x;
    vec3 w;
};

vec4 fieldAt(vec3 x);

// Forward Euler with constant spatial step, dx/ds = w/n, dw/ds = ∇n: the sources' own scheme
// (Ihrke et al. 2007, eqs 9–10; Sun et al. 2008, eqs 4–5). First order. `field` is at ray.x.
Ray eulerStep(Ray ray, vec4 field, float ds) {
    Ray next;
    next.x = ray.x + (ds / field.w) * ray.w;
    next.w = ray.w + (ds / field.w) * vec3(field.x, field.y, field.z);
    return next;
}

// Störmer–Verlet in the Hamiltonian form, dx/dτ = w, dw/dτ = ½∇(n²): second order, symplectic, and
// exact where n² is linear. Drift–kick–drift: `field` is at verletMiddle(ray, tau).
vec3 verletMiddle(Ray ray, float tau) {
    return ray.x + (0.5 * tau) * ray.w;
}

Ray verletStep(Ray ray, vec4 field, float tau) {
    Ray next;
    next.w = ray.w + tau * vec3(field.x, field.y, field.z);
    next.x = ray.x + (0.5 * tau) * (ray.w + next.w);
    return next;
}

// The same step as kick–drift–kick, whose path is one straight piece: half a kick by the field at
// the start, a drift, half a kick by the field at the end, which the next step starts from.
vec3 halfKick(vec3 w, vec4 field, float tau) {
    return w + (0.5 * tau) * vec3(field.x, field.y, field.z);
}

// Verlet steps can be of fourth order for the price of second. In the potential U = ½n² the step's
// error is that of a slightly different U and a slight change of coordinates (Rowlands 1991, J.
// Comput. Phys. 97:235; Takahashi and Imada 1984). The first is made good beforehand by stepping in
// U + τ²/24 |∇U|², the second at both ends of a run of equal steps: `force` is ∇U at ray.x and `bend`
// its derivative along the ray, (w·∇)∇U.
Ray toVerlet(Ray ray, vec3 force, vec3 bend, float tau) {
    float c = tau * tau / 24.0;
    return Ray(ray.x + c * force, ray.w - c * bend);
}

Ray fromVerlet(Ray ray, vec3 force, vec3 bend, float tau) {
    float c = tau * tau / 24.0;
    return Ray(ray.x - c * force, ray.w + c * bend);
}

// Lengths are kept as what they exceed those of a straight way by: where w does not change that is 0,
// and no rounding of a step adds up. The optical path length is ∫ n ds = ∫ w·dx; `reference` is w at
// the beginning, and reference·Δx the share that the two ends of the way tell.

// ∫ (w − reference)·dx over a Verlet step, to fourth order together with verletEnd() added at the start
// of a run and taken off at its end.
float verletExcess(vec3 before, vec3 after, float tau, vec3 reference) {
    vec3 mean = 0.5 * (before + after);
    vec3 kick = after - before;
    return tau * (dot(mean - reference, mean) + dot(kick, kick) / 6.0);
}

// `force` is ∇U at the run's end in question, whose place toVerlet() moved.
float verletEnd(vec3 w, vec3 force, float tau, vec3 reference) {
    return tau * tau / 24.0 * dot(2.0 * w - reference, force);
}

// What a step gives.
struct Step {
    Ray end;
    Ray change;   // by how much x and w went on
    float excess; // ∫ (w − w₀)·dx over the step, w₀ being w at its start [voxel]
    vec4 last;    // the field at its end
    float errorX; // of an embedded step only: the error of x [voxel] and of w, estimated
    float errorW;
};

// The excess of a step of τ by Simpson's rule, from w and dw/dτ at both its ends. (From w, not from n:
// a look-up of n wavers within a voxel, w does not.)
float excessOf(vec3 before, vec3 after, vec3 forceBefore, vec3 forceAfter, float tau) {
    vec3 middle = 0.5 * (before + after) + (0.125 * tau) * (forceBefore - forceAfter);
    return (tau / 6.0) * (4.0 * dot(middle - before, middle) + dot(after - before, after));
}

// ∫ n² dτ = ∫ n ds over a step from a ray [voxel].
float opticalOf(Ray start, Step made) {
    return dot(start.w, made.change.x) + made.excess;
}

// Runge–Kutta–Nyström, fourth order in three look-ups: lens design's step (Sharma, Kumar and Ghatak
// 1982, Appl. Opt. 21:984, eqs 11–13).
Step sharmaStep(Ray ray, float tau) {
    vec4 a = fieldAt(ray.x);
    vec3 ga = vec3(a.x, a.y, a.z);
    vec4 b = fieldAt(ray.x + (0.5 * tau) * ray.w + (0.125 * tau * tau) * ga);
    vec3 gb = vec3(b.x, b.y, b.z);
    vec4 c = fieldAt(ray.x + tau * ray.w + (0.5 * tau * tau) * gb);
    vec3 gc = vec3(c.x, c.y, c.z);
    Ray change = Ray(tau * (ray.w + (tau / 6.0) * (ga + 2.0 * gb)),
                     (tau / 6.0) * (ga + 4.0 * gb + gc));
    Ray next = Ray(ray.x + change.x, ray.w + change.w);
    return Step(next, change, excessOf(ray.w, next.w, ga, gc, tau), c, 0.0, 0.0);
}

// The classical Runge–Kutta step of fourth order on (x, w), in four look-ups.
Step rk4Step(Ray ray, float tau) {
    float mid = 0.5 * tau;
    vec4 a = fieldAt(ray.x);
    vec3 ga = vec3(a.x, a.y, a.z);
    vec4 b = fieldAt(ray.x + mid * ray.w);
    vec3 gb = vec3(b.x, b.y, b.z);
    vec4 c = fieldAt(ray.x + mid * ray.w + (mid * mid) * ga);
    vec3 gc = vec3(c.x, c.y, c.z);
    vec4 d = fieldAt(ray.x + tau * ray.w + (tau * mid) * gb);
    vec3 gd = vec3(d.x, d.y, d.z);
    Ray change = Ray(tau * (ray.w + (tau / 6.0) * (ga + gb + gc)),
                     (tau / 6.0) * (ga + 2.0 * gb + 2.0 * gc + gd));
    Ray next = Ray(ray.x + change.x, ray.w + change.w);
    return Step(next, change, excessOf(ray.w, next.w, ga, gd, tau), d, 0.0, 0.0);
}

// An embedded Runge–Kutta–Nyström pair of orders 4 and 3, in three look-ups beside `first`, the field
// at ray.x, which the step before has looked up (Dormand, El-Mikkawy and Prince 1987, IMA J. Numer.
// Anal. 7:235, RKN4(3)4FM). Its own estimate is the error of the third order, which is not the one that
// goes on: by comparison with the whole kick it tells how much of a field's length τ is, and so what the
// next order is worth.
Step embeddedStep(Ray ray, vec4 first, float tau) {
    float t2 = tau * tau;
    vec3 ga = vec3(first.x, first.y, first.z);
    vec4 b = fieldAt(ray.x + (0.25 * tau) * ray.w + (t2 / 32.0) * ga);
    vec3 gb = vec3(b.x, b.y, b.z);
    vec4 c = fieldAt(ray.x + (0.7 * tau) * ray.w + t2 * (0.007 * ga + 0.238 * gb));
    vec3 gc = vec3(c.x, c.y, c.z);
    vec3 dx = tau * ray.w + t2 * (ga / 14.0 + (8.0 / 27.0) * gb + (25.0 / 189.0) * gc);
    vec3 x = ray.x + dx;
    vec4 d = fieldAt(x);
    vec3 gd = vec3(d.x, d.y, d.z);
    vec3 dw = tau * (ga / 14.0 + (32.0 / 81.0) * gb + (250.0 / 567.0) * gc + (5.0 / 54.0) * gd);
    vec3 w = ray.w + dw;
    // The differences of both orders' weights: subtracting both results would leave rounding.
    vec3 offX = t2 * ((62.0 / 525.0) * ga - (203.0 / 1350.0) * gb - (67.0 / 3780.0) * gc + 0.05 * gd);
    vec3 offW = tau * ((-23.0 / 42.0) * ga + (92.0 / 81.0) * gb - (575.0 / 567.0) * gc +
                       (23.0 / 54.0) * gd);
    float strength = max(max(dot(ga, ga), dot(gb, gb)), max(dot(gc, gc), dot(gd, gd)));
    float off = sqrt(dot(offW, offW));
    float share = 2.0 * sqrt(off / max(tau * sqrt(strength), 1.0e-20)); // 2: an oscillator's error
    return Step(Ray(x, w), Ray(dx, dw), excessOf(ray.w, w, ga, gd, tau), d,
                share * sqrt(dot(offX, offX)), share * off);
}

// A point of the way within a step, f from 0 to 1, by the cubic that has both ends' x and w: the
// integrator's own interpolant (Stone and Forbes 1990, J. Opt. Soc. Am. A 7:248).
Ray between(Ray a, Ray b, float tau, float f) {
    vec3 whole = b.x - a.x;
    vec3 c2 = 3.0 * whole - tau * (2.0 * a.w + b.w);
    vec3 c3 = tau * (a.w + b.w) - 2.0 * whole;
    vec3 w = a.w + (f / tau) * (2.0 * c2 + (3.0 * f) * c3);
    return Ray(a.x + f * (tau * a.w + f * (c2 + f * c3)), w);
}
