// Uniaxial crystals: the waves on both sides of a plane boundary, and what of a wave goes on in each.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wave vectors k are in units of ω/c: that of an o-wave has the length n_o, that of an e-wave ends on the surface
// k_∥²/n_o² + k_⊥²/n_e² = 1, ∥ and ⊥ to the axis. An e-wave's light goes along the normal of that surface, not
// along k. (Born and Wolf, Principles of Optics, §15.2, §15.3; Yariv and Yeh, Optical Waves in Crystals, ch. 4.)
//
// In the frame of a boundary z is its normal, to the far side, and k = (q, 0, k_z): q is the same for all waves
// at it. Of an isotropic medium, whose n_o is its n_e, the axis is y there: then "o" is the wave polarised in the
// plane of incidence, "e" the one across it.

struct Uniaxial {
    float o;   // n_o
    float e;   // n_e
    vec3 axis; // of length 1, of either sign
};

const int kUnsplit = 0; // a path's mode, in an isotropic medium
const int kOrdinary = 1;
const int kExtraordinary = 2;
const int kTogether = 3; // both waves along one way, by their phases

// Where light of wave vector k goes, of length 1: ∂H/∂k.
vec3 rayDirection(Uniaxial medium, int mode, vec3 k) {
    vec3 along = k;
    if (mode == kExtraordinary) {
        float g = (medium.e - medium.o) * (medium.e + medium.o) / (medium.o * medium.o);
        along = k + (g * dot(k, medium.axis)) * medium.axis;
    }
    return along / sqrt(dot(along, along));
}

// The wave vector of light that goes along `direction`, of length 1.
vec3 waveVector(Uniaxial medium, int mode, vec3 direction) {
    float c = dot(direction, medium.axis);
    float o2 = medium.o * medium.o;
    float e2 = medium.e * medium.e;
    if (mode != kExtraordinary) return medium.o * direction;
    return (e2 * direction + ((o2 - e2) * c) * medium.axis) / sqrt(o2 * c * c + e2 * (1.0 - c * c));
}

// What an e-wave loses per length along its ray, to first order of both coefficients, which are those of light
// polarised across the axis (σ_o) and along it (σ_e). `c` is the cosine of the ray with the axis.
vec3 extraordinaryLoss(Uniaxial medium, float c, vec3 sigmaO, vec3 sigmaE) {
    float along = c * c;
    float across = 1.0 - along;
    float whole = sqrt(medium.o * medium.o * along + medium.e * medium.e * across);
    return (medium.o * along / whole) * sigmaO + (medium.e * across / whole) * sigmaE;
}

// A plane wave: k_z and the fields along the boundary, (E_x, E_y, H_x, H_y). Complex, re and im, where it is
// evanescent: then it carries nothing, `flux` is 0.
struct PlaneWave {
    vec2 k;
    vec4 re;
    vec4 im;
    float flux; // its pairing with itself, twice what it carries towards z
};

struct WavePair {
    PlaneWave o;
    PlaneWave e;
};

vec2 complexProduct(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

float fluxForm(vec4 a, vec4 b) {
    return a.x * b.w - a.y * b.z + b.x * a.w - b.y * a.z;
}

// z·(E_a × H_b + E_b × H_a). It is 0 for two waves of one medium whose k_z differ, as Lorentz's reciprocity has it,
// without conjugates since media do not absorb at a boundary: so it tells how much of a wave there is in a field.
vec2 pairing(PlaneWave a, PlaneWave b) {
    return vec2(fluxForm(a.re, b.re) - fluxForm(a.im, b.im), fluxForm(a.re, b.im) + fluxForm(a.im, b.re));
}

vec2 complexRoot(float square) {
    float root = sqrt(abs(square));
    return square < 0.0 ? vec2(0.0, root) : vec2(root, 0.0);
}

// The wave of u = k × axis, `re` and `im`: E ∝ u of an o-wave, H ∝ u of an e-wave.
PlaneWave planeWave(Uniaxial medium, bool extraordinary, float q, vec2 k, vec3 re, vec3 im) {
    float size = sqrt(dot(re, re) + dot(im, im));
    bool alongAxis = size < 3.0e-7 * medium.o; // any polarisation will do
    if (alongAxis) {
        re = vec3(-k.x, 0.0, q);
        im = vec3(-k.y, 0.0, 0.0);
        size = sqrt(dot(re, re) + dot(im, im));
    }
    re /= size;
    im /= size;
    // k × u along the boundary
    vec2 acrossRe = vec2(k.y * im.y - k.x * re.y, k.x * re.x - k.y * im.x - q * re.z);
    vec2 acrossIm = vec2(-k.x * im.y - k.y * re.y, k.x * im.x + k.y * re.x - q * im.z);
    float o2 = medium.o * medium.o;
    float e2 = medium.e * medium.e;
    PlaneWave wave = PlaneWave(k, vec4(re.x, re.y, acrossRe.x, acrossRe.y),
                               vec4(im.x, im.y, acrossIm.x, acrossIm.y), 0.0);
    if (extraordinary) { // E = −ε⁻¹ (k × H)
        float axial = alongAxis ? 0.0 : size * (medium.o - medium.e) * (medium.o + medium.e) / e2;
        vec2 square = axial * vec2(dot(re, re) - dot(im, im), 2.0 * dot(re, im));
        vec3 a = medium.axis;
        wave.re = vec4(square.x * a.x - acrossRe.x, square.x * a.y - acrossRe.y, o2 * re.x, o2 * re.y);
        wave.im = vec4(square.y * a.x - acrossIm.x, square.y * a.y - acrossIm.y, o2 * im.x, o2 * im.y);
    }
    return wave;
}

// The two waves that carry light, or fade, to the far side (`side` 1) or the near one (−1): by their flux, which
// k_z's sign does not tell.
WavePair wavesOf(Uniaxial medium, float q, float side) {
    vec3 a = medium.axis;
    float g = (medium.e - medium.o) * (medium.e + medium.o) / (medium.o * medium.o);
    // k_z of the e-wave: A k_z² + 2 B k_z + C = 0.
    float A = 1.0 + g * a.z * a.z;
    float B = g * q * a.x * a.z;
    vec2 ofO = side * complexRoot((medium.o - q) * (medium.o + q));
    // √(B² − A C), by where it is 0: what grazes keeps its digits.
    float bend = 1.0 + g * (1.0 - a.y * a.y);
    float most = medium.e * sqrt(A / bend);
    vec2 root = side * complexRoot(bend * (most - q) * (most + q));
    vec2 ofE = vec2((root.x - B) / A, root.y / A);
    vec3 u = vec3(-ofO.x * a.y, ofO.x * a.x - q * a.z, q * a.y);
    vec3 change = vec3(-a.y, a.x, 0.0); // of u with k_z
    vec2 apart = ofE - ofO;
    float slope = A * ofO.x + B;
    if (ofO.y == 0.0 && root.y == 0.0 && side * slope > 0.0) {
        // Without a difference of what is nearly the same: u loses no digits near the axis.
        apart.x = g * dot(u, u) / (slope + root.x);
        ofE.x = ofO.x + apart.x;
    }
    WavePair pair = WavePair(planeWave(medium, false, q, ofO, u, ofO.y * change),
                             planeWave(medium, true, q, ofE, u + apart.x * change, ofE.y * change));
    // As products, which keep their digits where a wave grazes.
    float ratio = medium.o * medium.o / medium.e;
    pair.o.flux = 2.0 * ofO.x;
    if (root.y == 0.0) pair.e.flux = 2.0 * ratio * ratio * root.x;
    return pair;
}

// What of one wave goes on beyond and back: complex amplitudes of the o-wave (x, y) and the e-wave (z, w), whose
// squares are shares of its power.
struct Parts {
    vec4 on;
    vec4 back;
};

struct Crossing {
    Parts fromO;
    Parts fromE;
    vec4 k; // k_z of o and e beyond, of o and e back
};

// The part of a wave in the field behind a boundary, as an amplitude: `first` and `second` are the pairings of the
// waves there with it.
vec2 partBack(vec2 o, vec2 e, vec2 first, vec2 second, float arrives, float flux) {
    float scale = sqrt(max(arrives, 0.0) / max(-flux, 1.0e-30));
    return flux < 0.0 ? scale * (complexProduct(o, first) + complexProduct(e, second)) : vec2(0.0);
}

// Both boundary conditions at once, E and H along the boundary being continuous: each wave that arrives is what the
// field beyond has of it, which gives two equations for the two waves beyond.
Crossing crossingOf(Uniaxial near, Uniaxial beyond, float q) {
    WavePair arriving = wavesOf(near, q, 1.0);
    WavePair back = wavesOf(near, q, -1.0);
    WavePair on = wavesOf(beyond, q, 1.0);
    vec2 oo = pairing(on.o, arriving.o); // first the wave beyond, then the one that arrives
    vec2 eo = pairing(on.e, arriving.o);
    vec2 oe = pairing(on.o, arriving.e);
    vec2 ee = pairing(on.e, arriving.e);
    vec2 determinant = complexProduct(oo, ee) - complexProduct(eo, oe);
    vec2 inverse = vec2(determinant.x, -determinant.y) / max(dot(determinant, determinant), 1.0e-30);
    vec2 oFromO = complexProduct(ee, inverse);
    vec2 eFromO = -complexProduct(oe, inverse);
    vec2 oFromE = -complexProduct(eo, inverse);
    vec2 eFromE = complexProduct(oo, inverse);
    vec2 oBackO = pairing(on.o, back.o);
    vec2 eBackO = pairing(on.e, back.o);
    vec2 oBackE = pairing(on.o, back.e);
    vec2 eBackE = pairing(on.e, back.e);
    float fromO = max(arriving.o.flux, 0.0);
    float fromE = max(arriving.e.flux, 0.0);
    float toO = max(on.o.flux, 0.0);
    float toE = max(on.e.flux, 0.0);
    vec2 on1 = sqrt(fromO * toO) * oFromO;
    vec2 on2 = sqrt(fromO * toE) * eFromO;
    vec2 on3 = sqrt(fromE * toO) * oFromE;
    vec2 on4 = sqrt(fromE * toE) * eFromE;
    vec2 back1 = partBack(oFromO, eFromO, oBackO, eBackO, fromO, back.o.flux);
    vec2 back2 = partBack(oFromO, eFromO, oBackE, eBackE, fromO, back.e.flux);
    vec2 back3 = partBack(oFromE, eFromE, oBackO, eBackO, fromE, back.o.flux);
    vec2 back4 = partBack(oFromE, eFromE, oBackE, eBackE, fromE, back.e.flux);
    return Crossing(Parts(vec4(on1.x, on1.y, on2.x, on2.y), vec4(back1.x, back1.y, back2.x, back2.y)),
                    Parts(vec4(on3.x, on3.y, on4.x, on4.y), vec4(back3.x, back3.y, back4.x, back4.y)),
                    vec4(on.o.k.x, on.e.k.x, back.o.k.x, back.e.k.x));
}

// Shares that add up to 1. In floats they are off by up to 7e-5, where waves graze, mostly by 1e-6.
Parts closed(Parts parts) {
    float whole = dot(parts.on, parts.on) + dot(parts.back, parts.back);
    float scale = 1.0 / sqrt(max(whole, 1.0e-30));
    return Parts(scale * parts.on, scale * parts.back);
}

// Light of two waves at once: their shares and how they go together, E_o E_e*, as (xx, yy, Re xy, Im xy).

// What becomes of light `state` by the amplitudes from o and e.
vec4 sentOn(vec4 state, vec4 fromO, vec4 fromE) {
    vec2 oo = complexProduct(vec2(fromO.x, fromO.y), vec2(fromO.z, -fromO.w));
    vec2 ee = complexProduct(vec2(fromE.x, fromE.y), vec2(fromE.z, -fromE.w));
    vec2 oe = complexProduct(vec2(fromO.x, fromO.y), vec2(fromE.z, -fromE.w));
    vec2 eo = complexProduct(vec2(fromE.x, fromE.y), vec2(fromO.z, -fromO.w));
    vec2 o = complexProduct(vec2(fromO.x, fromO.y), vec2(fromE.x, -fromE.y));
    vec2 e = complexProduct(vec2(fromO.z, fromO.w), vec2(fromE.z, -fromE.w));
    vec2 with = vec2(state.z, state.w);
    vec2 both = state.x * oo + state.y * ee + complexProduct(with, oe) +
                complexProduct(vec2(with.x, -with.y), eo);
    float x = state.x * (fromO.x * fromO.x + fromO.y * fromO.y) +
              state.y * (fromE.x * fromE.x + fromE.y * fromE.y) + 2.0 * complexProduct(with, o).x;
    float y = state.x * (fromO.z * fromO.z + fromO.w * fromO.w) +
              state.y * (fromE.z * fromE.z + fromE.w * fromE.w) + 2.0 * complexProduct(with, e).x;
    return vec4(x, y, both.x, both.y);
}

// By how much of its length the o-wave's optical path is longer than the e-wave's along one ray, whose cosine with
// the axis is c.
float indexDifference(Uniaxial medium, float c) {
    float across = 1.0 - c * c;
    float e = sqrt(medium.o * medium.o * c * c + medium.e * medium.e * across);
    return across * (medium.o - medium.e) * (medium.o + medium.e) / (medium.o + e);
}

// E of light along a direction behind a polariser that lets what lies in the plane of `along` and the ray through.
vec3 polarisedAcross(vec3 along, vec3 direction) {
    vec3 across = along - dot(along, direction) * direction;
    return across / max(sqrt(dot(across, across)), 1.0e-6);
}

// (xx, yy, Re xy) of light that is partly polarised along a vector, as long as the square root of the degree; 0 is
// unpolarised.
vec3 stateOf(vec2 polarisation) {
    float rest = 0.5 * (1.0 - dot(polarisation, polarisation));
    return vec3(rest + polarisation.x * polarisation.x, rest + polarisation.y * polarisation.y,
                polarisation.x * polarisation.y);
}

// And back. What of the light is polarised circularly counts as unpolarised.
vec2 polarisationOf(vec3 state) {
    float whole = max(state.x + state.y, 1.0e-30);
    float q = (state.x - state.y) / whole;
    float u = 2.0 * state.z / whole;
    float degree = sqrt(q * q + u * u);
    if (degree < 1.0e-6) return vec2(0.0);
    float along = sqrt(max(0.5 * (degree + q), 0.0));
    float across = sqrt(max(0.5 * (degree - q), 0.0));
    return vec2(along, u < 0.0 ? -across : across);
}
