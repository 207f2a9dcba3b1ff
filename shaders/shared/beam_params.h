// What the kernels of beams and of surfaces that receive light are told, and what these read and write.
// Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kMostAims = 4;
const int kAimedLevels = 2; // a starting cell is split so often where the light's map is aimed at
const int kMostShifts = 32; // places that a band's light is laid down at for every one where its middle lands

// Of the kernels that lay out surface voxels and make irradiance.
struct LayoutParams {
    ivec4 size;  // voxels of the domain; w: fine voxels along an edge of one
    ivec4 list;  // x: voxels to look at, y: words of a mask, z: surface voxels in all
    vec4 weight; // rgb: power of one unit of fixed point [W]; w: the mean of those, or of the kernel
                 // that makes irradiance the area of a voxel's face [m²]
};

// A point of an opaque surface that is asked for its light.
struct SurfacePoint {
    vec4 place;  // [voxel]
    vec4 normal; // outward, voxel space; 0: no point
};

struct PointLight {
    vec4 irradiance; // rgb [W/m²]
    vec4 flow;       // the same by the direction of travel, voxel space: a vector sum, mean of rgb
};

// Where a light's ray is at an event: on the opaque surface it landed on, at an interface, or gone.
struct BeamPoint {
    vec4 place;  // x [voxel]; w: in scenes with crystals the share that goes on as an e-wave
    vec4 wave;   // w = n dx/ds on arrival; of one that landed the outward normal; w: the share that comes
                 // back as an e-wave
    vec4 weight; // its power over that of its cell of the light's map, rgb or the first alone;
                 // w: the share that an interface reflects, 1: all of it
    uvec4 event; // x: its status, y: what it met on the way, z: the object of the boundary it is at,
                 // w: of few objects those it is in, and from bit 16 on the interfaces it has met
    ivec4 map;   // x: its place on the light's map [finest cell], 16 bits each of x and y, y: the kind of
                 // path that it is of, z: the direction of w, octahedral; w: in scenes with crystals its
                 // mode and polarisation
};

// A cell of the light's map, a beam where its nine points agree: three by three, row by row.
struct BeamNode {
    uvec4 first;  // points 0 to 3
    uvec4 second; // points 4, its middle, to 7
    ivec4 place;  // xy: its low corner, z: its edge [finest cell], w: point 8
    uvec4 state;  // x: 1 if it is too small to be a beam: its middle stands for it;
                  // y: bits of the branches it goes on from the interface it is at; z: its share of the
                  // light's map, if its middle stands for it; w: the kind of path that it is of
};

struct BeamParams {
    ivec4 size;  // voxels along x, y, z; w: fine voxels along an edge of one
    vec4 limits; // x: shortest step [voxel], y: a share below is not followed, z: fixed-point unit
                 // of all power of a cell, w: how far a beam may be off [fine voxel]
    uvec4 list; // x: items, y: the first point, z: points there are, w: most interfaces met
    uvec4 generation; // x: branches taken by every kind of path of it, y: whether points go on from
                      // those of the one before, z: differs by seed
    ivec4 levels; // x: edge of a cell [finest cell], y: starting cells, of kAimedLevels more,
                  // along x, z: along y; w: the longest edge of what one beam covers [fine voxel]
    vec4 aims[kMostAims]; // parts of the map, low and high corners, where none is larger than a cell
                  // to begin with [finest cell]
    vec4 window; // tangents, or offsets [voxel], at the map's low corner, and its extents
    vec4 right;  // voxel space; for a point light right, up, forward span its view; w: a cell of which
                 // so much leads nowhere is not split
    vec4 up;
    vec4 forward; // xyz: directional light's direction of travel, or the view's axis; w: 1 for a
                  // point light
    vec4 origin;  // xyz: the light in voxels; w: 1 if it is in the domain
    vec4 map;     // x: area of a cell, where the domain is [voxel²]; yzw: the
                  // light's RGB over their sum, the weights of its direction
    vec4 batch;   // xy: share of the map at the batch's low corner, zw: and of one finest cell
    vec4 axis;    // axis, cone and polarizer as EmissionParams's
    vec4 cone;
    vec4 polarizer;
    vec4 shifts[2 * kMostShifts / 4]; // wavelengths of a band that have the same light each, in ascending order: how far
                  // each is from its middle, 1: as far as the wavelength of kShiftedBuffer
};

const uint kNewPoints = 16u; // that four cells need in place of one, beside its own

// Counts of a list of nodes sorted.
const int kBeamCount = 0;     // to be laid down
const int kSplitCount = 1;    // to be split
const int kNextCount = 2;     // that go on from an interface
const int kWantedCount = 3;   // points that go on
const int kNearFullCount = 4; // not 0 if a sum came near its end
const int kDepositCount = 5;
const int kMissedCount = 6; // parts that fell beside every surface voxel
const int kBranchCount = 7; // branches that those that go on take, in all
const int kCulledCount = 8; // that lead to no surface that receives
const int kCellCount = 9;       // cells of beams to be laid down
const int kBrokenCellCount = 10; // quarters and points of what is no beam
const int kBeamCounts = 11;

// Books: power by what became of it, in kBookSlots parts of three channels.
const int kBookEntered = 0;
const int kBookLanded = 1;
const int kBookLeft = 2;
const int kBookDeep = 3;
const int kBookTrapped = 4;
const int kBookDim = 5;
const int kBooks = 6;
const int kBookSlots = 256;
const float kBookUnit = 1048576.0; // of all power of a cell
