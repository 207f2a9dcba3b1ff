// Rays and polarisation in a uniaxial crystal that varies from place to place.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A crystal is its n_o and the tensor D = (n_e² − n_o²) a aᵀ, a being the axis: D does not change with a's sign and
// goes to 0 where the medium is isotropic, so that both may be interpolated. ε = n_o² + D. With k in units of ω/c:
//   o: H = ½ (k²/n_o² − 1)
//   e: H = ½ ((k² + k·Dk/n_o²) / n_e² − 1), n_e² = n_o² + tr D, which is ½ (k_∥²/n_o² + k_⊥²/n_e² − 1)
//   dx/dτ = ∂H/∂k, dk/dτ = −∂H/∂x
// (Born and Wolf, Principles of Optics, §15.3; Sluijter, de Boer, Braat 2008, J. Opt. Soc. Am. A 25:1260.)

// What a crystal is at a point, and how it varies there.
struct VaryingCrystal {
    float o;      // n_o
    vec3 pure;    // D_xx, D_yy, D_zz
    vec3 mixed;   // D_yz, D_zx, D_xy
    vec3 slopeO;  // ∇ n_o [1/voxel]
    vec3 slopeT;  // ∇ tr D
    vec3 slopeKK; // ∇ (k·Dk), k staying as it is
};

// At x, for a wave of wave vector k. The entry file's, or the test's.
VaryingCrystal varyingCrystalAt(int region, vec3 x, vec3 k);

vec3 timesD(vec3 pure, vec3 mixed, vec3 v) {
    return vec3(pure.x * v.x + mixed.z * v.y + mixed.y * v.z, mixed.z * v.x + pure.y * v.y + mixed.x * v.z,
                mixed.y * v.x + mixed.x * v.y + pure.z * v.z);
}

// ∂H/∂k and −∂H/∂x, and n_o there.
struct Flow {
    vec3 x;
    vec3 k;
    float o;
};

Flow flowOf(VaryingCrystal here, bool extraordinary, vec3 k) {
    float o2 = here.o * here.o;
    vec3 slope2 = (2.0 * here.o) * here.slopeO; // of n_o²
    float kk = dot(k, k);
    if (!extraordinary) return Flow(k / o2, (0.5 * kk / (o2 * o2)) * slope2, here.o);
    vec3 Dk = timesD(here.pure, here.mixed, k);
    float kDk = dot(k, Dk);
    float e2 = o2 + here.pure.x + here.pure.y + here.pure.z;
    float g = (kk + kDk / o2) / e2;
    vec3 slope = here.slopeKK / o2 - (kDk / (o2 * o2)) * slope2 - g * (slope2 + here.slopeT);
    return Flow((k + Dk / o2) / e2, (-0.5 / e2) * slope, here.o);
}

// H of a wave, which its ray keeps.
float hamiltonianOf(VaryingCrystal here, bool extraordinary, vec3 k) {
    float o2 = here.o * here.o;
    float g = dot(k, k) / o2;
    if (extraordinary)
        g = (dot(k, k) + dot(k, timesD(here.pure, here.mixed, k)) / o2) /
            (o2 + here.pure.x + here.pure.y + here.pure.z);
    return 0.5 * (g - 1.0);
}

// By how much a step goes on, and the flow at its end.
struct VaryingStep {
    Flow change;
    Flow last;
};

// A step of dτ by the classical Runge–Kutta method of fourth order from where the flow is `first`. In a loop, since
// each look-up is long.
VaryingStep varyingStep(int region, bool extraordinary, vec3 x, vec3 k, Flow first, float tau) {
    Flow sum = first;
    Flow change = first;
    Flow last = first;
    for (int stage = 1; stage <= 4; ++stage) {
        float ahead = stage < 3 ? 0.5 * tau : tau;
        change = Flow(ahead * last.x, ahead * last.k, 0.0);
        if (stage == 4) change = Flow((tau / 6.0) * sum.x, (tau / 6.0) * sum.k, 0.0);
        vec3 here = k + change.k;
        last = flowOf(varyingCrystalAt(region, x + change.x, here), extraordinary, here);
        float weight = stage < 3 ? 2.0 : 1.0;
        sum = Flow(sum.x + weight * last.x, sum.k + weight * last.k, 0.0);
    }
    return VaryingStep(change, last);
}

// The axis of length 1, of either sign, of what is uniaxial but for interpolation: D's own vector of the value
// that is furthest from 0. 0 where D is 0.
vec3 axisOf(vec3 pure, vec3 mixed) {
    vec3 a = abs(pure);
    vec3 v = vec3(pure.x, mixed.z, mixed.y); // the column that has most of it
    if (a.y >= a.x && a.y >= a.z) v = vec3(mixed.z, pure.y, mixed.x);
    else if (a.z >= a.x) v = vec3(mixed.y, mixed.x, pure.z);
    for (int i = 0; i < 3; ++i) {
        float size = sqrt(dot(v, v));
        if (size < 1.0e-12) return vec3(0.0);
        v = timesD(pure, mixed, v / size);
    }
    float size = sqrt(dot(v, v));
    return size < 1.0e-12 ? vec3(0.0) : v / size;
}

// Polarisation of both waves as one, in a medium that is nearly isotropic. Stokes' s = (s1, s2, s3) over s0 are by
// E along two vectors f, g across the ray of direction d, g = f × d. On its way s turns about
// ω = (D_ff − D_gg, 2 D_fg, 0) 2π/λ / (n_o + N), N being the e-wave's index: what is polarised along D's own vector
// lags behind what is across it by 2π/λ (N − n_o) a length, to first order of that (the quasi-isotropic approximation:
// Kravtsov and Orlov 1990, Geometrical Optics of Inhomogeneous Media).

// A vector across d, of length 1.
vec3 acrossOf(vec3 d) {
    vec3 helper = abs(d.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 f = cross(d, helper);
    return f / sqrt(dot(f, f));
}

// ω over 2π/λ.
vec3 retardance(VaryingCrystal here, vec3 f, vec3 g) {
    vec3 Df = timesD(here.pure, here.mixed, f);
    float ff = dot(f, Df);
    float gg = dot(g, timesD(here.pure, here.mixed, g));
    float o2 = here.o * here.o;
    return vec3(ff - gg, 2.0 * dot(g, Df), 0.0) / (here.o + sqrt(max(o2 + ff + gg, 0.25 * o2)));
}

// s turned about `turn` by its length [rad].
vec3 turnedAbout(vec3 turn, vec3 s) {
    float angle = sqrt(dot(turn, turn));
    if (angle < 1.0e-12) return s;
    vec3 m = turn / angle;
    float c = cos(angle);
    return c * s + sin(angle) * cross(m, s) + ((1.0 - c) * dot(m, s)) * m;
}

// A piece of way of that length, by ω at its Gauss points, 1/2 ∓ √3/6: Magnus' series to fourth order (Blanes et al.
// 2009, Phys. Rep. 470:151).
vec3 polarisedOn(vec3 s, vec3 first, vec3 second, float extent) {
    const float kThird = 0.14433756729740643; // √3/12
    return turnedAbout((0.5 * extent) * (first + second) + (kThird * extent * extent) * cross(second, first), s);
}

// s by vectors f, g as one by e, e × d, all across d.
vec3 polarisedBy(vec3 s, vec3 f, vec3 g, vec3 e) {
    float c = dot(e, f);
    float n = dot(e, g);
    float whole = max(c * c + n * n, 1.0e-20);
    float c2 = (c * c - n * n) / whole;
    float s2 = 2.0 * c * n / whole;
    return vec3(c2 * s.x + s2 * s.y, c2 * s.y - s2 * s.x, s.z);
}
