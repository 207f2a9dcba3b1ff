// A picture upright behind the scene, as the view kernel finds it. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

struct PlateParams {
    vec4 middle;  // xyz: of the picture [voxel]; w: 1 if its border goes on without an end
    vec4 forward; // xyz: of length 1, from the eye to it
    vec4 right;   // xyz: what makes −1 to 1 from its left to its right of a place's product [1/voxel]
    vec4 up;      // the same from below
};
