// Numbers that C++ and GLSL must agree on. Read by both.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kMostObjects = 64;          // with sharp boundaries
const int kFewObjects = 4;            // cubes have bits of up to so many each; of more the place of a set in a list
const int kRowBits = 10;              // lists lie in textures by rows and layers of 1024²
const float kNearby = 3.5;            // how near a boundary is noted in the tables [voxel]
const float kExactClearance = 4.0;    // beyond, clearances are bounds alone [voxel]
const uint kNearFull = 0xE0000000u; // a fixed-point sum above this may overflow next

const uint kStepBits = 0xFFFFFFu; // of a photon's count of steps; above them are its bounces
const int kBounceShift = 24;

// The table of surface voxels has it where an entry is free.
const uint kNoVoxel = 0xFFFFFFFFu;

// Voxels receive light by bricks of 8³. The table of bricks has x + (y << 10) + (z << 20) by a brick's place
// in the atlas of sums, or kNoBrick.
const int kBrickBits = 3;
const int kBrickEdge = 1 << kBrickBits;
const uint kNoBrick = 0xFFFFFFFFu;

// Large textures of voxels are cut into blocks of 8³ cells with the 9³ samples at their corners. Their table
// has x + (y << 10) + (z << 20) by a block's place in the atlas.
const int kVoxelBlockBits = 3;
const int kVoxelCells = 1 << kVoxelBlockBits;
const int kVoxelSamples = kVoxelCells + 1;

// A block of cells has 8³ of them: 8 texels along x, or 3 that are packed, and 11 along y and z of the atlas
// of distances. The table of blocks has x + (y << 10) + (z << 20) by a block's place in the atlas, or
// kFarBlock where no boundary is near, or one more inside the object.
const int kBlockBits = 3;
const int kBlockCells = 1 << kBlockBits;
const int kPackedTexels = 3;
const int kBlockRows = 11;
const uint kFarBlock = 0x40000000u;
