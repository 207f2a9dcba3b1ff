// What boundaries do to light in scenes with crystals: polarised light, two waves on each side.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the structs of transport/interface.glsl are declared. A path in a crystal is one of its waves; how
// the phases of two that come of one go together is not kept, but where a crystal is weak and lengths are known:
// there both are one path. In an isotropic medium it has what linear polarisation
// it was given; what is circular counts as unpolarised. Scenes with crystals have no metals and no rough boundaries.

#if CRYSTALS > 0
// Across k, in the plane of incidence: E of the wave that lib/crystal.glsl calls "o" in an isotropic medium.
vec3 inPlane(float q, float kz, float n) {
    return vec3(-kz, 0.0, q) / n;
}

Uniaxial uniaxialIn(mat3 frame, int region, Uniaxial crystal, float n) {
    if (!isCrystal(region) || crystal.axis == vec3(0.0)) return Uniaxial(n, n, vec3(0.0, 1.0, 0.0));
    return Uniaxial(crystal.o, crystal.e, crystal.axis * frame);
}

// Those of both sides, by one look-up, as no two that vary meet.
void crystalsAt(Interface at, out Uniaxial near, out Uniaxial beyond) {
    near = evenUniaxialOf(at.here);
    beyond = evenUniaxialOf(at.there);
#if CRYSTALS == 2
    int turning = crystalVaries(at.there) ? at.there : at.here;
    if (crystalVaries(turning)) {
        Uniaxial found = varyingUniaxialAt(turning, at.x);
        if (turning == at.here) near = found;
        if (turning == at.there) beyond = found;
    }
#endif
}

#if CRYSTALS == 2
// E of the o-wave of wave vector k, as lib/crystal.glsl takes it, of length 1.
vec3 ordinaryField(Uniaxial medium, vec3 k) {
    vec3 field = cross(k, medium.axis);
    if (length(field) < 3.0e-7 * medium.o) field = vec3(-k.z, 0.0, k.x);
    return normalize(field);
}
#endif

// Stokes' numbers of both waves together by the o-wave's E, of those that a path has, and back: where a crystal varies
// those are by acrossOf() the way.
vec3 stokesOfWaves(Uniaxial medium, int region, mat3 frame, vec3 k, vec3 stokes) {
#if CRYSTALS == 2
    if (crystalVaries(region)) {
        vec3 d = normalize(k);
        vec3 f = acrossOf(frame * d) * frame;
        return polarisedBy(stokes, f, cross(f, d), ordinaryField(medium, k));
    }
#endif
    return stokes;
}

vec3 stokesOfPath(Uniaxial medium, int region, mat3 frame, vec3 k, vec3 stokes) {
#if CRYSTALS == 2
    if (crystalVaries(region)) {
        vec3 d = normalize(k);
        vec3 field = ordinaryField(medium, k);
        return polarisedBy(stokes, field, cross(field, d), acrossOf(frame * d) * frame);
    }
#endif
    return stokes;
}

// The waves of one side, `state` their shares, as rays. Returns how many are there then.
int addRays(Interface at, mat3 frame, Uniaxial medium, int region, float n, float q, vec2 k, vec4 state, vec3 tint,
            ObjectSet objects, int count, inout Outgoing outgoing[kMostOutgoing]) {
    const float kNone = 1.0e-7; // a rounding
    float whole = state.x + state.y;
    if (isCrystal(region) && goesTogether(region)) {
        vec3 stokes = vec3(state.x - state.y, 2.0 * state.z, 2.0 * state.w) / max(whole, kNone);
        float kz = state.x > kNone ? k.x : k.y;
        stokes = stokesOfPath(medium, region, frame, vec3(q, 0.0, kz), stokes);
        if (whole > kNone)
            outgoing[count++] = Outgoing(frame * vec3(q, 0.0, kz), whole, tint, objects, abs(kz) / n, kTogether,
                                         stokes);
    } else if (isCrystal(region)) {
        vec3 o = vec3(q, 0.0, k.x);
        vec3 e = vec3(q, 0.0, k.y);
        bool swap = state.y > 2.0 * state.x; // the brighter first; of like ones the o-wave
        for (int i = 0; i < 2; ++i) {
            bool ordinary = (i == 0) != swap;
            float share = ordinary ? state.x : state.y;
            int mode = ordinary ? kOrdinary : kExtraordinary;
            vec3 w = ordinary ? o : e;
            if (share > kNone)
                outgoing[count++] = Outgoing(frame * w, share, tint, objects,
                                             abs(rayDirection(medium, mode, w).z), mode, vec3(0.0));
        }
    } else if (whole > kNone) {
        vec2 p = polarisationOf(state.xyz);
        vec3 polarisation = frame * (p.x * inPlane(q, k.x, n) + vec3(0.0, p.y, 0.0));
        outgoing[count++] = Outgoing(frame * vec3(q, 0.0, k.x), whole, tint, objects, abs(k.x) / n,
                                     kUnsplit, polarisation);
    }
    return count;
}

// All rays of what arrives: those beyond first.
int scatterPolarised(Interface at, vec3 w, ObjectSet objects, out Outgoing outgoing[kMostOutgoing]) {
    bool fromCrystal = isCrystal(at.here);
    if (!fromCrystal) w *= at.n / length(w);
    vec3 arrived = w;
    Uniaxial near;
    Uniaxial beyond;
    crystalsAt(at, near, beyond);
    // Both waves together have the o-wave's way.
    if (at.mode == kTogether) w *= near.o / length(w);
    vec3 along = w - dot(w, at.normal) * at.normal;
    float q = length(along);
    vec3 x = along / max(q, 1.0e-20);
    if (q < 1.0e-6) {
        vec3 helper = abs(at.normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        x = normalize(cross(helper, at.normal));
    }
    mat3 frame = mat3(x, cross(at.normal, x), at.normal);
    near = uniaxialIn(frame, at.here, near, at.n);
    beyond = uniaxialIn(frame, at.there, beyond, at.beyond);
    Crossing made = crossingOf(near, beyond, q);
    Parts fromO = closed(made.fromO);
    Parts fromE = closed(made.fromE);
    vec4 state = vec4(at.mode == kOrdinary ? 1.0 : 0.0, at.mode == kExtraordinary ? 1.0 : 0.0, 0.0, 0.0);
    if (at.mode == kTogether) {
        vec3 stokes = stokesOfWaves(near, at.here, frame, w * frame, at.polarisation);
        state = 0.5 * vec4(1.0 + stokes.x, 1.0 - stokes.x, stokes.yz);
    } else if (!fromCrystal) {
        vec3 local = at.polarisation * frame;
        float kz = sqrt(max((at.n - q) * (at.n + q), 0.0));
        state = vec4(stateOf(vec2(dot(local, inPlane(q, kz, at.n)), local.y)), 0.0);
    }
    vec3 mirrors = scene.regions[at.object].reflectance.xyz;
    int count = addRays(at, frame, beyond, at.there, at.beyond, q, made.k.xy, sentOn(state, fromO.on, fromE.on), vec3(1.0),
                        at.objects, 0, outgoing);
    count = addRays(at, frame, near, at.here, at.n, q, made.k.zw, sentOn(state, fromO.back, fromE.back), mirrors, objects,
                    count, outgoing);
    if (count == 0) { // it grazes so much that by a rounding no such wave arrives
        vec3 back = arrived - 2.0 * dot(arrived, at.normal) * at.normal;
        outgoing[count++] = Outgoing(back, 1.0, mirrors, objects, abs(dot(normalize(back), at.normal)), at.mode,
                                     at.polarisation);
    }
    return count;
}

// What both waves of a crystal, together, do to each other on a straight way that ends where the path is.
void turnTogether(inout Path path, int region, vec3 start, vec3 direction) {
#if CRYSTALS == 2
    if (crystalVaries(region)) {
        path.polarisation = polarisedAlong(region, path.polarisation, start, path.ray.x - start, path.steps);
        return;
    }
#endif
    float phase = phaseAlong(region, direction, length(path.ray.x - start));
    path.polarisation.yz = complexProduct(path.polarisation.yz, vec2(cos(phase), sin(phase)));
}
#endif
