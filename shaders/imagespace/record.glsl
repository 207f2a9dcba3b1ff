// What a pixel gets of one of its rays.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params` is declared, and kPaths says whether the first ray's path is written.
layout(std430, binding = kColoursBuffer) buffer Colours { vec4 colours[]; };
layout(std430, binding = kPixelPathsBuffer) writeonly buffer Paths { SurfacePath paths[]; };

void record(ivec2 pixel, vec3 light, bool changed, SurfacePath path) {
    int at = pixel.y * params.picture.x + pixel.x;
    vec4 colour = params.pattern.z * vec4(light, changed ? 1.0 : 0.0);
    colours[at] = params.picture.z == 0 ? colour : colours[at] + colour;
    if (kPaths && params.picture.z == 0) paths[at] = path;
}

// Of a ray that meets nothing.
SurfacePath freePath(vec3 start, vec3 direction) {
    return SurfacePath(vec4(start, 0.0), vec4(direction, 0.0), vec4(1.0, 1.0, 1.0, 0.0), vec4(0.0));
}
