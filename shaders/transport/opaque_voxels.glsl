// Opaque voxels of blurred boundaries: their surface is where the opacity passes ½.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entry file says what the opacity is.

float opacityAt(vec3 x);

// Outward and of length 1, or 0 where nothing tells.
vec3 opaqueNormalAt(vec3 x) {
    vec3 outward = vec3(opacityAt(x - vec3(1, 0, 0)) - opacityAt(x + vec3(1, 0, 0)),
                        opacityAt(x - vec3(0, 1, 0)) - opacityAt(x + vec3(0, 1, 0)),
                        opacityAt(x - vec3(0, 0, 1)) - opacityAt(x + vec3(0, 0, 1)));
    float size = length(outward);
    return size > 0.0 ? outward / size : vec3(0.0);
}

// Where opaque voxels begin between a point outside them and one inside.
vec3 opaqueBetween(vec3 outside, vec3 inside) {
    for (int i = 0; i < 12; ++i) {
        vec3 middle = 0.5 * (outside + inside);
        if (opacityAt(middle) > 0.5) inside = middle;
        else outside = middle;
    }
    return inside;
}
