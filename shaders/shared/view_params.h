// What the view kernel is told. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

struct ViewParams {
    ivec4 size;    // voxels along x, y, z; w: most steps of a ray
    ivec4 picture; // width, height, first row of this band, rows in it
    vec4 eyeHigh;  // the eye in voxel space, in two floats a coordinate, since it may stand
    vec4 eyeLow;   // far off; eyeHigh.w: 1 for a perspective, 0 for parallel rays
    vec4 forward;  // a pixel's ray: forward + sx right + sy up, or the same added to the eye
    vec4 right;    // [voxel], scaled by the half width of the view
    vec4 up;       // scaled by the half height
    vec4 march;   // x: step dτ or ds [voxel], y: index outside, z: adaptive, shortest dτ [voxel],
                  // w: by stages, the first dτ [voxel]
    vec4 tracing; // adaptive, x: tolerance [voxel], y: length of a crossing [voxel]
    vec4 background;    // rgb radiance; w: the map's pixels, 2 by centres, 3 by edges
    vec4 mapFromVoxel0; // rows of the rotation from voxel space to the environment map's frame
    vec4 mapFromVoxel1;
    vec4 mapFromVoxel2;
    vec4 scale;   // xyz: 1 / (size + 2), voxels to coordinates of padded textures
    vec4 light;   // x: 1 if the file has light for opaque surfaces
    vec4 pattern; // xy: where in its pixel a ray goes; z: 1 for the first of its rays; w: its share
    vec4 sharp;   // x: most boundaries a ray meets, y: throughput below which it is dropped
};

// One pixel's result, beside its colour.
struct PixelPath {
    vec4 place;     // where the ray left or stopped [voxel]; w: optical path length [voxel]
    vec4 direction; // unit, voxel space; w: path length [voxel]
    vec4 through;   // transmittance; w: steps
    vec4 error;     // x: | |w| − n | at the exit, y: 1 if it missed the domain
};
