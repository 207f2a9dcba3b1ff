// What the kernels of wavefronts are told, and what these read and write. Read by C++ and GLSL;
// vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kScanRun = 64; // counts that one work item of scan.comp.glsl sums up

// A corner of a patch. Its objects and what it met stand in whole words.
struct FrontCorner {
    vec4 place;  // x [voxel]; w: its clock, the optical path length since the front began [voxel]
    vec4 wave;   // w = n dx/ds; w: how steeply it leaves the interface it is on, 0: on none
    vec4 weight; // power per area of the light's map over what it was in the map's middle, rgb or the
                 // first alone
    uvec4 state; // x: its status, yz: the objects that it is in, w: the object whose boundary it is at
};

// A patch, whose corners 00, 10, 01, 11 stand one behind the other.
struct FrontPatch {
    vec4 flux;   // its power, in cells of the map; w: 1 if it is a single ray, that of its first corner
    vec4 back;   // of that what an interface reflects, as the last step left it
    uvec4 state; // x: interfaces met, y: what becomes of it (kFrontEnds and its like), zw: the objects that
                 // the reflected patch is in
};

// What a medium did to a corner in a step.
struct FrontDepth {
    vec4 absorbed;  // optical depth by absorption; w: length of the way [voxel]
    vec4 scattered; // the same by scattering
};

// What a corner meets in a step or soon after it.
struct FrontHit {
    FrontCorner end; // its status is kMeets or kStopped, or else it meets nothing
    FrontDepth depth;
    vec4 onward;        // w behind the interface; w: how steeply it leaves
    vec4 back;          // the same of what is reflected
    vec4 mirrored;      // x: share that is reflected, 1: all; yzw: the mirror's tint
    uvec4 after;        // xy: the objects behind the interface, z: 0 if light goes on as if there were none
};

// A corner of the reflected part of a patch that goes on both ways from an interface.
struct FrontBack {
    vec4 wave;   // as FrontCorner::wave
    vec4 weight; // as FrontCorner::weight
};

struct FrontParams {
    ivec4 size;   // as PhotonParams::size
    ivec4 first;  // as PhotonParams::first
    ivec4 bricks; // as PhotonParams::bricks
    uvec4 list;   // x: patches at hand, y: the first of them, z: most interfaces met, w: patches in
                  // all, behind which new ones stand; 0 if there may be no more
    vec4 limits;  // x: a kind of path is not followed below this share, y: a patch dimmer than this is
                  // dropped, z: fixed-point unit of one voxel's length at weight 1, w: the same of
                  // the flux that is left
    vec4 faint;   // x: flux of a patch below which it does not split for its size, y: that a ray has
                  // at least, z: how far ahead its edges are looked at [voxel],
                  // w: below which a patch does not part at an interface but goes the stronger way
    vec4 colour;  // as PhotonParams::colour
    vec4 time;    // x: the front's clock after this step, y: how far ahead corners look for boundaries
                  // [voxel of optical path], z: 1 if the light is in the domain
    vec4 detail;  // x: rays along an edge of a patch of one voxel, y: edge above which it splits, z:
                  // and below which it is a single ray where its corners disagree [voxel]
};

// What becomes of a patch. The first part of it stays in its place.
const uint kFrontEnds = 0u;
const uint kFrontGoes = 1u;
const uint kFrontSplitsU = 2u; // into two, along its first edge
const uint kFrontSplitsV = 3u;
const uint kFrontSplits = 4u;  // into four
const uint kFrontParts = 5u;   // into what goes on and what is reflected
const uint kFrontBack = 6u;    // what is reflected goes on alone
const uint kFrontQuarters = 7u; // into four as it was before the step
const uint kFrontThins = 8u;   // to a single ray, the middle of what was before the step

// Counters of a step.
const int kFrontNearFull = 0; // not 0 if a sum came near its end
const int kFrontFlux = 1;     // that is left, fixed point
const int kFrontEnded = 2;    // patches
const int kFrontChanged = 3;  // not 0 if some patch became others
const int kFrontCounts = 4;

// What became of the flux of a slot of patches.
struct FrontEnergy {
    vec4 absorbed; // flux, in cells; w: steps of patches
    vec4 scattered; // w: deposits
    vec4 escaped;
    vec4 deep;     // flux lost: by what met too many interfaces
    vec4 dim;      // and by what had become dim
};
