// From domain to domain: a ray that leaves one goes on in the next that lies ahead, in a launch of that one's
// kernel. Rays that wait for it are linked pixel by pixel, so that what they add up to is the same every time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/box.glsl"
#include "shared/domain_params.h"

#if DOMAINS == 1
layout(std140, binding = kDomainsBlock) uniform Domains { DomainParams domains; };
layout(std430, binding = kDeparturesBuffer) buffer Departures {
    uvec4 departed; // x: departures so far, y: those taken up
    Departure departures[];
};
layout(std430, binding = kPendingBuffer) buffer Pending { int pending[]; }; // of each pixel, the first + 1; 0: none

float eyeIndex = 1.0;       // index at the eye; 0: that where the ray enters
int stripPixel = 0;         // the pixel's place in the strip
bool isFirst = false;       // the ray is, or goes on from, its pixel's first branch
bool wasChanged = false;    // and was bent, dimmed or lit before
vec3 lengthsBefore = vec3(0.0); // [unit], steps

struct Ahead {
    int domain; // −1: none
    float way;  // to it, in lengths of the direction
    vec3 place; // where the ray enters [its voxel]
};

// The next domain on a way, but this one.
Ahead nextDomain(dvec3 x, dvec3 direction) {
    Ahead ahead = Ahead(-1, 1.0e30, vec3(0.0));
    for (int i = 0; i < domains.numbers.y; ++i) {
        if (i == domains.numbers.x) continue;
        dvec3 there = (domains.otherFromVoxel[i] * dvec4(x, 1.0LF)).xyz;
        dvec3 along = (domains.otherFromVoxel[i] * dvec4(direction, 0.0LF)).xyz;
        dvec3 far = dvec3(domains.size[i].xyz) - 0.5LF;
        double enter = 0.0LF;
        double leave = 1.0e30LF;
        for (int k = 0; k < 3; ++k) {
            if (along[k] == 0.0LF) {
                if (there[k] < -0.5LF || there[k] > far[k]) leave = -1.0LF;
            } else {
                double a = (-0.5LF - there[k]) / along[k];
                double b = (far[k] - there[k]) / along[k];
                enter = max(enter, min(a, b));
                leave = min(leave, max(a, b));
            }
        }
        // One that is left where it is entered, or just behind the ray, is not ahead.
        bool isAhead = enter < leave && leave > 1.0e-4LF;
        if (isAhead && float(enter) < ahead.way) ahead = Ahead(i, float(enter), vec3(there + enter * along));
    }
    return ahead;
}

// Returns whether there was room.
bool depart(Ahead ahead, vec3 direction, float eye, vec3 throughput, vec3 along, int depth, int marks, vec3 lengths) {
    uint place = atomicAdd(departed.x, 1u);
    if (place >= uint(domains.numbers.w)) {
        atomicAdd(departed.y, 1u);
        return false;
    }
    mat3 turn = mat3(domains.otherFromVoxel[ahead.domain]);
    departures[place] = Departure(vec4(ahead.place, 0.0), vec4(normalize(turn * direction), eye),
                                  vec4(throughput, 0.0), vec4(along, 0.0), vec4(lengths, 0.0),
                                  ivec4(ahead.domain, depth, marks, pending[stripPixel] - 1));
    pending[stripPixel] = int(place) + 1;
    return true;
}

// The next one of a list that this domain takes up; others are linked anew.
int arrivalFrom(int place, bool takes) {
    while (place >= 0) {
        if (takes && departures[place].kind.x == domains.numbers.x) return place;
        int next = departures[place].kind.w;
        departures[place].kind.w = pending[stripPixel] - 1;
        pending[stripPixel] = place + 1;
        place = next;
    }
    return -1;
}
#endif
