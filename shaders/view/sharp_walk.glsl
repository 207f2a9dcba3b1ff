// How a viewing ray gets from boundary to boundary, and how it parts there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/face.glsl"

const bool kGathers = kDims || kShines || kEmission;

// A step of τ from a ray whose field, for adaptive steps, is `first`.
Advance advanceBy(Ray ray, vec4 first, float tau) {
    if (kPath == kAdaptive) return embeddedStep(ray, first, tau);
    if (kPath == kRk4) return rk4Step(ray, tau);
    if (kPath == kEuler) {
        vec4 sampled = fieldAt(ray.x);
        Ray next = eulerStep(ray, sampled, tau * sampled.w);
        return Advance(next, Ray(next.x - ray.x, next.w - ray.w), tau * sampled.w * sampled.w, sampled,
                       0.0, 0.0);
    }
    return sharmaStep(ray, tau);
}

// The medium along a step made.
void gatherStep(inout Seen seen, inout Branch branch, int region, Ray end, float tau, float ds) {
    int pieces = max(int(ceil(ds / 0.75)), 1);
    Ray start = branch.ray;
    for (int i = 0; i < pieces; ++i) {
        Ray at = between(start, end, tau, (float(i) + 0.5) / float(pieces));
        float n = length(at.w);
        gatherPiece(seen, branch, region, at.x, at.w / n, n, ds / float(pieces));
    }
}

// Verlet steps as long as no boundary and no face is near, from and to the ray's own coordinates.
void runClear(inout Seen seen, inout Branch branch, int region, int rounds, vec3 centre,
              vec3 halfSize) {
    float tau = params.march.x;
    Bend bend = bendAt(branch.ray.x, branch.ray.w);
    seen.opticalLength += verletOpticalEnd(branch.ray.w, bend.force, tau);
    branch.ray = toVerlet(branch.ray, bend.force, bend.change, tau);
    bool inside = !isOutside(branch.ray.x + tau * branch.ray.w, centre, halfSize);
    for (int i = 0; i < rounds && inside; ++i) {
        Ray start = branch.ray;
        vec4 sampled = fieldAt(verletMiddle(start, tau));
        Ray end = verletStep(start, sampled, tau);
        float optical = verletOptical(start.w, end.w, tau);
        float ds = sqrt(optical * tau);
        if (kGathers)
            gatherPiece(seen, branch, region, verletMiddle(start, tau), start.w / sampled.w,
                        sampled.w, ds);
        seen.opticalLength += optical;
        seen.pathLength += ds;
        branch.ray = end;
        ++seen.steps;
        inside = !isOutside(end.x + tau * end.w, centre, halfSize);
    }
    bend = bendAt(branch.ray.x, branch.ray.w);
    branch.ray = fromVerlet(branch.ray, bend.force, bend.change, tau);
    seen.opticalLength -= verletOpticalEnd(branch.ray.w, bend.force, tau);
}

// Through a varying index to the next boundary or face. A step that ends beyond either is made again,
// as long as its interpolant stays before it.
Meeting walkBent(inout Seen seen, inout Branch branch, int region, vec3 centre, vec3 halfSize) {
    const int kOn = 0, kLands = 1, kMeets = 2;
    Meeting met = Meeting(0.0, -1, vec3(0.0), 0);
    float next = params.march.w;
    float tau = next;
    int ending = kOn;
    vec4 first = kPath == kAdaptive ? fieldAt(branch.ray.x) : vec4(0.0);
    bool walking = true;
    while (walking) {
        float free = leapBy(abs(clearanceAt(branch.ray.x)));
        if (kPath == kVerlet && ending == kOn) {
            int rounds = int(free / params.sharp.z);
            if (rounds > 1) runClear(seen, branch, region, rounds, centre, halfSize);
            free = leapBy(abs(clearanceAt(branch.ray.x)));
        }
        Advance step = advanceBy(branch.ray, first, tau);
        ++seen.steps;
        bool good = true;
        float off = 0.0;
        if (kPath == kAdaptive) {
            float reach = params.tracing.y;
            off = step.offX + step.offW * reach / step.last.w;
            float allowed = max(params.tracing.x * tau * step.last.w / reach, kRounding * reach);
            good = ending != kOn || off <= allowed || tau <= params.march.z;
            float change = 0.9 * sqrt(sqrt(allowed / max(off, 1.0e-30)));
            if (ending == kOn)
                next = clamp(tau * clamp(change, 0.2, 4.0), params.march.z, params.march.x);
        }
        if (good && ending == kOn) {
            Way way = curvedWay(branch.ray, step.ray, tau);
            float share = 1.0;
            if (isOutside(step.ray.x, centre, halfSize)) {
                share = shareInside(branch.ray, step.ray, tau, centre, halfSize);
                ending = kLands;
            }
            if (free < way.extent) {
                met = meet(way, branch.inside, branch.departs);
                seen.steps += met.looks;
                if (met.solid >= 0 && met.s <= share * way.extent) {
                    share = met.s / way.extent;
                    ending = kMeets;
                }
            }
            good = ending == kOn;
            if (!good) next = tau * share;
        }
        if (good) {
            float ds = sqrt(abs(step.optical * tau));
            if (kGathers) gatherStep(seen, branch, region, step.ray, tau, ds);
            seen.pathLength += ds;
            seen.opticalLength += step.optical;
            seen.error += off;
            branch.ray = step.ray;
            branch.departs = 0.0;
            first = step.last;
            walking = ending == kOn;
        }
        tau = next;
        if (walking && seen.steps - seen.begun >= params.size.w) {
            seen.fate = kTrapped;
            walking = false;
        }
    }
    if (ending == kLands) {
        branch.ray.x = ontoFace(branch.ray.x, branch.ray.w, centre, halfSize);
        seen.fate = kLeft;
    } else if (ending == kMeets) {
        vec4 found = distanceAt(met.solid, branch.ray.x);
        float slope = dot(found.xyz, normalize(branch.ray.w));
        if (abs(found.w) < 0.1 * abs(slope))
            branch.ray.x -= (found.w / slope) * normalize(branch.ray.w);
        met.gradient = found.xyz;
    }
    return met;
}

// To the next boundary, or out of the domain.
Meeting walkOn(inout Seen seen, inout Branch branch) {
    int region = regionOf(branch.inside);
    vec3 centre = 0.5 * vec3(params.size.xyz) - 0.5;
    vec3 halfSize = 0.5 * vec3(params.size.xyz);
    if (kField > 0 && surfaces.regions[region].index.y == 1.0)
        return walkBent(seen, branch, region, centre, halfSize);
    float n = surfaces.regions[region].index.x;
    vec3 d = normalize(branch.ray.w);
    float reach = timeToLeave(branch.ray.x, d, centre - halfSize, centre + halfSize);
    Meeting met = meetStraight(branch.ray.x, d, reach, branch.inside, branch.departs);
    if (kGathers) gatherStraight(seen, branch, region, d, n, met.s);
    seen.steps += met.looks;
    seen.pathLength += met.s;
    seen.opticalLength += n * met.s;
    branch.ray.x = clamp(branch.ray.x + met.s * d, centre - halfSize, centre + halfSize);
    if (met.solid < 0) seen.fate = kLeft;
    else if (seen.steps - seen.begun >= params.size.w) seen.fate = kTrapped;
    return met;
}

float brightest(vec3 share) {
    return max(share.x, max(share.y, share.z));
}

float meanOf(vec3 share) {
    return (share.x + share.y + share.z) / 3.0;
}

// What a boundary makes of a branch: the one that goes on, and maybe one that waits.
struct Parted {
    Branch on;
    Branch other;
    bool waits;
};

Parted part(inout Seen seen, Branch branch, Meeting met) {
    Parted parted = Parted(branch, branch, false);
    vec3 normal = met.gradient / max(length(met.gradient), 1.0e-20);
    vec3 forward = dot(branch.ray.w, normal) < 0.0 ? -normal : normal;
    uint after = insideBeyond(branch.inside, met.solid, branch.ray.x, branch.ray.w, forward);
    int here = regionOf(branch.inside);
    int there = regionOf(after);
    if (kOpaque && here != there && surfaces.regions[there].index.z == 1.0) {
        float n2 = dot(branch.ray.w, branch.ray.w);
        seen.light += branch.through * surfaceLight(there, branch.ray.x, -forward) / n2;
        seen.fate = kStopped;
        ++seen.meetings;
        return parted;
    }
    float n = indexOf(here, branch.ray.x);
    float beyond = indexOf(there, branch.ray.x);
    if (here == there || n == beyond) { // nothing parts at it
        parted.on.inside = after;
        parted.on.departs = 0.0;
        return parted;
    }
    ++seen.meetings;
    float least = params.sharp.y;
    if (branch.depth >= int(params.sharp.x)) {
        seen.deep += meanOf(branch.through);
        seen.fate = kDropped;
        return parted;
    }
    vec3 w = branch.ray.w * (n / length(branch.ray.w));
    Parting parting = partAt(w, normal, n, beyond);
    vec3 passed = branch.through * (1.0 - parting.reflectance);
    vec3 mirrored = branch.through * parting.reflectance *
                    surfaces.regions[met.solid].reflectance.xyz;
    Branch mirror = Branch(Ray(branch.ray.x, parting.reflected), mirrored, branch.inside,
                           branch.depth + 1, abs(dot(normal, parting.reflected)) / n);
    bool mirrors = brightest(mirrored) >= least;
    if (!mirrors) seen.dim += meanOf(mirrored);
    if (parting.reflectance == 1.0) { // total: the one way on
        parted.on = mirror;
        if (!mirrors) seen.fate = kDropped;
        return parted;
    }
    parted.other = mirror;
    parted.waits = mirrors;
    parted.on = Branch(Ray(branch.ray.x, parting.refracted), passed, after, branch.depth + 1,
                       abs(dot(normal, parting.refracted)) / beyond);
    if (brightest(passed) < least) {
        seen.dim += meanOf(passed);
        seen.fate = kDropped;
    }
    return parted;
}
