// How the index field is laid out for rays to sample. Read by C++ and GLSL; vec4-sized members
// only. SPDX-License-Identifier: GPL-3.0-or-later

const float kDispersedTerm = 4.0; // Cauchy's, of 381 nm [1/µm²]

struct FieldParams {
    vec4 scale; // xyz: 1 / texels along each axis; w: the index, where it does not vary
    vec4 high;  // xyz: the last voxel along each axis, size − 1; w: 1 if samples are unbiased
    vec4 cubic; // x: n at potential 0, y: τ²/12 if potentials are corrected for Verlet steps of τ,
                // z: least n² − x²
    vec4 dispersed; // xyz: the same of the index at kDispersedTerm; w: Cauchy's B where it does not vary
};
