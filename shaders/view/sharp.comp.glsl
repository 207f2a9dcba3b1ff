// Viewing rays among sharp boundaries: Snell's and Fresnel's laws there, the ray equation in between.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// At a boundary a ray parts. What is refracted is followed first, what is mirrored waits: so the first
// way to its end is the one that refracts wherever it can. What is gathered is L/n², which a boundary
// leaves as it is, but for the share that goes the other way.
#include "shared/view_params.h"
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lib/fresnel.glsl"
#include "lib/phase.glsl"
#include "lib/ray.glsl"

#if !defined(PATH) || !defined(CHANNELS) || !defined(SOURCE) || !defined(EMISSION) || \
    !defined(OPAQUE) || !defined(MAP) || !defined(PATHS) || !defined(WAITING)
#error PATH must be 0 to 5, SOURCE 0 to 2, CHANNELS 0, 1, 3, EMISSION, OPAQUE, MAP, PATHS 0 or 1
#endif
const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
const int kPath = PATH;
const float kRounding = 6.0e-8;       // of a float, relative
const bool kDims = CHANNELS > 0;      // something absorbs or scatters
const bool kShines = SOURCE > 0;      // light is scattered towards the eye
const bool kLobes = SOURCE == 2;      // scattering prefers a direction
const bool kEmission = EMISSION == 1; // something emits
const bool kOpaque = OPAQUE == 1;     // some object is opaque
const bool kMap = MAP == 1;           // an environment map surrounds the scene, not a colour
const bool kPaths = PATHS == 1;       // each ray's path is written, beside its colour

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params { ViewParams params; };
#include "view/environment.glsl"
layout(std430, binding = 0) buffer Colours { vec4 colours[]; };
layout(std430, binding = 1) writeonly buffer Paths { PixelPath paths[]; };
layout(std430, binding = 2) buffer Counters { uvec2 counters[]; }; // (low, high): see kSlots
#include "medium/sample.glsl"
#include "medium/meet.glsl"
#include "medium/region.glsl"
// Both padded by one voxel.
layout(binding = 3) uniform sampler3D lobes;   // light_direction in voxel space
layout(binding = 6) uniform sampler3D fluence; // [W/m²]
#include "view/sight.glsl"

const uint kMeetings = 5u, kDeep = 6u, kDim = 7u;
const float kShare = 1048576.0; // a dropped share of 1 in the counters of what was dropped

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
}

// One branch of a ray.
const int kWalking = 0, kLeft = 1, kStopped = 2, kTrapped = 3, kDropped = 4;
struct Branch {
    Ray ray;
    vec3 through;        // share of what it meets that the eye sees
    uint inside;         // the solids it is in
    int depth;           // boundaries met
    float departs;       // how steeply it leaves the boundary it starts on; 0: on none
};

// What the pixel's ray has met on all its branches so far.
struct Seen {
    vec3 light;   // L/n²
    bool lit;     // by a medium on the way
    int steps;
    int begun;    // the steps made before the branch at hand
    int meetings; // with boundaries
    int fate;     // of the branch at hand
    float error;  // adaptive: the steps' own estimates, added up [voxel]
    float deep;   // shares dropped because they had met too many boundaries
    float dim;    // shares dropped because they were small
    float pathLength;    // [voxel]
    float opticalLength; // [voxel]
};

#include "view/sharp_medium.glsl"
#include "view/sharp_walk.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= params.picture.x || pixel.y >= params.picture.w) return;
    int at = pixel.y * params.picture.x + pixel.x;
    pixel.y += params.picture.z;

    Sight sight = sightOf(pixel);
    Seen seen = Seen(vec3(0.0), false, 0, 0, 0, kWalking, 0.0, 0.0, 0.0, 0.0, 0.0);
    Branch branch = Branch(Ray(sight.start, sight.direction), vec3(1.0), 0u, 0, 0.0);
    float n = params.march.y; // at the eye
    Branch first = branch;    // where the first one's way ends
    vec4 firstWay = vec4(0.0, 0.0, 0.0, kLeft); // optical and path length, steps, fate
    if (sight.hits) {
        branch.inside = insideAt(sight.start);
        int region = regionOf(branch.inside);
        float entry = indexOf(region, sight.start);
        if (sight.within) n = entry;
        branch.ray.w *= entry;
        if (kOpaque && surfaces.regions[region].index.z == 1.0) { // cut open by the domain's face
            seen.fate = kStopped;
            seen.light = surfaceLight(region, sight.start, faceNormal(sight.start)) / (n * n);
        }
        Branch waiting[WAITING];
        int queue = 0;
        bool onFirst = true;
        bool trapped = false; // on some branch
        bool more = true;
        while (more) {
            if (seen.fate == kWalking) {
                Meeting met = walkOn(seen, branch);
                if (seen.fate == kWalking) {
                    Parted parted = part(seen, branch, met);
                    branch = parted.on;
                    if (parted.waits) waiting[queue++] = parted.other;
                }
            }
            if (seen.fate != kWalking) {
                if (seen.fate == kLeft || seen.fate == kTrapped) // it sees what is straight ahead
                    seen.light += branch.through * backgroundLight(normalize(branch.ray.w)) /
                                  (params.march.y * params.march.y);
                if (onFirst) {
                    first = branch;
                    firstWay = vec4(seen.opticalLength, seen.pathLength, seen.steps, seen.fate);
                }
                onFirst = false;
                trapped = trapped || seen.fate == kTrapped;
                more = queue > 0;
                if (more) {
                    branch = waiting[--queue];
                    seen.begun = seen.steps;
                    seen.fate = kWalking;
                }
            }
        }
        count(kRays, 1u);
        count(kSteps, uint(seen.steps));
        count(kMeetings, uint(seen.meetings));
        if (trapped) count(kTrappedRays, 1u);
        if (seen.deep > 0.0) count(kDeep, uint(seen.deep * kShare + 0.5));
        if (seen.dim > 0.0) count(kDim, uint(seen.dim * kShare + 0.5));
        if (kPath == kAdaptive)
            noteError(seen.error + kRounding * params.tracing.y * sqrt(float(seen.steps)));
    } else {
        seen.light = backgroundLight(sight.direction) / (n * n);
    }
    vec3 direction = normalize(first.ray.w);
    vec3 turned = direction - sight.direction;
    bool stopped = kOpaque && int(firstWay.w) == kStopped;
    // Where no gradient acted the direction is the same but for rounding.
    bool changed = seen.meetings > 0 || seen.lit || stopped || dot(turned, turned) > 1.0e-12 ||
                   first.through != vec3(1.0);
    putColour(at, vec4(seen.light * (n * n), changed ? 1.0 : 0.0));
    if (kPaths && params.pattern.z == 1.0) {
        PixelPath path;
        path.place = vec4(first.ray.x, firstWay.x);
        path.direction = vec4(direction, firstWay.y);
        path.through = vec4(stopped ? vec3(0.0) : first.through, firstWay.z);
        float atExit = sight.hits ? indexOf(regionOf(first.inside), first.ray.x) : 1.0;
        path.error = vec4(abs(length(first.ray.w) - atExit), sight.hits ? 0.0 : 1.0, 0.0, 0.0);
        paths[at] = path;
    }
}
