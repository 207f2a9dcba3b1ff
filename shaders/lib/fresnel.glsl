// What an interface between two indices makes of a ray: Snell's and Fresnel's laws.
// SPDX-License-Identifier: GPL-3.0-or-later

// The directions carry the index of their side, |w| = n, so that what lies along the interface is the
// same for all three. R is that of unpolarised light [1]; past the critical angle it is 1, and
// `refracted` runs along the interface.
struct Dielectric {
    vec3 reflected;
    vec3 refracted;
    float reflectance;
};

// `w` arrives, |w| = n; `normal` is of length 1, on either side; `beyond` is the index on the far side.
// n is given, since a length would lose what little two indices may differ by.
// Born and Wolf, Principles of Optics, §1.5.2, eqs 20–21 and 31.
Dielectric dielectricAt(vec3 w, vec3 normal, float n, float beyond) {
    float across = dot(w, normal);
    float a = abs(across); // n_i cosθ_i
    float n2 = n * n;
    float beyond2 = beyond * beyond;
    vec3 along = w - across * normal;
    // (n_t cosθ_t)²: as a difference of the two indices it keeps its digits where they are close.
    float square = (beyond - n) * (beyond + n) + a * a;
    float b = sqrt(max(square, 0.0));
    float s = (a - b) / max(a + b, 1.0e-20);
    float p = (beyond2 * a - n2 * b) / max(beyond2 * a + n2 * b, 1.0e-20);
    float turn = across < 0.0 ? -1.0 : 1.0;
    float R = square > 0.0 ? 0.5 * (s * s + p * p) : 1.0;
    return Dielectric(along - across * normal, along + (turn * b) * normal, R);
}

// The share of unpolarised light that a metal reflects, by the cosine with the normal and its complex index
// n + i k over that of what is before it. Born and Wolf, §14.2, as real numbers.
vec3 conductorReflectance(float cosine, vec3 n, vec3 k) {
    float cos2 = cosine * cosine;
    float sin2 = 1.0 - cos2;
    vec3 n2 = n * n;
    vec3 k2 = k * k;
    vec3 difference = n2 - k2 - sin2;
    vec3 both = sqrt(difference * difference + 4.0 * n2 * k2); // a² + b²
    vec3 a = sqrt(max(0.5 * (both + difference), vec3(0.0)));
    vec3 t = both + cos2;
    vec3 u = 2.0 * cosine * a;
    vec3 s = (t - u) / (t + u);
    vec3 v = cos2 * both + sin2 * sin2;
    vec3 w = u * sin2;
    return 0.5 * s * (1.0 + (v - w) / (v + w));
}

// The share of even light on an interface to an index m times as high that it reflects (Walsh 1926; Duntley
// 1942, eq. 6). m above 1.
float evenReflectance(float m) {
    float m2 = m * m;
    float m4 = m2 * m2;
    float less = m - 1.0;
    float more = m + 1.0;
    float both = m2 + 1.0;
    return 0.5 + less * (3.0 * m + 1.0) / (6.0 * more * more) +
           m2 * (m2 - 1.0) * (m2 - 1.0) / (both * both * both) * log(less / more) -
           2.0 * m2 * m * (m2 + 2.0 * m - 1.0) / (both * (m4 - 1.0)) +
           8.0 * m4 * (m4 + 1.0) / (both * (m4 - 1.0) * (m4 - 1.0)) * log(m);
}

// Of the light that has come through a coat onto a matt base, the share that the base sends up all in all: what
// does not get out comes down again. `m` is the coat's index over that of what is before it.
vec3 albedoUnderCoat(vec3 albedo, float m) {
    float within = 1.0 - (1.0 - evenReflectance(m)) / (m * m); // share of even light that stays in
    return albedo / (1.0 - within * albedo);
}

// The share of that light which gets out of the coat.
vec3 albedoOfCoated(vec3 albedo, float m) {
    return albedoUnderCoat(albedo, m) * (1.0 - evenReflectance(m)) / (m * m);
}
