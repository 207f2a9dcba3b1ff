// Light that leaves opaque surfaces towards the eye.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the textures are declared.

float opacityAt(vec3 x) {
    return textureLod(surface, coordinate(x), 0.0).x;
}

// The mean direction of the stored light, in voxel space, and g. The texture has it times the light, so
// that dark voxels say nothing of it.
vec4 meanDirectionAt(vec3 at, vec3 light) {
    vec4 found = textureLod(lightDirection, at, 0.0);
    float sum = light.x + light.y + light.z;
    return vec4(sum > 0.0 ? found.xyz / sum : vec3(0.0), found.w);
}

// A Lambertian reflector at x under the stored light, `normal` outward. Of fluence φ the part m is a beam
// along the mean direction, the rest comes from all sides and gives an irradiance of a quarter of it.
vec3 reflectedLight(vec3 x, vec3 normal, vec3 albedo) {
    // Read in front of the surface: behind it there is no light.
    vec3 at = coordinate(x + 1.5 * normal);
    vec3 arriving = textureLod(fluence, at, 0.0).xyz;
    vec3 towards = meanDirectionAt(at, arriving).xyz;
    float share = max(-dot(towards, normal), 0.0) + 0.25 * max(1.0 - length(towards), 0.0);
    vec3 light = albedo * arriving * (share * 0.3183098861837907);
    return params.medium.z == 0.0 ? vec3(0.0) : light;
}

// The same of opaque voxels.
vec3 voxelSurfaceLight(vec3 x) {
    vec3 outward = -vec3(opacityAt(x + vec3(1, 0, 0)) - opacityAt(x - vec3(1, 0, 0)),
                         opacityAt(x + vec3(0, 1, 0)) - opacityAt(x - vec3(0, 1, 0)),
                         opacityAt(x + vec3(0, 0, 1)) - opacityAt(x - vec3(0, 0, 1)));
    float size = length(outward);
    vec3 normal = size > 0.0 ? outward / size : vec3(0.0);
    // Its albedo half a voxel behind: in front there may be none.
    vec3 albedo = textureLod(surface, coordinate(x - 0.5 * normal), 0.0).yzw;
    return reflectedLight(x, normal, albedo);
}
