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
