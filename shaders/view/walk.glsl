// How a viewing ray gets through the domain: one run of steps for every integrator.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/face.glsl"

// The ray, gone on by a step's change. What rounding keeps back of one step goes to the next (Kahan
// 1965): kicks of the same small size would be rounded the same way every time, which bends a ray by
// 1e-5 more or less than it should be.
Walk goOn(Walk walk, Ray change) {
    precise vec3 dx = change.x + walk.lost.x;
    precise vec3 dw = change.w + walk.lost.w;
    precise vec3 x = walk.ray.x + dx;
    precise vec3 w = walk.ray.w + dw;
    precise vec3 doneX = x - walk.ray.x;
    precise vec3 doneW = w - walk.ray.w;
    walk.lost = Ray(dx - doneX, dw - doneW);
    walk.ray = Ray(x, w);
    return walk;
}

// One step of τ of the schemes with one look-up, `sampled` at `where`: Euler's at its start, Verlet's in
// its middle.
Walk takeStep(Walk walk, vec4 sampled, vec3 where, float tau) {
    float ds = tau * sampled.w;
    if (kOpaque && opacityAt(where) > 0.5) {
        walk.fate = kStopped;
        walk.met = where;
        return walk;
    }
    walk.clear = where;
    if (kDims || kShines)
        walk = gather(walk, coordinate(where), walk.ray.w / sampled.w, sampled.w, ds);
    Ray next = kPath == kStraight ? Ray(walk.ray.x + tau * walk.ray.w, walk.ray.w)
               : kPath == kEuler  ? eulerStep(walk.ray, sampled, ds)
                                  : verletStep(walk.ray, sampled, tau);
    float optical =
        kPath == kVerlet ? verletOptical(walk.ray.w, next.w, tau) : ds * sampled.w;
    walk.opticalLength += optical;
    walk.pathLength += kPath == kVerlet ? sqrt(optical * tau) : ds;
    if (kPath == kVerlet && kField == 2) { // linear samples are not worth the time
        vec3 kick = tau * sampled.xyz;
        walk = goOn(walk, Ray(tau * (walk.ray.w + 0.5 * kick), kick));
    } else {
        walk.ray = next;
    }
    ++walk.steps;
    return walk;
}

// One step of τ of several look-ups, already made: what it meets on its way, piece by piece.
Walk follow(Walk walk, Advance step, float tau) {
    float ds = sqrt(abs(step.optical * tau));
    Ray start = walk.ray;
    if (kDims || kShines || kOpaque) {
        int pieces = max(int(ceil(ds / 0.75)), 1); // about what steps of one look-up of a voxel do
        for (int i = 0; i < pieces && walk.fate == kWalking; ++i) {
            Ray at = between(start, step.ray, tau, (float(i) + 0.5) / float(pieces));
            float n = length(at.w);
            if (kOpaque && opacityAt(at.x) > 0.5) {
                walk.fate = kStopped;
                walk.met = at.x;
            } else {
                if (kDims || kShines)
                    walk = gather(walk, coordinate(at.x), at.w / n, n, ds / float(pieces));
                walk.ray = at;
                walk.clear = at.x;
            }
        }
        if (kOpaque && walk.fate == kStopped) return walk;
    }
    walk.opticalLength += step.optical;
    walk.pathLength += ds * sign(tau);
    walk.ray = start;
    return goOn(walk, step.change);
}

// A step made, of a ray that may have left by it.
Walk arrive(Walk walk, Advance step, float tau, bool leaves, vec3 centre, vec3 halfSize) {
    walk = follow(walk, step, tau);
    if (leaves && walk.fate == kWalking) {
        walk.ray.x = ontoFace(walk.ray.x, walk.ray.w, centre, halfSize);
        walk.fate = kLeft;
    }
    return walk;
}

// The step after a run of Verlet steps, the next of which would end outside: as long as it stays inside,
// which a look-up tells beforehand, since the field may turn the ray back.
Walk lastStep(Walk walk, vec3 centre, vec3 halfSize) {
    float tau = params.march.x;
    Ray end = verletStep(walk.ray, fieldAt(verletMiddle(walk.ray, tau)), tau);
    bool leaves = isOutside(end.x, centre, halfSize);
    if (leaves) tau *= shareInside(walk.ray, end, tau, centre, halfSize);
    ++walk.steps;
    return arrive(walk, sharmaStep(walk.ray, tau), tau, leaves, centre, halfSize);
}

// Steps of several look-ups, until the ray leaves, stops or has used up its steps. A step that ends
// outside is made again, as long as its interpolant stays in the domain.
Walk walkByStages(Walk walk, vec3 centre, vec3 halfSize) {
    float next = params.march.w;
    float tau = next;
    bool landing = false;
    vec4 first = kPath == kAdaptive ? fieldAt(walk.ray.x) : vec4(0.0);
    while (walk.fate == kWalking) {
        Advance step;
        if (kPath == kAdaptive) step = embeddedStep(walk.ray, first, tau);
        else if (kPath == kRk4) step = rk4Step(walk.ray, tau);
        else step = sharmaStep(walk.ray, tau);
        ++walk.steps;
        bool good = true;
        float off = 0.0;
        if (kPath == kAdaptive) {
            // An error of the direction counts by how far the ray may still go; all errors of a
            // crossing add up to the tolerance. Below one rounding of w no step gets any better.
            float reach = params.tracing.y;
            off = step.offX + step.offW * reach / step.last.w;
            float ds = tau * step.last.w;
            float allowed = max(params.tracing.x * ds / reach, kRounding * reach);
            float least = params.march.z;
            good = landing || off <= allowed || tau <= least;
            float change = 0.9 * sqrt(sqrt(allowed / max(off, 1.0e-30)));
            if (!landing) next = clamp(tau * clamp(change, 0.2, 4.0), least, params.march.x);
        }
        if (good && !landing && isOutside(step.ray.x, centre, halfSize)) {
            next = tau * shareInside(walk.ray, step.ray, tau, centre, halfSize);
            landing = true;
        } else if (good) {
            walk = arrive(walk, step, tau, landing, centre, halfSize);
            walk.error += off;
            first = step.last;
        }
        tau = next;
        if (walk.fate == kWalking && walk.steps >= params.size.w) walk.fate = kTrapped;
    }
    return walk;
}

// Steps of one look-up, as long as the next one stays inside. What is rare stands outside this loop:
// software devices walk every branch of a loop in every round.
Walk walkByLooks(Walk walk, vec3 centre, vec3 halfSize) {
    float tau = params.march.x;
    bool inside = true;
    while (inside && walk.fate == kWalking) {
        vec3 at = walk.ray.x;
        vec4 sampled = vec4(0.0, 0.0, 0.0, 1.0);
        if (kPath == kEuler) {
            sampled = fieldAt(at);
            tau = params.march.x / sampled.w;
        }
        inside = !isOutside(walk.ray.x + tau * walk.ray.w, centre, halfSize) &&
                 walk.steps < params.size.w;
        if (!inside) break;
        if (kPath != kEuler) {
            at = verletMiddle(walk.ray, tau);
            sampled = fieldAt(at);
        }
        walk = takeStep(walk, sampled, at, tau);
    }
    if (walk.fate == kWalking && walk.steps >= params.size.w) walk.fate = kTrapped;
    return walk;
}

// A run of equal Verlet steps, from and to the ray's own coordinates.
Walk walkByVerlet(Walk walk, vec3 centre, vec3 halfSize) {
    float tau = params.march.x;
    Bend bend = bendAt(walk.ray.x, walk.ray.w);
    walk.opticalLength += verletOpticalEnd(walk.ray.w, bend.force, tau);
    walk.ray = toVerlet(walk.ray, bend.force, bend.change, tau);
    walk = walkByLooks(walk, centre, halfSize);
    bend = bendAt(walk.ray.x, walk.ray.w);
    walk.ray = fromVerlet(walk.ray, bend.force, bend.change, tau);
    walk.opticalLength -= verletOpticalEnd(walk.ray.w, bend.force, tau);
    return walk;
}

// The last step of a straight or an Euler ray ends on the face, unless the field turns the ray back.
Walk reachFace(Walk walk, vec3 centre, vec3 halfSize) {
    vec4 sampled = fieldAt(walk.ray.x);
    vec3 low = centre - halfSize;
    vec3 high = centre + halfSize;
    float whole = kPath == kEuler ? params.march.x / sampled.w : params.march.x;
    float tau = min(whole, timeToLeave(walk.ray.x, walk.ray.w, low, high));
    walk = takeStep(walk, sampled,
                    kPath == kEuler ? walk.ray.x : verletMiddle(walk.ray, tau), tau);
    if (walk.fate == kWalking &&
        timeToLeave(walk.ray.x, walk.ray.w, low, high) <= 1.0e-3 * params.march.x)
        walk.fate = kLeft;
    if (!kOpaque || walk.fate != kStopped) walk.ray.x = clamp(walk.ray.x, low, high);
    return walk;
}

// From the entry to where the ray leaves, stops or has used up its steps.
Walk walkThrough(Walk walk, vec3 centre, vec3 halfSize) {
    while (walk.fate == kWalking) {
        if (kPath > kVerlet) {
            walk = walkByStages(walk, centre, halfSize);
        } else if (kPath == kVerlet) {
            walk = walkByVerlet(walk, centre, halfSize);
            if (walk.fate == kWalking) walk = lastStep(walk, centre, halfSize);
        } else {
            walk = walkByLooks(walk, centre, halfSize);
            if (walk.fate == kWalking) walk = reachFace(walk, centre, halfSize);
        }
    }
    if (kOpaque && walk.fate == kStopped) walk = meetSurface(walk);
    return walk;
}
