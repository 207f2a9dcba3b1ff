// Several domains in one picture, and rays on their way from one to another. Read by C++ and GLSL;
// vec4-sized members only, but for matrices of doubles.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kMostDomains = 16;

struct DomainParams {
    dmat4 otherFromVoxel[kMostDomains]; // voxel space of each domain from this one's
    vec4 size[kMostDomains];            // of each [voxel]
    ivec4 numbers; // x: this domain's, y: how many there are, z: 1 if the launch takes up rays that arrive,
                   // w: how many departures there is room for
    vec4 scale;    // x: edge of a voxel [unit]
};

// A ray between two domains.
struct Departure {
    vec4 place;      // where it enters [voxel of the one that it goes to]
    vec4 direction;  // of length 1 there; w: the index at the eye, 0 if that is where it enters
    vec4 throughput; // rgb
    vec4 along;      // as Load::along
    vec4 lengths;    // so far, x: optical path length, y: path length [unit], z: steps
    ivec4 kind;      // x: the domain that it goes to, y: interfaces met, z: kFirstBranch, kChanged, w: the
                     // pixel's next departure, −1 if it is the last
};
const int kFirstBranch = 1; // of the pixel
const int kChangedBranch = 2; // it was bent, dimmed or lit before
