// What a ray sees that leaves the scene: nothing, a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `kMap` says whether there is a map.
#include "lib/latlong.glsl"

layout(binding = kEnvironmentUnit) uniform sampler2D environment;

// Bilinear by hand: the map wraps along its rows and is clamped along its columns.
vec3 mapAt(vec2 uv, bool byEdges) {
    ivec2 size = textureSize(environment, 0);
    vec2 p = byEdges ? uv * vec2(size - 1) : uv * vec2(size) - 0.5;
    vec2 low = floor(p);
    vec2 share = p - low;
    ivec2 a = ivec2(low);
    // Not by %: software devices divide integers one by one.
    int left = byEdges ? clamp(a.x, 0, size.x - 1) : a.x < 0 ? a.x + size.x : a.x;
    int right = byEdges ? clamp(a.x + 1, 0, size.x - 1) : a.x + 1 < size.x ? a.x + 1 : a.x + 1 - size.x;
    int top = clamp(a.y, 0, size.y - 1);
    int bottom = clamp(a.y + 1, 0, size.y - 1);
    vec3 upper = mix(texelFetch(environment, ivec2(left, top), 0).xyz,
                     texelFetch(environment, ivec2(right, top), 0).xyz, share.x);
    vec3 lower = mix(texelFetch(environment, ivec2(left, bottom), 0).xyz,
                     texelFetch(environment, ivec2(right, bottom), 0).xyz, share.x);
    return mix(upper, lower, share.y);
}

// Radiance from a unit direction in the map's frame; `background` is as camera::backgroundValues() has it.
vec3 environmentLight(vec3 d, vec4 background) {
    return kMap ? mapAt(latLongOf(d), background.w == 3.0) : background.xyz;
}
