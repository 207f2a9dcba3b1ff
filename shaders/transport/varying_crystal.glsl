// Crystals that vary within: look-ups, and what they do to the polarisation of both waves together.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where regions' parameters are declared.

#if CRYSTALS == 2
#include "lib/varying_crystal.glsl"

// Coefficients of cubic B-splines, from two voxels before the box that all such crystals are in.
layout(binding = kCrystalsUnit) uniform sampler3D crystals;           // D_xx, D_yy, D_zz, n_o
layout(binding = kMixedCrystalsUnit) uniform sampler3D mixedCrystals; // D_yz, D_zx, D_xy

bool crystalVaries(int region) {
    return scene.regions[region].albedo.w > 0.0 && isCrystal(region);
}

// Whether its o-rays bend.
bool bendsOrdinary(int region) {
    return scene.regions[region].albedo.w == 2.0 && isCrystal(region);
}

// What is summed up over coefficients.
struct CrystalSums {
    vec4 pure;
    vec3 mixed;
    vec3 slopeO;
    vec3 slopeT;
    vec3 slopeKK;
};

void addTexel(inout CrystalSums sums, ivec3 at, float weight, vec3 slope, vec3 pureK, vec3 mixedK) {
    vec4 p = texelFetch(crystals, at, 0);
    vec3 m = texelFetch(mixedCrystals, at, 0).xyz;
    sums.pure += weight * p;
    sums.mixed += weight * m;
    sums.slopeO += p.w * slope;
    sums.slopeT += (p.x + p.y + p.z) * slope;
    sums.slopeKK += (dot(p.xyz, pureK) + dot(m, mixedK)) * slope;
}

// Written out: software devices count the rounds of all loops together and end them at a number of them.
void addRow(inout CrystalSums sums, ivec3 at, vec4 wx, vec4 sx, vec2 y, vec2 z, vec3 pureK, vec3 mixedK) {
    vec3 slope = vec3(y.x * z.x, y.y * z.x, y.x * z.y);
    addTexel(sums, at, wx.x * slope.x, vec3(sx.x, wx.x, wx.x) * slope, pureK, mixedK);
    addTexel(sums, at + ivec3(1, 0, 0), wx.y * slope.x, vec3(sx.y, wx.y, wx.y) * slope, pureK, mixedK);
    addTexel(sums, at + ivec3(2, 0, 0), wx.z * slope.x, vec3(sx.z, wx.z, wx.z) * slope, pureK, mixedK);
    addTexel(sums, at + ivec3(3, 0, 0), wx.w * slope.x, vec3(sx.w, wx.w, wx.w) * slope, pureK, mixedK);
}

void addSlice(inout CrystalSums sums, ivec3 at, vec4 wx, vec4 sx, vec4 wy, vec4 sy, vec2 z, vec3 pureK, vec3 mixedK) {
    addRow(sums, at, wx, sx, vec2(wy.x, sy.x), z, pureK, mixedK);
    addRow(sums, at + ivec3(0, 1, 0), wx, sx, vec2(wy.y, sy.y), z, pureK, mixedK);
    addRow(sums, at + ivec3(0, 2, 0), wx, sx, vec2(wy.z, sy.z), z, pureK, mixedK);
    addRow(sums, at + ivec3(0, 3, 0), wx, sx, vec2(wy.w, sy.w), z, pureK, mixedK);
}

VaryingCrystal varyingCrystalAt(int region, vec3 x, vec3 k) {
    ivec3 last = textureSize(crystals, 0) - 5;
    vec3 at = clamp(x - scene.crystals.xyz, vec3(-0.999), vec3(last) + 0.999);
    vec3 cell = floor(at);
    vec3 t = at - cell;
    vec4 wx = splineWeights(t.x);
    vec4 wy = splineWeights(t.y);
    vec4 wz = splineWeights(t.z);
    vec4 sx = splineSlopes(t.x);
    vec4 sy = splineSlopes(t.y);
    vec4 sz = splineSlopes(t.z);
    vec3 pureK = k * k;
    vec3 mixedK = 2.0 * k.yzx * k.zxy;
    CrystalSums sums = CrystalSums(vec4(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    ivec3 first = ivec3(cell) + 1;
    addSlice(sums, first, wx, sx, wy, sy, vec2(wz.x, sz.x), pureK, mixedK);
    addSlice(sums, first + ivec3(0, 0, 1), wx, sx, wy, sy, vec2(wz.y, sz.y), pureK, mixedK);
    addSlice(sums, first + ivec3(0, 0, 2), wx, sx, wy, sy, vec2(wz.z, sz.z), pureK, mixedK);
    addSlice(sums, first + ivec3(0, 0, 3), wx, sx, wy, sy, vec2(wz.w, sz.w), pureK, mixedK);
    RegionParams here = scene.regions[region];
    float scale = 1.0; // of D, by the wavelength
    if (kDisperses) {
        float o = dispersed(here.index.x, here.index.w);
        float e = dispersed(here.axis.w, here.extraordinary.w);
        scale = (e - o) * (e + o) / ((here.axis.w - here.index.x) * (here.axis.w + here.index.x));
    }
    return VaryingCrystal(dispersed(sums.pure.w, here.index.w), scale * sums.pure.xyz, scale * sums.mixed,
                          sums.slopeO, scale * sums.slopeT, scale * sums.slopeKK);
}

// What is isotropic there has an axis of 0.
Uniaxial varyingUniaxialAt(int region, vec3 x) {
    VaryingCrystal here = varyingCrystalAt(region, x, vec3(0.0));
    vec3 axis = axisOf(here.pure, here.mixed);
    float more = dot(axis, timesD(here.pure, here.mixed, axis));
    return Uniaxial(here.o, sqrt(here.o * here.o + more), axis);
}

// How the polarisation of both waves together turns on a way that is straight or nearly, from where it is `s` by
// acrossOf(d) and g. `steps` grows by what was looked up.
vec3 polarisedAlong(int region, vec3 s, vec3 x, vec3 along, inout int steps) {
    const float kGauss = 0.28867513459481287; // √3/6
    const float kBent = 0.05;  // what ω's turn on a piece may add to it [rad]
    const float kLeast = 0.1;  // [voxel]
    float extent = length(along);
    vec3 d = along / max(extent, 1.0e-20);
    vec3 f = acrossOf(d);
    vec3 g = cross(f, d);
    float wave = transport.tolerance.z / wavelength();
    float done = 0.0;
    float next = 1.0;
    while (done < extent) {
        float piece = min(next, extent - done);
        vec3 middle = x + (done + 0.5 * piece) * d;
        vec3 off = (kGauss * piece) * d;
        vec3 before = vec3(0.0);
        vec3 behind = vec3(0.0);
        for (int i = 0; i < 2; ++i) { // in a loop, since each look-up is long
            before = behind;
            vec3 at = middle + float(2 * i - 1) * off;
            behind = wave * retardance(varyingCrystalAt(region, at, vec3(0.0)), f, g);
        }
        ++steps;
        // Where ω keeps its direction a piece of any length is exact.
        float bent = piece * piece * length(cross(behind, before)) * max(piece * length(before + behind), 1.0);
        if (bent < kBent || piece < kLeast) {
            s = polarisedOn(s, before, behind, piece);
            done = piece < next ? extent : done + piece;
            next = min(2.0 * next, 1.0);
        } else {
            next = 0.5 * piece;
        }
    }
    return s;
}
#endif
