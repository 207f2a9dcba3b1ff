// Light that leaves opaque surfaces towards the eye.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the textures are declared.
#include "transport/opaque_voxels.glsl"
#include "transport/surface_columns.glsl"

layout(binding = kIrradianceUnit) uniform sampler3D irradiance; // by surface voxels' numbers [W/m²]

float opacityAt(vec3 x) {
    return textureLod(surfaceOpacity, coordinate(x), 0.0).x;
}

// The irradiance of a surface at x, `normal` outward.
vec3 irradianceAt(vec3 x, vec3 normal) {
    Columns columns = columnsAt(x, normal);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int number = columns.numbers[i];
        if (number < 0) continue;
        vec3 found = vec3(texelFetch(irradiance, surfaceTexel(number), 0).x);
        if (SURFACES == 3) {
            found.y = texelFetch(irradiance, surfaceTexel(number + int(surface.table.w)), 0).x;
            found.z = texelFetch(irradiance, surfaceTexel(number + 2 * int(surface.table.w)), 0).x;
        }
        sum += columns.weights[i] * found;
    }
    return sum;
}

#if POINTS == 1
layout(binding = kPointPlacesUnit) uniform sampler2D pointPlaces; // [voxel]; w: 1 where there is a point
layout(binding = kPointLightsUnit) uniform sampler2D pointLights; // irradiance [W/m²]

// Light at x from the points of the four pixels round the place that the ray goes through, those nearest to x
// first: what lies beyond an edge counts for little. w is 0 where they have no point.
vec4 lightOfPoints(vec3 x, vec2 at) {
    ivec2 low = ivec2(floor(at - 0.5));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = clamp(low + ivec2(i & 1, i >> 1), ivec2(0), textureSize(pointPlaces, 0) - 1);
        vec4 place = texelFetch(pointPlaces, pixel, 0);
        vec3 off = place.xyz - x;
        sum += place.w / (dot(off, off) + 1.0e-8) * vec4(texelFetch(pointLights, pixel, 0).xyz, 1.0);
    }
    return sum.w > 0.0 ? vec4(sum.xyz / sum.w, 1.0) : vec4(0.0);
}
#endif

// Of a path that ends at x, `normal` outward, on its first branch or another. [W/m²]
vec3 irradianceOn(vec3 x, vec3 normal, bool first) {
#if POINTS == 1
    if (first) {
        vec4 found = lightOfPoints(x, vec2(pixelNow) + params.pattern.xy);
        if (found.w > 0.0) return found.xyz;
    }
#endif
    if (SURFACES == 0) return vec3(0.0);
    return irradianceAt(x, normal);
}

// Opaque voxels' albedo half a voxel behind their surface: in front there may be none.
vec3 opaqueAlbedoAt(vec3 x, vec3 normal) {
    return textureLod(surfaceOpacity, coordinate(x - 0.5 * normal), 0.0).yzw;
}
