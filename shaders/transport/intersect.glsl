// The first boundary on a segment of a path.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/box.glsl"
#include "lib/dip.glsl"
#include "lib/ray.glsl"
#include "transport/regions.glsl"

const float kNearStep = 1.5;    // longest step near a boundary: its first voxel's bits cover it
const float kClose = 0.1;       // a zero so close is told from here [voxel],
const float kBent = 3.0e-3;     // if the gradient turns by no more than that on the way [rad]
const float kEnclosed = 2.0e-5; // a zero between points this close is at either [voxel]
const int kMostLooks = 8192;    // more than along a plate of the longest domain

const bool kCurves = kField > 0 || kVaryingCrystals;

// A segment of a path, x at s in [0, extent]: start + f (first + f (second + f third)), f = s / extent.
struct Segment {
    vec3 start;
    vec3 first;
    vec3 second;
    vec3 third;
    float extent; // its length [voxel]
};

Segment straightSegment(vec3 x, vec3 direction, float extent) {
    return Segment(x, extent * direction, vec3(0.0), vec3(0.0), extent);
}

// The cubic of between() in lib/ray.glsl.
Segment curvedSegment(Ray a, Ray b, float tau) {
    vec3 whole = b.x - a.x;
    return Segment(a.x, tau * a.w, 3.0 * whole - tau * (2.0 * a.w + b.w),
                   tau * (a.w + b.w) - 2.0 * whole, 0.5 * tau * (length(a.w) + length(b.w)));
}

vec3 pointOn(Segment segment, float s) {
    float f = s / segment.extent;
    if (!kCurves) return segment.start + f * segment.first;
    return segment.start + f * (segment.first + f * (segment.second + f * segment.third));
}

vec3 directionOn(Segment segment, float s) { // dx/ds, of length 1 or nearly
    float f = s / segment.extent;
    if (!kCurves) return segment.first / segment.extent;
    return (segment.first + f * (2.0 * segment.second + (3.0 * f) * segment.third)) / segment.extent;
}

// Where a segment meets a boundary.
struct Hit {
    float s;       // [voxel]; the segment's end if it meets none
    int object;    // −1: none
    vec3 gradient; // of the object's distance there
    int looks;     // 1, and how often it was looked where boundaries are
};

Hit noHit(float s) {
    return Hit(s, -1, vec3(0.0), 1);
}

// The first boundary on a segment that starts within `objects`. `departs` is how steeply it leaves the
// boundary it starts on, 0 if on none.
//
// Leaps as long as no boundary can be met, by filtered clearances. Where one is near the exact distance,
// its slope along the way and how that changes are looked up: a zero close ahead is told from there, to
// second order; else Newton's steps lead to it, and the ends of every step tell whether the way was
// beyond a boundary in between. A zero is enclosed from there on. What starts beyond a boundary by
// rounding or by less than kTouch, and comes back, has not met it.
Hit intersect(Segment segment, ObjectSet objects, float departs) {
    Hit hit = noHit(segment.extent);
    vec2 own[kObjectSlots];    // distance from this side and its slope, at s
    float least[kObjectSlots]; // how far beyond the boundary the way started
    for (int i = 0; i < kObjectSlots; ++i) {
        own[i] = vec2(0.0);
        least[i] = 0.0;
    }
    float s = 0.0;       // known to be before any boundary
    float beyond = -1.0; // known to be behind one, if above s
    ObjectSet known = ObjectSet(0u);   // the objects whose `own` is of s
    ObjectSet started = ObjectSet(0u); // those near the start
    // A boundary that is alone there is left for good after a steep start: none so soon.
    float trial = departs > 0.35 && slotsOf(closeTo(segment.start)) == 1 ? min(0.75, segment.extent) : 0.0;
    bool walking = true;
    while (walking) {
        // Leaps. A loop of its own: software devices walk all of a loop's branches in every round.
        bool leaping = beyond <= s;
        float last = -1.0; // the clearance at s, if exact
        while (leaping) {
            float free = clearanceAt(pointOn(segment, trial));
            if (kObjects == 1) free *= sideOf(objects, 0);
            ++hit.looks;
            leaping = freeBy(free) > leastLeap();
            if (leaping) {
                last = free < exactClearance() ? free : -1.0;
                s = trial;
                known = ObjectSet(0u);
                trial = min(s + freeBy(free), segment.extent);
                walking = s < segment.extent;
                leaping = walking && hit.looks < kMostLooks;
            } else if (kObjects == 1 && last > 0.0 && free > -leastLeap() && trial < segment.extent) {
                // Close by: where the last two distances point to is a good place to look first.
                float fall = (last - free) / (trial - s);
                trial = min(trial + (fall > 0.2 ? free / fall : 0.0), segment.extent);
            }
        }
        if (walking) {
            vec3 x = pointOn(segment, trial);
            ObjectSet close = closeTo(x);
            // Of few objects those of the step's start are asked as well. What lies between is near
            // both ends, but for distances that are none; of many a set is no larger than one cube's.
            if (!kMany) close |= known;
            if (trial == 0.0) started = close;
            vec3 d = directionOn(segment, trial);
            ++hit.looks;
            vec2 here[kObjectSlots];
            vec2 nearest = vec2(1.0e9, 0.0); // of the boundary met next, or passed furthest
            int object = -1;
            vec3 gradient = vec3(0.0);
            vec3 change = vec3(0.0);
            bool over = false;
            ObjectSet rest = close;
            for (int i = 0; i < slotsOf(close); ++i) {
                int k = objectAt(rest);
                Curved curved = curvedDistanceAt(k, x, d);
                vec4 found = sideOf(objects, k) * curved.sum;
                here[i] = vec2(found.w, dot(found.xyz, d));
                bool noted = contains(started, k);
                int slot = noted ? slotOf(started, k) : 0;
                if (trial == 0.0 && here[i].y > 0.0) least[slot] = min(here[i].x, 0.0);
                if (noted && here[i].x > 0.0) least[slot] = 0.0;
                bool past = here[i].x < (noted ? least[slot] : 0.0) - 1.0e-6;
                over = over || past;
                bool ahead = past || here[i].y < 0.0;
                if (object < 0 || (ahead && here[i].x < nearest.x)) {
                    nearest = ahead ? here[i] : vec2(1.0e9, 0.0);
                    object = k;
                    gradient = curved.sum.xyz;
                    change = curved.change;
                }
            }
            float left = nearest.y < 0.0 ? -nearest.x / nearest.y : 1.0e9; // to go, or to go back
            bool told = abs(left) < kClose && abs(left) * length(change) < kBent &&
                       trial + left <= segment.extent;
            bool enclosed = (over ? trial : beyond) - s < kEnclosed * (1.0 + 0.01 * s) &&
                            (over || beyond > s);
            if (told || enclosed) {
                // To second order, for a boundary that bends away from its tangent.
                float bend = 0.5 * sideOf(objects, object) * dot(change, d) / nearest.y;
                float rest = told ? left * (1.0 - clamp(left * bend, -0.1, 0.1)) : 0.0;
                hit.s = clamp(trial + rest, 0.0, segment.extent);
                hit.object = object;
                hit.gradient = gradient + rest * change;
                walking = false;
            } else if (over) {
                beyond = trial;
                float back = trial + left;
                trial = back > s && back < beyond ? back : 0.5 * (s + beyond);
            } else {
                float probe = -1.0;
                if (beyond <= s) {
                    ObjectSet both = known & close;
                    rest = both;
                    for (int i = 0; i < slotsOf(both); ++i) {
                        int k = objectAt(rest);
                        vec2 before = own[slotOf(known, k)];
                        vec2 now = here[slotOf(close, k)];
                        if (before.y >= 0.0 || now.y <= 0.0) continue;
                        float h = trial - s;
                        vec2 dip = dipOf(before.x, before.y * h, now.x, now.y * h);
                        if (dip.y < 0.0 && (probe < 0.0 || dip.x * h < probe)) probe = dip.x * h;
                    }
                }
                if (probe > 0.0) {
                    trial = s + probe;
                    known = ObjectSet(0u); // looked at once
                } else {
                    s = trial;
                    own = here;
                    known = close;
                    float ahead = kNearStep;
                    for (int i = 0; i < slotsOf(close); ++i)
                        ahead = min(ahead, here[i].y < 0.0 ? -here[i].x / here[i].y : max(here[i].x, 0.5));
                    trial = s + max(ahead, 1.0e-3);
                    if (beyond > s && trial >= beyond) trial = 0.5 * (s + beyond);
                    trial = min(trial, segment.extent);
                    walking = s < segment.extent;
                }
            }
        }
        walking = walking && hit.looks < kMostLooks;
    }
    return hit;
}

// Whether a boundary that is met at x, so far beyond the domain's face, is met before a path leaves.
bool isBeforeFace(Hit hit, vec3 x, float beyond) {
    return beyond <= 4.0 * roundingAt(2.0 * transport.halfSize.xyz) ||
           (beyond <= 2.0 * kFlush && liesAlongFace(x, hit.gradient));
}

// The same on a straight way, of which only what lies in the boundaries' box is searched. A boundary on
// the domain's face, where the way ends, is met.
Hit intersectStraight(vec3 x, vec3 direction, float reach, ObjectSet objects, float departs) {
    vec2 span = boxSpan(x, direction, scene.low.xyz, scene.high.xyz);
    float from = max(span.x, 0.0);
    float to = min(span.y, reach) + kFlush;
    Hit hit = noHit(reach);
    if (to > from) {
        hit = intersect(straightSegment(x + from * direction, direction, to - from), objects,
                        from > 0.0 ? 0.0 : departs);
        if (!isBeforeFace(hit, x + (from + hit.s) * direction, from + hit.s - reach)) hit.object = -1;
        hit.s = hit.object < 0 ? reach : min(hit.s + from, reach);
    }
    return hit;
}
