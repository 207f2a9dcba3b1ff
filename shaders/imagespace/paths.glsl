// The path of a pixel's first ray.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params` is declared, and AOVS says whether it is written.
#if AOVS == 1
layout(rgba32f, binding = kPathsImage) writeonly uniform image2DArray paths; // SurfacePath, a layer a member
#endif

void recordPath(ivec2 pixel, SurfacePath path) {
    #if AOVS == 1
    if (params.picture.z != 0) return;
    imageStore(paths, ivec3(pixel, 0), path.place);
    imageStore(paths, ivec3(pixel, 1), path.direction);
    imageStore(paths, ivec3(pixel, 2), path.through);
    imageStore(paths, ivec3(pixel, 3), path.outward);
#endif
}

// Of a ray that meets nothing.
SurfacePath freePath(vec3 start, vec3 direction) {
    return SurfacePath(vec4(start, 0.0), vec4(direction, 0.0), vec4(1.0, 1.0, 1.0, 0.0), vec4(0.0));
}
