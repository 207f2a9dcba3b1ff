// The ground, an infinite plane, and the lights that fall on it. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kMostGroundLights = 64; // that stand somewhere
const int kMostCorners = 5;       // of a rectangle that the plane cuts

const int kPointLight = 0, kConeLight = 1, kSphereLight = 2, kPolygonLight = 3;

// A light that stands somewhere.
struct GroundLight {
    ivec4 kind;  // x: one of the above; y: corners
    vec4 place;  // xyz: its middle [voxel]; w: sphere: radius, polygon: area [voxel²]
    vec4 rgb;    // radiant intensity [W/sr voxel²/m²], or radiance; w: polygon: how far off it counts as a point [voxel]
    vec4 axis;   // xyz: cone, polygon: where it shines to
    vec4 cone;   // xy: the angles between which it fades [rad]
    vec4 corners[kMostCorners]; // polygon [voxel]
};

struct GroundParams {
    ivec4 numbers; // x: lights; y: the region that the ground is within the domain, −1 if none
    vec4 plane;    // xyz: its normal, upward, of length 1; w: what makes the height [voxel] of a place's product
    vec4 right;    // the same of squares along the world's x [square]
    vec4 front;    // and along its z
    vec4 albedo;   // rgb; w: what every other square has of it
    vec4 constant; // rgb: irradiance that is the same all over [W/m²]
    vec4 low;      // xyz: faces of the box that light was stored in [voxel]
    vec4 high;
    GroundLight lights[kMostGroundLights];
};
