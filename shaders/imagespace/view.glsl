// The camera of methods in image space: pixels, rays and texels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, an ImageSpaceParams, is declared.

// Where a pixel's ray goes through the window, from -1 to 1.
vec2 windowOf(vec2 pixel) {
    return vec2(2.0, -2.0) * (pixel + params.pattern.xy) / vec2(params.picture.xy) + vec2(-1.0, 1.0);
}

// Through the middle of the texel at `pixel`, of length 1.
vec3 directionThrough(vec2 pixel) {
    return params.window.z == 1.0 ? normalize(vec3(windowOf(pixel) * params.window.xy, 1.0)) : vec3(0.0, 0.0, 1.0);
}

// Where that ray is at a depth.
vec3 pointAt(vec2 pixel, float depth) {
    return vec3(windowOf(pixel) * params.window.xy * (params.window.z == 1.0 ? depth : 1.0), depth);
}

// The place in the layers that a point is seen at [texel]; texels' middles are at halves.
vec2 texelOf(vec3 x) {
    vec2 seen = x.xy / (params.window.xy * (params.window.z == 1.0 ? x.z : 1.0));
    return (vec2(0.5, -0.5) * seen + 0.5) * vec2(params.picture.xy) + 0.5 - params.pattern.xy;
}

bool isInPicture(vec2 texel) {
    return all(greaterThanEqual(texel, vec2(0.0))) && all(lessThan(texel, vec2(params.picture.xy)));
}

// Radiance from a direction in camera space.
vec3 surroundingsLight(vec3 direction) {
    vec3 d = vec3(dot(params.mapFromCamera0.xyz, direction), dot(params.mapFromCamera1.xyz, direction),
                  dot(params.mapFromCamera2.xyz, direction));
    return environmentLight(d, params.background);
}
