// Light that leaves opaque surfaces towards the eye.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the textures are declared.
#include "transport/opaque_voxels.glsl"
#include "transport/surface_voxels.glsl"

layout(binding = kIrradianceUnit) uniform sampler3D irradiance; // by surface voxels' numbers [W/m²]

float opacityAt(vec3 x) {
    return textureLod(surfaceOpacity, coordinate(x), 0.0).x;
}

// The irradiance that a fine voxel stores, and 1; 0 if it stores none.
vec4 storedIrradiance(ivec3 fine) {
    int number = surfaceVoxelOf(fine);
    if (number < 0) return vec4(0.0);
    vec3 found = vec3(texelFetch(irradiance, surfaceTexel(number), 0).x);
    if (SURFACES == 3) {
        found.y = texelFetch(irradiance, surfaceTexel(number + int(surface.table.w)), 0).x;
        found.z = texelFetch(irradiance, surfaceTexel(number + 2 * int(surface.table.w)), 0).x;
    }
    return vec4(found, 1.0);
}

// The irradiance of a surface at x, `normal` outward, between the four columns of fine voxels along the
// normal's longest axis whose middles are round it. Each is asked where the surface's plane passes it.
vec3 irradianceAt(vec3 x, vec3 normal) {
    int axis = axisOf(normal);
    ivec3 along = axisVector(axis);
    ivec3 u = axis == 0 ? ivec3(0, 1, 0) : ivec3(1, 0, 0);
    ivec3 v = axis == 2 ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
    vec3 at = (x + 0.5) * float(surface.size.w);
    vec2 p = vec2(dot(at, vec3(u)), dot(at, vec3(v))) - 0.5;
    vec2 base = floor(p);
    vec2 share = p - base;
    vec2 slope = -vec2(dot(normal, vec3(u)), dot(normal, vec3(v))) / dot(normal, vec3(along));
    float height = dot(at, vec3(along));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(i & 1, i >> 1);
        vec2 column = base + corner;
        float there = height + dot(slope, column - p);
        float whole = floor(there);
        ivec3 fine = ivec3(column.x) * u + ivec3(column.y) * v + ivec3(whole) * along;
        vec4 found = storedIrradiance(fine);
        int nearer = there - whole < 0.5 ? -1 : 1;
        if (found.w == 0.0) found = storedIrradiance(fine + nearer * along);
        if (found.w == 0.0) found = storedIrradiance(fine - nearer * along);
        vec2 weight = mix(1.0 - share, share, corner);
        sum += max(weight.x * weight.y, 1.0e-6) * found;
    }
    return sum.w > 0.0 ? sum.xyz / sum.w : vec3(0.0);
}

// A Lambertian reflector at x under the stored light, `normal` outward.
vec3 reflectedLight(vec3 x, vec3 normal, vec3 albedo) {
    if (SURFACES == 0) return vec3(0.0);
    return albedo * irradianceAt(x, normal) * 0.3183098861837907;
}

// The same of opaque voxels.
vec3 voxelSurfaceLight(vec3 x) {
    vec3 normal = opaqueNormalAt(x);
    // Its albedo half a voxel behind: in front there may be none.
    vec3 albedo = textureLod(surfaceOpacity, coordinate(x - 0.5 * normal), 0.0).yzw;
    return reflectedLight(x, normal, albedo);
}
