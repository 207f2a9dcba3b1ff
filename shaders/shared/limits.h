// Numbers that C++ and GLSL must agree on. Read by both.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kMostObjects = 12;          // with sharp boundaries: a voxel's table has 16 bits for them
const float kNearby = 3.5;            // how near a boundary is noted in a voxel's table [voxel]
const float kExactClearance = 4.0;    // beyond, clearances are bounds alone [voxel]
const uint kNearFull = 0xE0000000u; // a fixed-point sum above this may overflow next
