// The path of a pixel's first ray.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params` is declared, and kPaths says whether it is written.
layout(std430, binding = kPixelPathsBuffer) writeonly buffer Paths { SurfacePath paths[]; };

void recordPath(ivec2 pixel, SurfacePath path) {
    if (kPaths && params.picture.z == 0) paths[pixel.y * params.picture.x + pixel.x] = path;
}

// Of a ray that meets nothing.
SurfacePath freePath(vec3 start, vec3 direction) {
    return SurfacePath(vec4(start, 0.0), vec4(direction, 0.0), vec4(1.0, 1.0, 1.0, 0.0), vec4(0.0));
}
