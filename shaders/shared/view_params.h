// What the view kernel is told. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

struct ViewParams {
    ivec4 picture; // width, height, first row of this strip, rows in it
    ivec4 limits;  // x: most steps of a branch, y: most interfaces that it meets, z: rays that go on from
                   // the last launch, 0: all begin, w: which half of the rests they are in
    vec4 eyeHigh;  // the eye in voxel space, in two floats a coordinate, since it may stand
    vec4 eyeLow;   // far off; eyeHigh.w: 1 for a perspective, 0 for parallel rays
    vec4 forward;  // a pixel's ray: forward + sx right + sy up, or the same added to the eye
    vec4 right;    // [voxel], scaled by the half width of the view
    vec4 up;       // scaled by the half height
    vec4 background;    // rgb radiance; w: the map's pixels, 2 by centres, 3 by edges
    vec4 mapFromVoxel0; // rows of the rotation from voxel space to the environment map's frame
    vec4 mapFromVoxel1;
    vec4 mapFromVoxel2;
    vec4 medium;  // x: index outside, y: throughput below which a reflection is not followed,
                  // z: Cauchy's B outside [µm²], w: 1 / x²
    vec4 pattern; // xy: where in its pixel a ray goes; z: 1 for the first of its rays, whose path is
                  // written
    vec4 weight;  // rgb: the ray's share of its pixel's colour; w: of its coverage
    vec4 polarizer;     // xyz: along E that the camera lets through, of length 1; w: 1 if it does so
    vec4 backPolarizer; // the same of what surrounds the scene
    ivec4 ray;    // x: its number among its pixel's, y: how far the band's lines are shifted
};

// One pixel's result, beside its colour.
struct PixelPath {
    vec4 place;     // where the ray left or stopped [voxel]; w: optical path length [voxel]
    vec4 direction; // unit, voxel space; w: path length [voxel]
    vec4 through;   // transmittance; w: steps
    vec4 error;     // x: | |w| − n | at the exit; y: 1 if it ended on an opaque surface, zw: the normal
                    // of that, octahedral, voxel space
};

// Counters are (low, high) words, spread over slots so that pixels do not queue for one.
const uint kSlots = 64u;
const uint kRays = 0u, kSteps = 1u, kTrappedRays = 2u;
const uint kWorstError = 3u;     // adaptive: bits of the largest estimated error [voxel]
const uint kOverTolerance = 4u;  // rays whose estimated error is above the tolerance
const uint kInterfaces = 5u;     // met
const uint kDroppedByDepth = 6u; // shares of rays, in 1/kShareUnit
const uint kDroppedAsDim = 7u;
const uint kCounters = 8u;
const float kShareUnit = 1048576.0;
