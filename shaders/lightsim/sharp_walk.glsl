// How a photon gets from boundary to boundary, and which way it goes there.
// SPDX-License-Identifier: GPL-3.0-or-later

// Below this share of its digits a photon's number is renewed: 13 of 23 bits are left to decide by.
const float kLeastWorth = 1.0 / 1024.0;

struct Flight {
    Ray ray;
    Passage passage;
    uint fate;
    uint steps;  // pieces walked, and looks for boundaries
    float error; // adaptive: the steps' own estimates, added up [voxel]
};

bool isOpaque(int region) {
    return surfaces.regions[region].index.z == 1.0;
}

bool bendsIn(int region) {
    return kPath > kStraight && surfaces.regions[region].index.y == 1.0;
}

// Whether a photon goes on.
uint fateOf(Flight flight, Carried carried) {
    vec3 halfSize = 0.5 * vec3(params.size.xyz);
    vec3 off = flight.ray.x - halfSize + 0.5;
    // On the domain's face, on the way out.
    bool outside = any(greaterThanEqual(off * sign(flight.ray.w), halfSize - 1.0e-4));
    float brightest = kColour ? max(carried.weight.x, max(carried.weight.y, carried.weight.z))
                              : carried.weight.x;
    return outside                              ? kEscaped
           : brightest < params.limits.y        ? kFaded
           : flight.steps >= params.list.z      ? kTrapped
                                                : kAlive;
}

// Leaves a straight piece's light. Where coefficients vary that goes voxel by voxel: over that length
// they are taken as one, as over a leaf elsewhere.
void leave(inout Carried carried, int region, vec3 x, vec3 along) {
    int pieces = kVaries && variesIn(region) ? max(int(ceil(length(along))), 1) : 1;
    vec3 piece = along / float(pieces);
    for (int i = 0; i < pieces; ++i) {
        vec3 start = x + float(i) * piece;
        Coefficients here = Coefficients(vec3(0.0), vec3(0.0), 0.0, vec3(0.0));
        if (kMedium) here = coefficientsAt(region, start + 0.5 * piece);
        deposit(carried, start, piece, here.absorption, here.scattering);
    }
}

// The way of a step: Verlet's and Euler's are straight, that of the others is their own interpolant.
Way wayOf(Ray ray, Step made) {
    if (kPath > kVerlet) return curvedWay(ray, made.leap.step.ray, made.leap.tau);
    vec3 along = made.next - ray.x;
    float length_ = max(length(along), 1.0e-6);
    return straightWay(ray.x, along / length_, length_);
}

// w where a boundary ended a step after a share of it, at x.
vec3 waveWithin(Ray ray, Step made, vec4 before, float share, vec3 x) {
    if (kPath == kEuler) return ray.w + share * (made.ds / before.w) * before.xyz;
    // The way had half the step's kick already.
    if (kPath == kVerlet) return made.middle + ((share - 0.5) * made.tau) * fieldAt(x).xyz;
    return between(ray, made.leap.step.ray, made.leap.tau, share).w;
}

// Steps through a varying index as long as no boundary is within their reach, as march.comp.glsl makes
// them: what is looked up at boundaries is not worth it here.
void walkClear(inout Flight flight, inout Carried carried, uint last) {
    int region = regionOf(flight.passage.inside);
    vec4 sampled = fieldAt(flight.ray.x);
    float longest = 1.0e6; // adaptive: dτ [voxel]
    bool clear = bendsIn(region);
    while (clear) {
        float free = leapBy(abs(clearanceAt(flight.ray.x)));
        Step made = stepFrom(flight.ray.x, flight.ray.w, sampled, longest);
        clear = wayOf(flight.ray, made).extent < free;
        if (clear) {
            if (kPath > kVerlet) {
                longest = made.leap.longest;
                flight.error += made.leap.off;
            }
            leave(carried, region, flight.ray.x, made.next - flight.ray.x);
            vec4 behind = fieldBehind(made, made.next, sampled);
            flight.ray = Ray(made.next, waveBehind(made, flight.ray.w, sampled, behind));
            flight.passage.departs = 0.0;
            sampled = behind;
            ++flight.steps;
            flight.fate = fateOf(flight, carried);
            clear = flight.fate == kAlive && flight.steps < last;
        }
    }
}

// To the next boundary or out of the domain; through a varying index a step that way at most.
Meeting walkOn(inout Flight flight, inout Carried carried) {
    int region = regionOf(flight.passage.inside);
    vec3 halfSize = 0.5 * vec3(params.size.xyz);
    vec3 centre = halfSize - 0.5;
    bool bends = bendsIn(region);
    Ray ray = flight.ray;
    vec3 direction = normalize(ray.w);
    float toFace = timeToLeave(ray.x, direction, centre - halfSize, centre + halfSize);
    Way way = straightWay(ray.x, direction, max(toFace, 1.0e-6));
    Meeting met;
    Step made;
    vec4 sampled = vec4(0.0);
    if (kPath > kStraight && bends) {
        sampled = fieldAt(ray.x);
        made = stepFrom(ray.x, ray.w, sampled, 1.0e6);
        way = wayOf(ray, made);
        if (kPath > kVerlet) flight.error += made.leap.off;
        met = meet(way, flight.passage.inside, flight.passage.departs);
    } else {
        met = meetStraight(ray.x, direction, way.extent, flight.passage.inside, flight.passage.departs);
    }
    vec3 next = clamp(placeOn(way, met.s), centre - halfSize, centre + halfSize);
    leave(carried, region, ray.x, next - ray.x);
    flight.steps += 1u + uint(met.looks);
    flight.passage.departs = 0.0;
    flight.ray.x = next;
    if (kPath > kStraight && bends) {
        vec4 behind = fieldBehind(made, next, sampled);
        flight.ray.w = met.solid >= 0 ? waveWithin(ray, made, sampled, met.s / way.extent, next)
                                      : waveBehind(made, ray.w, sampled, behind);
    }
    return met;
}

// Whether a photon is of the share R that is reflected. Its number is used again: where in its part of
// (0, 1) it lies is again a number in (0, 1), and neighbours' again lie evenly. With few digits left it
// gets a new one.
bool isReflected(inout Passage passage, float R, uint id) {
    bool reflected = passage.chance < R;
    float share = reflected ? R : 1.0 - R;
    if (R > 0.0 && R < 1.0) {
        passage.chance = (reflected ? passage.chance : passage.chance - R) / share;
        passage.worth *= share;
        if (passage.worth < kLeastWorth) {
            passage.chance = chanceOf(pcgHash(id ^ pcgHash(params.sharp.y + passage.met)));
            passage.worth = 1.0;
        }
    }
    return reflected;
}

// At a boundary: on, back, or into what absorbs it.
void pass(inout Flight flight, inout Carried carried, Meeting met, uint id) {
    vec3 x = flight.ray.x;
    vec3 normal = met.gradient / max(length(met.gradient), 1.0e-20);
    vec3 forward = dot(flight.ray.w, normal) < 0.0 ? -normal : normal;
    uint after = insideBeyond(flight.passage.inside, met.solid, x, flight.ray.w, forward);
    int here = regionOf(flight.passage.inside);
    int there = regionOf(after);
    float n = indexOf(here, x);
    float beyond = indexOf(there, x);
    if (kOpaqueSolids && here != there && isOpaque(there)) {
        flight.fate = kStopped;
    } else if (here == there || n == beyond) { // nothing parts at it
        flight.passage.inside = after;
    } else if (flight.passage.met >= params.sharp.x) {
        flight.fate = kDeep;
    } else {
        ++flight.passage.met;
        vec3 w = flight.ray.w * (n / length(flight.ray.w));
        Parting parting = partAt(w, normal, n, beyond);
        bool reflected = isReflected(flight.passage, parting.reflectance, id);
        flight.ray.w = reflected ? parting.reflected : parting.refracted;
        flight.passage.inside = reflected ? flight.passage.inside : after;
        flight.passage.departs = abs(dot(normal, flight.ray.w)) / length(flight.ray.w);
        // A mirror's tint: what it does not send back it has absorbed.
        vec3 sent = reflected ? carried.weight * surfaces.regions[met.solid].reflectance.xyz
                              : carried.weight;
        carried.absorbed += carried.weight - sent;
        carried.weight = sent;
    }
}
