// What methods in image space are told. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

// Camera space: x right, y up, z forward, the eye at the origin [unit].
struct ImageSpaceParams {
    mat4 cameraFromBody;
    mat4 clipFromCamera; // y down; depths from 0, far, to 1, near
    vec4 window;     // xy: half width and height of the view, at depth 1 or parallel [unit]; z: 1 perspective,
                     // 0 parallel
    ivec4 picture;   // width, rows; z: rays of a pixel before this one
    vec4 pattern;    // xy: where in its pixel a ray goes; z: a ray's share of its pixel
    vec4 optics;     // x: index of the body; y: share below which a reflection is not followed
    ivec4 limits;    // x: steps of the search, y: layers, z: interfaces that a ray meets, w: layers of plates
    vec4 absorption; // [1/unit]
    vec4 background; // see camera/environment.glsl
    vec4 mapFromCamera0; // rows of the turn to the environment map's frame
    vec4 mapFromCamera1;
    vec4 mapFromCamera2;
    vec4 depths;           // x, y: of the nearest and the furthest point; z: how far a ray goes at most [unit]
    vec4 worldFromCamera0; // columns
    vec4 worldFromCamera1;
    vec4 worldFromCamera2;
    vec4 irradiance[9]; // on plates, see camera/irradiance.h
};

// One pixel's first ray, beside its colour.
struct SurfacePath {
    vec4 place;     // where it left the last body, or ended on a plate, camera space; w: optical path length [unit]
    vec4 direction; // unit, camera space; w: path length [unit]
    vec4 through;   // transmittance; w: probes of layers
    vec4 outward;   // of the plate that it ended on, camera space; w: 0 it met nothing, 1 it met a body, 2 it ended
                    // on a plate
};
