// A picture upright behind the scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/plate_params.h"

layout(std140, binding = kPlateBlock) uniform Plate { PlateParams plate; };
layout(binding = kPlateUnit) uniform sampler2D platePicture; // radiance

// Where on the picture a place is: (−1, −1) lower left, (1, 1) upper right.
vec2 onPlate(vec3 x) {
    vec3 offset = x - plate.middle.xyz;
    return vec2(dot(plate.right.xyz, offset), dot(plate.up.xyz, offset));
}

// How far it is to the picture, or −1 where a ray does not come to it.
float wayToPlate(vec3 x, vec3 direction) {
    float along = dot(plate.forward.xyz, direction);
    if (along <= 0.0) return -1.0;
    float way = dot(plate.forward.xyz, plate.middle.xyz - x) / along;
    bool ends = plate.middle.w == 0.0 && any(greaterThan(abs(onPlate(x + way * direction)), vec2(1.0)));
    return ends ? -1.0 : way;
}

vec3 plateLight(vec3 x) {
    vec2 p = onPlate(x);
    return textureLod(platePicture, vec2(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y), 0.0).xyz;
}
