// One step of a ray through the index field, for view rays and photons alike.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ray is its position x [voxel] and w = n dx/ds, so |w| = n. A field sample is
// (½∇(n²) [1/voxel], n). tau is the step of the Hamiltonian form, dτ = ds/n [voxel].

struct Ray {
    vec3 x;
    vec3 w;
};

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
