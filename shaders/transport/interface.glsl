// What an interface between two media does to light: the rays that go on from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/fresnel.glsl"
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
    ObjectSet objects; // those that hold the far side
};

// A ray that goes on.
struct Outgoing {
    vec3 w;
    float share;   // of the light that arrives; all shares add up to 1
    vec3 tint;     // what is left of that share, rgb
    ObjectSet objects;
    float departs; // how steeply it leaves, the cosine with the normal
};
const int kMostOutgoing = 2;

// The objects that hold the far side of a boundary met at x by a ray along w; `normal` is there.
// Objects that touch there are one boundary: a ray that is about to go through that of another one has
// done so, if a little way off that one rules.
ObjectSet objectsBeyond(ObjectSet objects, int object, vec3 x, vec3 w, vec3 normal) {
    ObjectSet after = toggled(objects, object);
    ObjectSet close = closeTo(x);
    ObjectSet rest = close;
    for (int i = 0; kObjects > 1 && i < slotsOf(close); ++i) {
        int k = objectAt(rest, i);
        if (k == object || passesOver(close, k)) continue;
        vec4 found = distanceAt(k, x);
        bool leaves = sideOf(objects, k) * dot(found.xyz, w) >= 0.0;
        if (leaves || abs(found.w) > 2.0 * kTouch) continue;
        after = changed(after, k, distanceAt(k, x + kTouch * normal).w < 0.0);
    }
    return after;
}

Interface interfaceAt(Ray ray, ObjectSet objects, Hit hit) {
    vec3 normal = hit.gradient / max(length(hit.gradient), 1.0e-20);
    if (dot(ray.w, normal) < 0.0) normal = -normal;
    ObjectSet after = objectsBeyond(objects, hit.object, ray.x, ray.w, normal);
    int here = regionOf(objects);
    int there = regionOf(after);
    return Interface(ray.x, normal, hit.object, here, there, indexOf(here, ray.x),
                     indexOf(there, ray.x), after);
}

// Whether light goes on as if there were nothing.
bool isNothing(Interface at) {
    return at.here == at.there || at.n == at.beyond;
}

// The rays into which one along w, within `objects`, parts: what is refracted first, if anything is.
// Returns how many.
int scatterAt(Interface at, vec3 w, ObjectSet objects, out Outgoing outgoing[kMostOutgoing]) {
    Dielectric made = dielectricAt(w * (at.n / length(w)), at.normal, at.n, at.beyond);
    Outgoing reflected =
        Outgoing(made.reflected, made.reflectance, scene.regions[at.object].reflectance.xyz, objects,
                 abs(dot(at.normal, made.reflected)) / at.n);
    bool total = made.reflectance == 1.0;
    outgoing[1] = reflected;
    outgoing[0] = reflected;
    if (!total)
        outgoing[0] = Outgoing(made.refracted, 1.0 - made.reflectance, vec3(1.0), at.objects,
                               abs(dot(at.normal, made.refracted)) / at.beyond);
    return total ? 1 : 2;
}
