// Where a pixel's ray starts, where its colour goes, and what is counted on the way.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the buffers `colours` and `counters` are declared.

// Counters are spread over slots so that pixels do not queue for one.
const uint kSlots = 64u;
const uint kRays = 0u, kSteps = 1u, kTrappedRays = 2u, kWorst = 3u, kOver = 4u, kCounters = 8u;

uint slotOf() {
    return (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
}

void count(uint counter, uint amount) {
    uint at = slotOf() * kCounters + counter;
    uint before = atomicAdd(counters[at].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(counters[at].y, 1u);
}

// The largest estimate of a ray's error, as the bits of a float, and the rays above the tolerance.
void noteError(float error) {
    atomicMax(counters[slotOf() * kCounters + kWorst].x, floatBitsToUint(error));
    if (error > params.tracing.x) count(kOver, 1u);
}

struct Sight {
    vec3 start;     // on the domain's face, or the eye [voxel]
    vec3 direction; // of length 1
    bool hits;      // the domain
    bool within;    // the eye is in the domain
};

// Set up in double: a distant eye must not jitter the point of entry.
Sight sightOf(ivec2 pixel) {
    vec2 s = vec2(2.0, -2.0) * (vec2(pixel) + params.pattern.xy) / vec2(params.picture.xy) +
             vec2(-1.0, 1.0);
    bool perspective = params.eyeHigh.w == 1.0;
    dvec3 eye = dvec3(params.eyeHigh.xyz) + dvec3(params.eyeLow.xyz);
    dvec3 offset = double(s.x) * dvec3(params.right.xyz) + double(s.y) * dvec3(params.up.xyz);
    dvec3 towards = dvec3(params.forward.xyz) + (perspective ? offset : dvec3(0.0));
    towards /= sqrt(dot(towards, towards));
    if (!perspective) eye += offset;
    dvec3 far = dvec3(params.size.xyz) - 0.5;
    double enter = 0.0LF;
    double leave = 1.0e300LF;
    for (int i = 0; i < 3; ++i) {
        if (towards[i] == 0.0LF) {
            if (eye[i] < -0.5LF || eye[i] > far[i]) leave = -1.0LF;
        } else {
            double a = (-0.5LF - eye[i]) / towards[i];
            double b = (far[i] - eye[i]) / towards[i];
            enter = max(enter, min(a, b));
            leave = min(leave, max(a, b));
        }
    }
    bool hits = enter < leave;
    vec3 low = vec3(-0.5);
    vec3 high = vec3(params.size.xyz) - 0.5;
    vec3 start = hits ? clamp(vec3(eye + enter * towards), low, high) : vec3(eye);
    return Sight(start, vec3(towards), hits, hits && enter == 0.0LF);
}

// A ray's share of its pixel, added to those of the rays before it.
void putColour(int at, vec4 colour) {
    vec4 before = params.pattern.z == 1.0 ? vec4(0.0) : colours[at];
    colours[at] = before + params.pattern.w * colour;
}
