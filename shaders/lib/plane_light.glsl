// What lights send on a plane, per radiant intensity or radiance of 1.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places are relative to the point of the plane that is lit, `normal` is the plane's, of length 1.

// Of a point: the cosine over the square of the distance.
float pointOnPlane(vec3 place, vec3 normal) {
    float square = dot(place, place);
    return max(dot(place, normal), 0.0) / (square * sqrt(square));
}

// The share of its intensity that a cone sends towards the point; `axis` of length 1. It fades smoothly between
// two angles from its axis [rad].
float coneTowards(vec3 place, vec3 axis, float inner, float outer) {
    vec3 off = cross(axis, place);
    float angle = atan(sqrt(dot(off, off)), -dot(axis, place));
    float t = clamp((outer - angle) / max(outer - inner, 1.0e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Of a sphere about `place`, of which the plane may cut off a part (Snyder 1996, "Area light sources for real-time
// graphics", MSR-TR-96-11). Within it is dark.
float sphereOnPlane(vec3 place, float radius, vec3 normal) {
    const float kPi = 3.141592653589793;
    float square = dot(place, place) / (radius * radius);
    if (square <= 1.0) return 0.0;
    float cosine = dot(place, normal) / sqrt(dot(place, place));
    float cut = 1.0 - square * cosine * cosine; // above 0 where the plane passes the sphere
    if (cut <= 0.0) return kPi * max(cosine, 0.0) / square;
    float beyond = square - 1.0;
    float c = -cosine * sqrt(beyond / (1.0 - cosine * cosine));
    float angle = atan(sqrt(max(1.0 - c * c, 0.0)), c);
    return (cosine * angle - sqrt(cut * beyond)) / square + atan(sqrt(cut), sqrt(beyond));
}

// Of a polygon, the part of its edge from a to b: half the angle that it fills, by the cosine between the normals
// of the plane and of the angle's own (Lambert 1760). All edges add up, in their order round it; the sign is that of
// the side it is seen from.
float edgeOnPlane(vec3 a, vec3 b, vec3 normal) {
    vec3 across = cross(a, b);
    float size = sqrt(dot(across, across));
    return size > 0.0 ? 0.5 * atan(size, dot(a, b)) * dot(across, normal) / size : 0.0;
}
