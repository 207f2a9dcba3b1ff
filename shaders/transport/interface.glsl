// What an interface between two media does to light: the rays that go on from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/fresnel.glsl"
#include "lib/microfacet.glsl"
#include "transport/intersect.glsl"
#include "transport/path.glsl"

// What is where a path meets a boundary.
struct Interface {
    vec3 x;
    vec3 normal;   // of length 1, on the far side
    int object;    // whose boundary it is
    int here;      // the regions on the near and the far side
    int there;
    float n;       // their indices
    float beyond;
    int mode;          // what arrives, as in a path
    vec3 polarisation;
    ObjectSet objects; // those that hold the far side
    // What decides about a rough one, which the entry file may set: a place in [0, 1)² chooses the first facet,
    // a number all else.
    vec2 facetPlace;
    uint facetSeed;
};

// A ray that goes on.
struct Outgoing {
    vec3 w;
    float share;   // of the light that arrives; all shares add up to 1
    vec3 tint;     // what is left of that share, rgb
    ObjectSet objects;
    float departs; // how steeply it leaves, the cosine with the normal
    int mode;      // as in a path
    vec3 polarisation;
};
const int kMostOutgoing = kCrystals ? 4 : 2;

// The objects that hold the far side of a boundary met at x by a ray along w; `normal` is there.
// Objects that touch there are one boundary: a ray that is about to go through that of another one has
// done so, if a little way off that one rules.
ObjectSet objectsBeyond(ObjectSet objects, int object, vec3 x, vec3 w, vec3 normal) {
    ObjectSet after = toggled(objects, object);
    ObjectSet close = changed(closeTo(x), object, false);
    ObjectSet rest = close;
    for (int i = 0; kObjects > 1 && i < slotsOf(close); ++i) {
        int k = objectAt(rest);
        vec4 found = distanceAt(k, x);
        bool leaves = sideOf(objects, k) * dot(found.xyz, w) >= 0.0;
        if (leaves || abs(found.w) > 2.0 * kTouch) continue;
        after = changed(after, k, distanceAt(k, x + kTouch * normal).w < 0.0);
    }
    return after;
}

Interface interfaceAt(Path path, Hit hit) {
    vec3 normal = hit.gradient / max(length(hit.gradient), 1.0e-20);
    vec3 x = path.ray.x;
    vec3 along = path.ray.w;
    int here = regionOf(path.objects);
    if (isCrystal(here)) along = rayDirection(uniaxialOf(here, x), path.mode, along);
    if (dot(along, normal) < 0.0) normal = -normal;
    ObjectSet after = objectsBeyond(path.objects, hit.object, x, along, normal);
    int there = regionOf(after);
    Interface at = Interface(x, normal, hit.object, here, there, indexOf(here, x), indexOf(there, x), path.mode,
                             path.polarisation, after, vec2(0.5), 0u);
#if CRYSTALS == 2
    int bends = bendsOrdinary(there) ? there : here; // no two that vary meet
    if (bendsOrdinary(bends)) {
        float o = varyingCrystalAt(bends, x, vec3(0.0)).o;
        if (bends == here) at.n = o;
        if (bends == there) at.beyond = o;
    }
#endif
    return at;
}

// Whether a matt object has a coat there.
bool isCoated(Interface at) {
    return kCoats && isMatt(at.there) && at.beyond > at.n;
}

// Whether light goes on as if there were nothing.
bool isNothing(Interface at) {
    if (isCrystal(at.here) || isCrystal(at.there)) return at.here == at.there;
    return at.here == at.there || (at.n == at.beyond && !isMetal(at.there));
}

// x, y and the normal towards the side that a ray comes from.
mat3 frameOf(Interface at) {
    vec3 z = -at.normal;
    vec3 helper = abs(z.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 x = normalize(cross(z, helper));
    return mat3(x, cross(z, x), z);
}

// A ray that has left the facets of a rough interface.
Outgoing outgoingFrom(Interface at, mat3 frame, Facing ray, float share, vec3 tint, ObjectSet objects) {
    float n = ray.beyond ? at.beyond : at.n;
    vec3 w = frame * (ray.w * (n / length(ray.w)));
    ObjectSet holds = objects;
    if (ray.beyond) holds = at.objects;
    return Outgoing(w, share, tint * ray.tint, holds, abs(ray.w.z) / length(ray.w), kUnsplit, vec3(0.0));
}

// Rays beyond and back from a rough interface; but that further facets may turn each.
int scatterRough(Interface at, vec3 w, ObjectSet objects, float alpha, out Outgoing outgoing[kMostOutgoing]) {
    mat3 frame = frameOf(at);
    vec3 arrives = w * frame;
    vec3 facet = firstFacet(arrives, alpha, at.facetPlace);
    Dielectric made = dielectricAt(arrives, facet, at.n, at.beyond);
    vec3 mirrors = scene.regions[at.object].reflectance.xyz;
    Facing back = facingFrom(arrives, made.reflected, false, alpha, at.facetSeed);
    back = amongFacets(back, at.n, at.beyond, alpha);
    outgoing[1] = outgoingFrom(at, frame, back, made.reflectance, mirrors, objects);
    outgoing[0] = outgoing[1];
    bool total = made.reflectance == 1.0;
    if (!total) {
        Facing on = facingFrom(arrives, made.refracted, true, alpha, pcgHash(at.facetSeed ^ 0x9E3779B9u));
        on = amongFacets(on, at.n, at.beyond, alpha);
        outgoing[0] = outgoingFrom(at, frame, on, 1.0 - made.reflectance, vec3(1.0), objects);
    }
    return total ? 1 : 2;
}

// The ray back from metal.
int scatterMetal(Interface at, vec3 w, ObjectSet objects, float alpha, out Outgoing outgoing[kMostOutgoing]) {
    vec3 index = scene.regions[at.there].metalIndex.xyz / at.n;
    vec3 extinction = scene.regions[at.there].metalExtinction.xyz / at.n;
    vec3 mirrors = scene.regions[at.object].reflectance.xyz;
    float across = dot(w, at.normal);
    if (kRoughBoundaries && alpha > 0.0) {
        mat3 frame = frameOf(at);
        vec3 arrives = w * frame;
        vec3 facet = firstFacet(arrives, alpha, at.facetPlace);
        float towards = dot(arrives, facet);
        Facing back = facingFrom(arrives, arrives - 2.0 * towards * facet, false, alpha, at.facetSeed);
        back.tint = conductorReflectance(min(-towards / at.n, 1.0), index, extinction);
        back = amongMetalFacets(back, index, extinction, alpha);
        outgoing[0] = outgoingFrom(at, frame, back, 1.0, mirrors, objects);
    } else {
        float cosine = min(across / at.n, 1.0);
        outgoing[0] = Outgoing(w - 2.0 * across * at.normal, 1.0,
                               mirrors * conductorReflectance(cosine, index, extinction), objects, cosine,
                               kUnsplit, vec3(0.0));
    }
    outgoing[1] = outgoing[0];
    return 1;
}

#include "transport/crystal.glsl"

// The rays into which one that arrives within `objects` parts: what is refracted first, if anything is.
// Returns how many.
int scatterAt(Interface at, vec3 arriving, ObjectSet objects, out Outgoing outgoing[kMostOutgoing]) {
#if CRYSTALS > 0
    return scatterPolarised(at, arriving, objects, outgoing);
#endif
    vec3 w = arriving * (at.n / length(arriving));
    if (kMetals || kRoughBoundaries) {
        float alpha = scene.regions[at.object].reflectance.w;
        if (isMetal(at.there)) return scatterMetal(at, w, objects, alpha, outgoing);
        if (kRoughBoundaries && alpha > 0.0) return scatterRough(at, w, objects, alpha, outgoing);
    }
    Dielectric made = dielectricAt(w, at.normal, at.n, at.beyond);
    Outgoing reflected =
        Outgoing(made.reflected, made.reflectance, scene.regions[at.object].reflectance.xyz, objects,
                 abs(dot(at.normal, made.reflected)) / at.n, kUnsplit, vec3(0.0));
    bool total = made.reflectance == 1.0;
    outgoing[1] = reflected;
    outgoing[0] = reflected;
    if (!total)
        outgoing[0] = Outgoing(made.refracted, 1.0 - made.reflectance, vec3(1.0), at.objects,
                               abs(dot(at.normal, made.refracted)) / at.beyond, kUnsplit, vec3(0.0));
    return total ? 1 : 2;
}
