// The domain's faces, where rays leave.
// SPDX-License-Identifier: GPL-3.0-or-later

bool isOutside(vec3 x, vec3 centre, vec3 halfSize) {
    return any(greaterThan(abs(x - centre), halfSize));
}

// The share of a step that ends outside after which its interpolant leaves the domain.
float shareInside(Ray start, Ray end, float tau, vec3 centre, vec3 halfSize) {
    float inside = 0.0;
    float outside = 1.0;
    for (int i = 0; i < 12; ++i) { // a straight piece makes good what is left
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
