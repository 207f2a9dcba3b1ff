// The ground: an infinite plane, of which the domain holds a part.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Within the domain it is an object, and light is stored on it. Beyond, it has what the lights send that are
// recorded, without shadows.
#include "lib/plane_light.glsl"
#include "shared/ground_params.h"

layout(std140, binding = kGroundBlock) uniform Ground { GroundParams ground; };

// Above the plane, negative below [voxel].
float heightOf(vec3 x) {
    return dot(ground.plane.xyz, x) + ground.plane.w;
}

// A path that leaves the domain on the plane is above it, whatever rounding says [voxel].
const float kOnGround = 1.0e-3;

bool isAbove(vec3 x) {
    return heightOf(x) > -kOnGround;
}

// How far it is to the plane, or −1 where a ray does not come to it.
float wayToGround(vec3 x, vec3 direction) {
    float falls = -dot(ground.plane.xyz, direction);
    float height = heightOf(x);
    if (isAbove(x)) return falls > 0.0 ? max(height, 0.0) / falls : -1.0;
    return falls < 0.0 ? height / falls : -1.0;
}

vec3 groundAlbedoAt(vec3 x) {
    float square = floor(dot(ground.right.xyz, x) + ground.right.w) +
                   floor(dot(ground.front.xyz, x) + ground.front.w);
    bool odd = square != 2.0 * floor(0.5 * square);
    return odd ? ground.albedo.w * ground.albedo.xyz : ground.albedo.xyz;
}

float polygonAt(int i, vec3 x) {
    vec3 place = ground.lights[i].place.xyz - x;
    float towards = -dot(ground.lights[i].axis.xyz, place);
    if (towards <= 0.0) return 0.0;
    float square = dot(place, place);
    // Far off its edges' parts all but cancel.
    if (square > ground.lights[i].rgb.w * ground.lights[i].rgb.w)
        return ground.lights[i].place.w * towards * pointOnPlane(place, ground.plane.xyz) / sqrt(square);
    float sum = 0.0;
    int corners = ground.lights[i].kind.y;
    vec3 last = ground.lights[i].corners[corners - 1].xyz - x;
    for (int k = 0; k < corners; ++k) {
        vec3 next = ground.lights[i].corners[k].xyz - x;
        sum += edgeOnPlane(last, next, ground.plane.xyz);
        last = next;
    }
    return abs(sum);
}

// Whether what is stored at a place is not the ground's alone, or nothing is: in the outermost surface voxels there
// is what falls on the side of the domain that cuts the ground open, and in those that points had, which are no
// larger than a voxel. Beyond the ground's own box nothing is.
bool isAtSide(vec3 x) {
    float margin = 0.0;
    if (POINTS == 1) margin = 1.0;
    else if (SURFACES > 0) margin = 1.5 / float(surface.size.w);
    return any(lessThan(x, ground.low.xyz + margin)) || any(greaterThan(x, ground.high.xyz - margin));
}

// At a point of the plane [W/m²].
vec3 groundIrradianceAt(vec3 x) {
    vec3 sum = ground.constant.xyz;
    for (int i = 0; i < ground.numbers.x; ++i) {
        vec3 place = ground.lights[i].place.xyz - x;
        int kind = ground.lights[i].kind.x;
        float share = 0.0;
        if (kind == kPolygonLight) share = polygonAt(i, x);
        else if (kind == kSphereLight) share = sphereOnPlane(place, ground.lights[i].place.w, ground.plane.xyz);
        else share = pointOnPlane(place, ground.plane.xyz);
        if (kind == kConeLight)
            share *= coneTowards(place, ground.lights[i].axis.xyz, ground.lights[i].cone.x,
                                 ground.lights[i].cone.y);
        sum += share * ground.lights[i].rgb.xyz;
    }
    return sum;
}

// Radiance of the plane where a ray from x comes to it, `way` on: its underside is dark.
vec3 groundLight(vec3 x, vec3 direction, float way) {
    if (!isAbove(x)) return vec3(0.0);
    vec3 at = x + way * direction;
    return groundAlbedoAt(at) * groundIrradianceAt(at) * 0.3183098861837907;
}
