// The one loop that carries light: from interface to interface, to the domain's faces or an end before.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The entry file says what it carries beside the path (struct Load), by kSamples and kMeasures what it
// wants of a path, by kEqualSteps how runs are stepped, and answers what is declared below. It includes
// this file behind those.
#include "transport/integrate.glsl"
#include "transport/interface.glsl"
#include "transport/path.glsl"

// The longest step from here on [dτ, voxel], where the index is n.
float stepLimit(Ray ray, float n);
// The longest piece of a straight way for which one look at the medium will do [voxel].
float pieceLimit(int region, vec3 x, vec3 direction, float n);
// A piece of the path. May end it there, at `path.ray`.
void onPiece(inout Path path, inout Load load, Piece piece);
// A boundary with an opaque object behind it: the path has ended.
void onSurface(inout Path path, inout Load load, Interface at);
// A boundary between two media: where the path goes on.
void onInterface(inout Path path, inout Load load, Interface at);
// The path has come to an end, or used up its steps. Returns whether `path` now is another one.
bool onEnd(inout Path path, inout Load load);

// A path's lengths are told from both ends of a way, and by how much the way was longer than straight.
struct Measure {
    Ray start;
    float optical; // what is beyond that of the straight way [voxel]
    float extent;
};

// A step of τ that began along w and went on by `moved`; `excess` as in lib/ray.glsl.
void measureStep(inout Measure measure, vec3 w, vec3 moved, float excess, float tau) {
    vec3 reference = measure.start.w;
    measure.optical += excess + dot(w - reference, moved);
    measure.extent += sqrt(abs((dot(w, moved) + excess) * tau)) -
                      dot(moved, reference) / length(reference);
}

// `n` is the index at the start, of which w has lost a rounding.
void closeMeasure(inout Path path, Measure measure, float n) {
    dvec3 w = dvec3(measure.start.w);
    dvec3 straight = dvec3(path.ray.x) - dvec3(measure.start.x);
    double extent = dot(w, straight) / length(w);
    path.lengths += dvec2(double(n) * extent + double(measure.optical),
                          extent + double(measure.extent));
}

// What lies along a straight way.
void along(inout Path path, inout Load load, int region, vec3 direction, float extent, float n) {
    if (!kSamples) return;
    vec3 start = path.ray.x;
    float s = 0.0;
    while (s < extent) {
        vec3 x = start + s * direction;
        float left = extent - s;
        float limit = pieceLimit(region, x, direction, n);
        float piece = limit < left ? left / ceil(left / limit) : left;
        onPiece(path, load, pieceFrom(x, direction, piece, n, region));
        s = path.status == kAlive && piece < left ? s + piece : extent;
    }
}

// To the next interface or face through an index that does not vary.
Hit propagateStraight(inout Path path, inout Load load, int region) {
    float n = indexOf(region, path.ray.x);
    vec3 direction = directionIn(region, path.mode, path.ray.w, n);
    Hit hit = noHit(timeToFace(path.ray.x, direction));
    if (kObjects > 0)
        hit = intersectStraight(path.ray.x, direction, hit.s, path.objects, path.departs);
    path.steps += hit.looks;
    vec3 start = path.ray.x;
    along(path, load, region, direction, hit.s, n);
    if (path.status == kAlive) {
        path.ray.x = clampToDomain(start + hit.s * direction);
        if (hit.object < 0) path.status = kLeft;
    } else {
        hit.object = -1;
    }
    path.departs = 0.0;
#if CRYSTALS > 0
    if (isCrystal(region) && path.mode == kTogether) turnTogether(path, region, start, direction);
#endif
    if (kMeasures) {
        double extent = length(dvec3(path.ray.x) - dvec3(start));
        double index = double(n);
        if (isCrystal(region)) index = double(dot(path.ray.w, direction));
        path.lengths += dvec2(index * extent, extent);
    }
    return hit;
}

// How far off any interface is at least [voxel].
float freeOf(Path path) {
    return kObjects == 0 ? 1.0e9 : freeBy(abs(clearanceAt(path.ray.x)));
}

// Equal Verlet steps as long as the next one stays inside and before any interface, from and to the
// path's own coordinates. What is rare stands outside this loop: software devices walk every branch of a
// loop in every round.
void runEqual(inout Path path, inout Load load, inout Measure measure, int region) {
    int rounds = path.mostSteps - path.steps;
    if (kObjects > 0) {
        rounds = min(rounds, int(freeOf(path) / transport.steps.w));
        if (rounds <= 1) return;
    }
    float tau = transport.steps.x;
    vec3 reference = measure.start.w;
    Bend bend = bendAt(path.ray.x, path.ray.w);
    measure.optical += verletEnd(path.ray.w, bend.force, tau, reference);
    path.ray = toVerlet(path.ray, bend.force, bend.change, tau);
    bool inside = !isOutside(path.ray.x + tau * path.ray.w);
    while (inside && rounds > 0) {
        Ray start = path.ray;
        vec3 middle = verletMiddle(start, tau);
        vec4 field = fieldAt(middle);
        Ray end = verletStep(start, field, tau);
        if (kSamples) {
            vec3 along = end.x - start.x;
            onPiece(path, load, Piece(start.x, along, middle, start.w / field.w, tau * field.w, field.w,
                                      region));
            if (kOpaqueVoxels && path.status == kStopped) break;
        }
        if (kMeasures) {
            vec3 mean = 0.5 * (start.w + end.w);
            vec3 kick = end.w - start.w;
            measure.optical += verletExcess(start.w, end.w, tau, reference);
            measure.extent += tau * (sqrt(dot(mean, mean) + dot(kick, kick) / 6.0) -
                                     dot(mean, reference) / length(reference));
        }
        if (kField == 2 || kFaint) { // other linear samples are not worth the time
            vec3 kick = tau * field.xyz;
            goOn(path.ray, path.lost, Ray(tau * (start.w + 0.5 * kick), kick));
        } else {
            path.ray = end;
        }
        ++path.steps;
        --rounds;
        inside = !isOutside(path.ray.x + tau * path.ray.w);
    }
    path.departs = 0.0;
    bend = bendAt(path.ray.x, path.ray.w);
    path.ray = fromVerlet(path.ray, bend.force, bend.change, tau);
    measure.optical -= verletEnd(path.ray.w, bend.force, tau, reference);
}

// Steps as long as the entry file lets each be, as long as no interface is within reach. Verlet's are
// kick, drift, kick, so that their way between two kicks is one straight piece, and what is looked up at
// the end of one serves the next. The last one ends on the domain's face.
void runLimited(inout Path path, inout Load load, inout Measure measure, int region) {
    vec4 field = fieldAt(path.ray.x);
    bool going = true;
    while (going) {
        vec3 start = path.ray.x;
        vec3 w = path.ray.w;
        vec3 direction = w / field.w;
        float tau = min(stepLimit(path.ray, field.w), wayToFace(start, direction) / field.w);
        vec3 drift = kIntegrator == kVerlet ? halfKick(w, field, tau) : w;
        vec3 next = clampToDomain(start + tau * drift);
        vec3 along = next - start;
        if (kObjects > 0 && length(along) >= freeOf(path)) break;
        if (kSamples) {
            onPiece(path, load, Piece(start, along, start + 0.5 * along, direction, tau * field.w,
                                      field.w, region));
            if (kOpaqueVoxels && path.status == kStopped) break;
        }
        vec4 last = fieldAt(next);
        vec3 end = kIntegrator == kVerlet ? halfKick(drift, last, tau)
                                          : eulerStep(path.ray, field, tau * field.w).w;
        // Linear look-ups are the gradient of no potential, so |w| would drift from n over many turns. A
        // share a step keeps it there, and takes little of n's own wavering within a voxel into w.
        if (kField == 1 && kIntegrator == kVerlet)
            end *= mix(1.0, last.w * inversesqrt(dot(end, end)), 0.1);
        if (kMeasures) measureStep(measure, drift, tau * drift, 0.0, tau);
        path.ray = Ray(next, end);
        field = last;
        ++path.steps;
        bool leaves = isLeaving(path.ray);
        path.status = leaves && path.status == kAlive ? kLeft : path.status;
        going = path.steps < path.mostSteps && path.status == kAlive;
        if (kObjects > 0) path.departs = 0.0;
    }
}

// What lies along a step made, piece by piece.
void alongStep(inout Path path, inout Load load, int region, Step made, float tau, float extent) {
    if (!kSamples) return;
    Ray start = path.ray;
    float limit = kEqualSteps ? 0.75 : extent; // about what steps of one look-up of a voxel do
    int pieces = max(int(ceil(extent / limit)), 1);
    float piece = extent / float(pieces);
    for (int i = 0; i < pieces && path.status == kAlive; ++i) {
        Ray at = between(start, made.end, tau, (float(i) + 0.5) / float(pieces));
        float n = length(at.w);
        vec3 direction = at.w / n;
        vec3 along = piece * direction;
        onPiece(path, load, Piece(at.x - 0.5 * along, along, at.x, direction, piece, n, region));
    }
}

// How a step ends: as it was made, on a face, or on an interface.
const int kOn = 0, kLands = 1, kHits = 2;

// Whether a step's interpolant comes to an interface or a face, and after what share of it.
int endingOf(inout Path path, Step made, float tau, inout float share, inout Hit hit) {
    int ending = kOn;
    if (isOutside(made.end.x)) {
        share = shareInside(path.ray, made.end, tau);
        ending = kLands;
    }
    if (kObjects > 0) {
        Segment segment = curvedSegment(path.ray, made.end, tau);
        if (freeOf(path) < segment.extent) {
            hit = intersect(segment, path.objects, path.departs);
            path.steps += hit.looks;
            float beyond = hit.s - share * segment.extent;
            if (hit.object >= 0 && isBeforeFace(hit, pointOn(segment, hit.s), beyond)) {
                share = min(hit.s / segment.extent, share);
                ending = kHits;
            } else {
                hit.object = -1;
            }
        }
    }
    return ending;
}

// Through a varying index to the next interface or face. A step that ends beyond either is made again,
// as long as its interpolant stays before it.
Hit propagateBent(inout Path path, inout Load load, int region) {
    const bool kRunsEqual = kRuns && kEqualSteps && kIntegrator == kVerlet;
    const bool kRunsLimited = kRuns && !kRunsEqual;
    Hit hit = noHit(0.0);
    Measure measure = Measure(path.ray, 0.0, 0.0);
    float n = kMeasures ? indexOf(region, path.ray.x) : 1.0;
    float next = transport.steps.z;
    float tau = next;
    int ending = kOn;
    vec4 first = kIntegrator == kAdaptive ? fieldAt(path.ray.x) : vec4(0.0);
    const bool kRunEnds = kRunsLimited && kObjects == 0; // on a face, by itself
    bool going = !kRunEnds;
    if (kRunEnds) runLimited(path, load, measure, region);
    while (!kRunEnds && going) {
        if (ending == kOn) {
            if (kRunsEqual) runEqual(path, load, measure, region);
            if (kRunsLimited) runLimited(path, load, measure, region);
            tau = min(tau, stepLimit(path.ray, length(path.ray.w)));
        }
        going = path.status == kAlive && path.steps < path.mostSteps;
        if (going) {
            Step made = stepBy(path.ray, first, tau);
            ++path.steps;
            bool good = true;
            float error = 0.0;
            if (kIntegrator == kAdaptive) {
                Control control = controlOf(made, tau);
                good = ending != kOn || control.good;
                if (ending == kOn) next = control.next;
                error = control.error;
            }
            if (good && ending == kOn) {
                float share = 1.0;
                ending = endingOf(path, made, tau, share, hit);
                good = ending == kOn;
                if (!good) next = tau * share;
            }
            if (good) {
                float extent = sqrt(abs(opticalOf(path.ray, made) * tau));
                alongStep(path, load, region, made, tau, extent);
                if (path.status != kStopped) {
                    if (kMeasures)
                        measureStep(measure, path.ray.w, made.change.x, made.excess, tau);
                    goOn(path.ray, path.lost, made.change);
                    path.error += error;
                    path.departs = 0.0;
                    first = made.last;
                }
                going = ending == kOn && path.status == kAlive;
            }
            tau = next;
        }
    }
    if (path.status == kAlive && ending == kLands) {
        path.ray.x = ontoFace(path.ray);
        path.status = kLeft;
    } else if (kObjects > 0 && ending == kHits) { // a last step of Newton's
        vec4 found = distanceAt(hit.object, path.ray.x);
        vec3 direction = normalize(path.ray.w);
        float slope = dot(found.xyz, direction);
        if (abs(found.w) < 0.1 * abs(slope)) path.ray.x -= (found.w / slope) * direction;
        hit.gradient = found.xyz;
    }
    if (path.status != kAlive) hit.object = -1;
    if (kMeasures) closeMeasure(path, measure, n);
    return hit;
}

#include "transport/varying_rays.glsl"

// Through or back at an interface. What goes through a coat is on its base, still among the objects before it.
void scatterAndLand(inout Path path, inout Load load, Interface at, bool coated) {
    ObjectSet before = path.objects;
    vec3 arrives = path.ray.w;
    onInterface(path, load, at);
    if (kCoats && coated && path.status == kAlive && regionOf(path.objects) == at.there) {
        path.objects = before;
        path.ray.w = arrives;
        path.status = kStopped;
        onSurface(path, load, at);
    }
}

// Over an interface. A coat is an interface like others, but that what goes through it ends at once on its base.
void cross(inout Path path, inout Load load, Hit hit) {
    Interface at = interfaceAt(path, hit);
    bool ends = kOpaqueObjects && at.here != at.there && isMatt(at.there);
    if (ends && !isCoated(at)) {
        path.status = kStopped;
        onSurface(path, load, at);
    } else if (isNothing(at)) {
        path.objects = at.objects;
        path.departs = 0.0;
    } else {
        scatterAndLand(path, load, at, ends);
    }
    path.lost = Ray(vec3(0.0), vec3(0.0));
}

// To the next interface and over it, or to the path's end. Returns whether there is more to follow.
bool advance(inout Path path, inout Load load) {
    if (path.status == kAlive) {
        int region = regionOf(path.objects);
        Hit hit = noHit(0.0);
#if CRYSTALS == 2
        if (bendsIn(region, path.mode)) hit = propagateVarying(path, load, region);
        else
#endif
        if (indexVariesIn(region)) hit = propagateBent(path, load, region);
        else hit = propagateStraight(path, load, region);
        if (kObjects > 0 && hit.object >= 0) cross(path, load, hit);
    }
    bool spent = path.steps >= path.mostSteps;
    bool going = kObjects > 0 && path.status == kAlive && !spent;
    if (!going) going = onEnd(path, load);
    return going;
}

// A path to its end, and those that it leaves behind to be followed after it. Blurred, one way is all
// there is.
void trace(inout Path path, inout Load load) {
    bool going = true;
    if (kObjects == 0) advance(path, load);
    else while (going) going = advance(path, load);
}
