// What a rough interface makes of a ray: Snell's and Fresnel's laws on small facets.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets lie as GGX's distribution says (Walter et al. 2007), seen as Smith's shadowing lets them. A ray that a
// facet sends at another one meets that, too (Heitz et al. 2016), so that no light is lost. In what follows z is up,
// away from the interface on the side that the ray comes from. A height c is the share of the microsurface that
// is below: 1 above all of it.
#include "lib/fresnel.glsl"
#include "lib/random.glsl"

// Smith's Λ of a ray's direction, of length 1 [1]; below −1 downward.
float smithLambda(vec3 d, float alpha) {
    float z2 = max(d.z * d.z, 1.0e-12);
    float root = sqrt(1.0 + alpha * alpha * max(1.0 - d.z * d.z, 0.0) / z2);
    return 0.5 * ((d.z < 0.0 ? -root : root) - 1.0);
}

// A facet's normal, as many as are seen from that direction, up or down. u in [0, 1)². Dupuy and Benyoub 2023,
// "Sampling visible GGX normals with spherical caps".
vec3 visibleNormal(vec3 towards, float alpha, vec2 u) {
    vec3 t = normalize(vec3(alpha * towards.x, alpha * towards.y, towards.z));
    float z = (1.0 - u.y) * (1.0 + t.z) - t.z;
    float sine = sqrt(max(1.0 - z * z, 0.0));
    float angle = 6.283185307179586 * u.x;
    vec3 h = vec3(sine * cos(angle), sine * sin(angle), z) + t;
    return normalize(vec3(alpha * h.x, alpha * h.y, max(h.z, 1.0e-6)));
}

// Where a ray along d from height c meets the microsurface again; −1 if it leaves it. Heitz et al. 2016, eq. 11.
float nextHeight(vec3 d, float c, float alpha, float u) {
    float lambda = smithLambda(d, alpha);
    if (d.z > 0.9999 || (d.z > 0.0 && u >= 1.0 - pow(c, lambda))) return -1.0;
    return clamp(c / pow(1.0 - u, 1.0 / lambda), 1.0e-6, 1.0);
}

// A ray among facets: |w| is the index of its side.
struct Facing {
    vec3 w;
    bool beyond;  // it is on the far side, where z is down
    float height; // c
    uint seed;
    vec3 tint;    // of what metal has left of it
};

// A number in (0, 1), the k-th after a seed.
float numberAfter(uint seed, int k) {
    return (float(pcgHash(seed + uint(k)) >> 9u) + 0.5) * 1.1920928955078125e-7;
}

// What a ray that arrives along w first meets.
vec3 firstFacet(vec3 w, float alpha, vec2 u) {
    return visibleNormal(-normalize(w), alpha, u);
}

// A ray that comes from above and has been sent on along w by the facet that it met first.
Facing facingFrom(vec3 arrives, vec3 w, bool beyond, float alpha, uint seed) {
    float height = nextHeight(normalize(arrives), 1.0, alpha, numberAfter(seed, 0));
    return Facing(w, beyond, height, pcgHash(seed), vec3(1.0));
}

const int kMostFacets = 16; // that a ray meets; of α = 1 one in a million meets more

// Up to where it leaves the facets, of which each lets it through or reflects it by chance.
Facing amongFacets(Facing at, float n, float beyond, float alpha) {
    Facing ray = at;
    bool within = true;
    for (int i = 0; i < kMostFacets && within; ++i) {
        float turn = ray.beyond ? -1.0 : 1.0;
        vec3 d = turn * normalize(ray.w);
        float c = ray.beyond ? 1.0 - ray.height : ray.height;
        float next = nextHeight(d, max(c, 1.0e-6), alpha, numberAfter(ray.seed, 1));
        within = next >= 0.0;
        if (within) {
            vec2 u = vec2(numberAfter(ray.seed, 2), numberAfter(ray.seed, 3));
            vec3 facet = turn * visibleNormal(-d, alpha, u);
            Dielectric made = dielectricAt(ray.w, facet, ray.beyond ? beyond : n, ray.beyond ? n : beyond);
            bool reflects = numberAfter(ray.seed, 4) < made.reflectance;
            ray.w = reflects ? made.reflected : made.refracted;
            ray.beyond = reflects == ray.beyond;
            ray.height = turn < 0.0 ? 1.0 - next : next;
            ray.seed = pcgHash(ray.seed);
        }
    }
    float side = ray.beyond ? -1.0 : 1.0;
    ray.w.z = side * max(abs(ray.w.z), 1.0e-6); // one that has met too many leaves all the same
    return ray;
}

// The same of a metal, which lets nothing through and takes its share each time.
Facing amongMetalFacets(Facing at, vec3 index, vec3 extinction, float alpha) {
    Facing ray = at;
    bool within = true;
    for (int i = 0; i < kMostFacets && within; ++i) {
        vec3 d = normalize(ray.w);
        float next = nextHeight(d, ray.height, alpha, numberAfter(ray.seed, 1));
        within = next >= 0.0;
        if (within) {
            vec2 u = vec2(numberAfter(ray.seed, 2), numberAfter(ray.seed, 3));
            vec3 facet = visibleNormal(-d, alpha, u);
            float across = dot(ray.w, facet);
            ray.tint *= conductorReflectance(abs(across) / length(ray.w), index, extinction);
            ray.w -= 2.0 * across * facet;
            ray.height = next;
            ray.seed = pcgHash(ray.seed);
        }
    }
    ray.w.z = max(abs(ray.w.z), 1.0e-6);
    return ray;
}
