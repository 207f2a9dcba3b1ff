// Where a ray first meets a boundary.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/box.glsl"
#include "lib/dip.glsl"
#include "lib/ray.glsl"
#include "medium/surface.glsl"

const float kNearStep = 1.5;    // longest step near a boundary: its first voxel's bits cover it
const float kClose = 0.1;       // a zero so close is told from here [voxel],
const float kBent = 3.0e-3;     // if the gradient turns by no more than that on the way [rad]
const float kEnclosed = 2.0e-5; // a zero between points this close is at either [voxel]
const int kMostLooks = 8192;    // more than along a plate of the longest domain
const float kTouch = 0.1;       // solids this close touch [voxel]

// A piece of way, x at s in [0, extent]: start + f (first + f (second + f third)), f = s / extent.
struct Way {
    vec3 start;
    vec3 first;
    vec3 second;
    vec3 third;
    float extent; // its length [voxel]
};

Way straightWay(vec3 x, vec3 direction, float length) {
    return Way(x, length * direction, vec3(0.0), vec3(0.0), length);
}

// The cubic of between() in lib/ray.glsl.
Way curvedWay(Ray a, Ray b, float tau) {
    vec3 whole = b.x - a.x;
    return Way(a.x, tau * a.w, 3.0 * whole - tau * (2.0 * a.w + b.w), tau * (a.w + b.w) - 2.0 * whole,
               0.5 * tau * (length(a.w) + length(b.w)));
}

vec3 placeOn(Way way, float s) {
    float f = s / way.extent;
    if (kField == 0) return way.start + f * way.first;
    return way.start + f * (way.first + f * (way.second + f * way.third));
}

vec3 directionOn(Way way, float s) { // dx/ds, of length 1 or nearly
    float f = s / way.extent;
    if (kField == 0) return way.first / way.extent;
    return (way.first + f * (2.0 * way.second + (3.0 * f) * way.third)) / way.extent;
}

// Where a way meets a boundary.
struct Meeting {
    float s;       // [voxel]; the way's end if it meets none
    int solid;     // −1: none
    vec3 gradient; // of the solid's distance there
    int looks;     // how often it was looked where boundaries are
};

// The first boundary on the way of a ray within the solids `inside`. `departs` is how steeply the way
// leaves the boundary it starts on, 0 if on none.
//
// Leaps as long as no boundary can be met, by filtered clearances. Where one is near the exact distance,
// its slope along the way and how that changes are looked up: a zero close ahead is told from there, to
// second order; else Newton's steps lead to it, and the ends of every step tell whether the way was
// beyond a boundary in between. A zero is enclosed from there on. What starts beyond a boundary by
// rounding or by less than kTouch, and comes back, has not met it.
Meeting meet(Way way, uint inside, float departs) {
    Meeting met = Meeting(way.extent, -1, vec3(0.0), 0);
    vec2 own[SOLIDS];    // distance from this side and its slope, at s
    float least[SOLIDS]; // how far beyond the boundary the way started
    for (int k = 0; k < kSolids; ++k) {
        own[k] = vec2(0.0);
        least[k] = 0.0;
    }
    float s = 0.0;       // known to be before any boundary
    float beyond = -1.0; // known to be behind one, if above s
    // One solid alone is left for good after a steep start: no boundary so soon.
    float trial = kSolids == 1 && departs > 0.35 ? min(0.75, way.extent) : 0.0;
    uint known = 0u;     // the solids whose `own` is of s
    bool walking = true;
    while (walking) {
        // Leaps. A loop of its own: software devices walk all of a loop's branches in every round.
        bool leaping = beyond <= s;
        float last = -1.0; // the clearance at s, if exact
        while (leaping) {
            float free = clearanceAt(placeOn(way, trial));
            if (kSolids == 1) free *= sideOf(inside, 0);
            ++met.looks;
            leaping = free > 2.0 * kRough;
            if (leaping) {
                last = free < kFar ? free : -1.0;
                s = trial;
                known = 0u;
                trial = min(s + leapBy(free), way.extent);
                walking = s < way.extent;
                leaping = walking && met.looks < kMostLooks;
            } else if (kSolids == 1 && last > 0.0 && free > -kRough && trial < way.extent) {
                // Close by: where the last two distances point to is a good place to look first.
                float fall = (last - free) / (trial - s);
                trial = min(trial + (fall > 0.2 ? free / fall : 0.0), way.extent);
            }
        }
        if (walking) {
            vec3 x = placeOn(way, trial);
            uint close = closeTo(x) | known;
            vec3 d = directionOn(way, trial);
            ++met.looks;
            vec2 here[SOLIDS];
            vec2 nearest = vec2(1.0e9, 0.0); // of the boundary met next, or passed furthest
            int solid = -1;
            vec3 gradient = vec3(0.0);
            vec3 change = vec3(0.0);
            bool over = false;
            for (int k = 0; k < kSolids; ++k) {
                here[k] = vec2(1.0e9, 0.0);
                if (((close >> k) & 1u) == 0u) continue;
                Curved curved = curvedDistanceAt(k, x, d);
                vec4 found = sideOf(inside, k) * curved.sum;
                here[k] = vec2(found.w, dot(found.xyz, d));
                if (trial == 0.0 && here[k].y > 0.0) least[k] = min(here[k].x, 0.0);
                if (here[k].x > 0.0) least[k] = 0.0;
                bool past = here[k].x < least[k] - 1.0e-6;
                over = over || past;
                bool ahead = past || here[k].y < 0.0;
                if (solid < 0 || (ahead && here[k].x < nearest.x)) {
                    nearest = ahead ? here[k] : vec2(1.0e9, 0.0);
                    solid = k;
                    gradient = curved.sum.xyz;
                    change = curved.change;
                }
            }
            float left = nearest.y < 0.0 ? -nearest.x / nearest.y : 1.0e9; // to go, or to go back
            bool hit = abs(left) < kClose && abs(left) * length(change) < kBent &&
                       trial + left <= way.extent;
            bool enclosed = (over ? trial : beyond) - s < kEnclosed * (1.0 + 0.01 * s) &&
                            (over || beyond > s);
            if (hit || enclosed) {
                // To second order, for a boundary that bends away from its tangent.
                float bend = 0.5 * sideOf(inside, solid) * dot(change, d) / nearest.y;
                float rest = hit ? left * (1.0 - clamp(left * bend, -0.1, 0.1)) : 0.0;
                met.s = clamp(trial + rest, 0.0, way.extent);
                met.solid = solid;
                met.gradient = gradient + rest * change;
                walking = false;
            } else if (over) {
                beyond = trial;
                float back = trial + left;
                trial = back > s && back < beyond ? back : 0.5 * (s + beyond);
            } else {
                float probe = -1.0;
                if (beyond <= s)
                    for (int k = 0; k < kSolids; ++k)
                        if (((known & close) >> k & 1u) == 1u && own[k].y < 0.0 && here[k].y > 0.0) {
                            float h = trial - s;
                            vec2 dip = dipOf(own[k].x, own[k].y * h, here[k].x, here[k].y * h);
                            if (dip.y < 0.0 && (probe < 0.0 || dip.x * h < probe)) probe = dip.x * h;
                        }
                if (probe > 0.0) {
                    trial = s + probe;
                    known = 0u; // looked at once
                } else {
                    s = trial;
                    own = here;
                    known = close;
                    float ahead = kNearStep;
                    for (int k = 0; k < kSolids; ++k)
                        if (((close >> k) & 1u) == 1u)
                            ahead = min(ahead, here[k].y < 0.0 ? -here[k].x / here[k].y
                                                               : max(here[k].x, 0.5));
                    trial = s + max(ahead, 1.0e-3);
                    if (beyond > s && trial >= beyond) trial = 0.5 * (s + beyond);
                    trial = min(trial, way.extent);
                    walking = s < way.extent;
                }
            }
        }
        walking = walking && met.looks < kMostLooks;
    }
    return met;
}

// The same on a straight way, of which only what lies in the boundaries' box is searched.
Meeting meetStraight(vec3 x, vec3 direction, float reach, uint inside, float departs) {
    vec2 span = boxSpan(x, direction, surfaces.low.xyz, surfaces.high.xyz);
    float from = max(span.x, 0.0);
    float to = min(span.y, reach);
    Meeting met = Meeting(reach, -1, vec3(0.0), 0);
    if (to > from) {
        met = meet(straightWay(x + from * direction, direction, to - from), inside,
                   from > 0.0 ? 0.0 : departs);
        met.s = met.solid < 0 ? reach : met.s + from;
    }
    return met;
}

// The solids beyond a boundary met at x by a ray along w; `forward` is the unit normal on its far side.
// Solids that touch there are one boundary: a ray that is about to go through that of another one has
// done so, if a little way off that one rules.
uint insideBeyond(uint inside, int solid, vec3 x, vec3 w, vec3 forward) {
    uint after = inside ^ (1u << solid);
    if (kSolids == 1) return after;
    uint close = closeTo(x);
    for (int k = 0; k < kSolids; ++k)
        if (k != solid && ((close >> k) & 1u) == 1u) {
            vec4 found = distanceAt(k, x);
            bool leaves = sideOf(inside, k) * dot(found.xyz, w) >= 0.0;
            if (leaves || abs(found.w) > 2.0 * kTouch) continue;
            after &= ~(1u << k);
            after |= (distanceAt(k, x + kTouch * forward).w < 0.0 ? 1u : 0u) << k;
        }
    return after;
}
