// Corners of a wavefront's patches through a step of time: dx/dt = w/n², dw/dt = ∇n/n (Ihrke et al. 2007,
// eqs 12–13), which is a step of the Hamiltonian form with dt = n² dτ.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A work item carries one corner. The clock is the optical path length. Before they enter the domain and
// behind it corners fly straight on, so that a patch is whole until all of it has left. Where there are
// boundaries a corner looks some way beyond the step as well: a patch goes over a boundary as a whole.
#include "lib/attenuation.glsl"
#include "shared/bindings.h"
#include "shared/front_params.h"
#include "transport/integrate.glsl"
#include "transport/interface.glsl"
#include "transport/path.glsl"

#if !defined(CHANNELS) || !defined(MEDIUM)
#error CHANNELS must be 1 or 3, MEDIUM 0 to 2
#endif
const bool kMedium = MEDIUM > 0;    // something absorbs or scatters
const bool kColour = CHANNELS == 3; // media or mirrors' tints differ by wavelength
const bool kMeetsAnything = kObjects > 0 || kOpaqueVoxels;

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { FrontParams params; };
layout(std430, binding = kFrontBeforeBuffer) readonly buffer Before { FrontCorner before[]; };
layout(std430, binding = kFrontAfterBuffer) writeonly buffer After { FrontCorner after[]; };
layout(std430, binding = kFrontPatchesBuffer) readonly buffer Patches { FrontPatch patches[]; };
layout(std430, binding = kFrontDepthsBuffer) writeonly buffer Depths { FrontDepth depths[]; };
layout(std430, binding = kFrontHitsBuffer) writeonly buffer Hits { FrontHit hits[]; };
layout(binding = kOpaqueUnit) uniform usampler3D opaque; // per voxel, not 0 inside opaque material
#include "lightsim/medium.glsl"

const float kLate = 0.02;        // a clock so little behind waits for the next step [voxel]
const float kLongest = 1.0;      // step through an index or a medium that varies [voxel]
const float kOpaqueLook = 0.5;   // between looks for opaque voxels [voxel]
const int kMostRounds = 256;     // of one step: more than its length allows

// A corner on its way.
struct Flight {
    Path path;
    float clock;
    vec3 absorbed;  // optical depths of this step
    vec3 scattered;
    float extent;   // of the way that these are of [voxel]
    Hit ahead;      // of a straight way: what is met; `s` is how far it is known
};

vec3 highCorner() {
    return 2.0 * transport.halfSize.xyz - 0.5;
}

// Takes up where the corner meets the domain, or starts within it.
void enter(inout Flight flight, vec3 direction) {
    flight.path.ray.x = clampToDomain(flight.path.ray.x);
    flight.path.objects = kObjects > 0 ? objectsAt(flight.path.ray.x, direction, params.time.z == 1.0)
                                       : flight.path.objects;
    int region = regionOf(flight.path.objects);
    // Steps keep |w| at n; one look-up tells where to begin, a device walks this branch every time.
    bool steps = kIntegrator == kVerlet && kField == 1 && indexVariesIn(region);
    float n = steps ? fieldAt(flight.path.ray.x).w : indexOf(region, flight.path.ray.x);
    flight.path.ray.w = n * direction;
    flight.path.status = isOpaque(region) ? kStopped : kAlive;
}

// Towards the domain, where it begins within the time.
void approach(inout Flight flight, float until) {
    float n = length(flight.path.ray.w);
    vec3 direction = flight.path.ray.w / n;
    vec2 span = boxSpan(flight.path.ray.x, direction, vec3(-0.5), highCorner());
    float left = max(until - flight.clock, 0.0) / n;
    float way = max(span.x, 0.0);
    bool enters = span.x < span.y && span.y > 0.0 && way <= left;
    way = enters ? way : left;
    flight.path.ray.x += way * direction;
    flight.clock += n * way;
    if (enters) enter(flight, direction);
    else if (span.x >= span.y || span.y <= 0.0) flight.path.status = kLeft;
}

// A piece of the way dims the corner.
void dim(inout Flight flight, vec3 start, vec3 direction, float extent, float n) {
    if (!kMedium) return;
    Extinction medium = extinctionOf(pieceFrom(start, direction, extent, n, regionOf(flight.path.objects)));
    vec3 absorbed = extent * medium.absorbed;
    vec3 scattered = extent * medium.scattered;
    flight.absorbed += absorbed;
    flight.scattered += scattered;
    vec3 depth = absorbed + scattered;
    flight.path.throughput.x *= attenuationOf(depth.x).through;
    if (kColour) {
        flight.path.throughput.y *= attenuationOf(depth.y).through;
        flight.path.throughput.z *= attenuationOf(depth.z).through;
    }
}

// The first opaque voxel on a piece stops the corner there.
void stopAtVoxels(inout Flight flight, vec3 start, vec3 end) {
    if (!kOpaqueVoxels) return;
    float looks = max(ceil(length(end - start) / kOpaqueLook), 1.0);
    for (float i = 1.0; i <= looks && flight.path.status == kAlive; i += 1.0) {
        vec3 x = mix(start, end, i / looks);
        if (isOutside(x)) break;
        if (texelFetch(opaque, ivec3(x + 0.5), 0).x != 0u) {
            flight.path.status = kStopped;
            flight.path.ray.x = x;
        }
    }
}

// Straight on behind the domain. Media dim a corner as its neighbours still inside.
void leave(inout Flight flight, float until) {
    float n = length(flight.path.ray.w);
    float way = max(until - flight.clock, 0.0) / n;
    dim(flight, flight.path.ray.x, flight.path.ray.w / n, way, n);
    flight.path.ray.x += (way / n) * flight.path.ray.w;
    flight.clock += n * way;
    flight.extent += way;
}

// How far a corner may fly straight before the medium is looked up again [voxel].
float straightPiece(int region) {
    return kOpaqueVoxels || (kMedium && coefficientsVaryIn(region)) ? kLongest : 1.0e9;
}

// Through an index that does not vary. `reach` is how far boundaries are looked for.
void flyStraight(inout Flight flight, int region, float until, float reach) {
    float n = indexOf(region, flight.path.ray.x);
    vec3 direction = flight.path.ray.w / n;
    float face = timeToFace(flight.path.ray.x, direction);
    float wanted = (until - flight.clock) / n;
    if (kObjects > 0 && flight.ahead.object < 0 && flight.ahead.s < min(wanted, face)) {
        float seen = min(face, wanted + reach / n);
        flight.ahead = intersectStraight(flight.path.ray.x, direction, seen, flight.path.objects,
                                         flight.path.departs);
    }
    bool meets = kObjects > 0 && flight.ahead.object >= 0 && flight.ahead.s <= wanted;
    float way = meets ? flight.ahead.s : wanted;
    float piece = straightPiece(region);
    if (way > piece) {
        way = piece;
        meets = false;
    }
    vec3 start = flight.path.ray.x;
    float within = min(way, face);
    dim(flight, start, direction, way, n);
    flight.path.ray.x = start + way * direction;
    flight.clock += n * way;
    flight.extent += way;
    flight.ahead.s -= way;
    if (way > 0.0) flight.path.departs = 0.0;
    stopAtVoxels(flight, start, start + within * direction);
    if (flight.path.status == kAlive) flight.path.status = meets ? kMeets : way > face ? kLeft : kAlive;
}

// A step of dτ. Verlet's drift–kick–drift takes one look-up.
Step stepOf(Ray ray, float tau) {
    if (kIntegrator == kVerlet) {
        vec4 field = fieldAt(verletMiddle(ray, tau));
        Ray end = verletStep(ray, field, tau);
        vec3 mean = 0.5 * (ray.w + end.w);
        // As in runLimited(): linear look-ups are the gradient of no potential.
        if (kField == 1) end.w *= mix(1.0, field.w * inversesqrt(dot(mean, mean)), 0.1);
        vec3 moved = end.x - ray.x;
        return Step(end, Ray(moved, end.w - ray.w), field.w * field.w * tau - dot(ray.w, moved), field, 0.0,
                    0.0);
    }
    return stepBy(ray, kIntegrator == kAdaptive ? fieldAt(ray.x) : vec4(0.0), tau);
}

// An adaptive step is made shorter until it is good.
Step goodStep(Ray ray, inout float tau) {
    Step made = stepOf(ray, tau);
    if (kIntegrator == kAdaptive) {
        Control control = controlOf(made, tau);
        for (int i = 0; i < 16 && !control.good; ++i) {
            tau = control.next;
            made = stepOf(ray, tau);
            control = controlOf(made, tau);
        }
    }
    return made;
}

// What a step meets, if it is before the domain's face; the step then ends there.
Hit hitOf(inout Flight flight, inout Step made, inout float tau) {
    Segment segment = curvedSegment(flight.path.ray, made.end, tau);
    Hit hit = noHit(segment.extent);
    if (freeBy(abs(clearanceAt(flight.path.ray.x))) >= segment.extent) return hit;
    float face = isOutside(made.end.x) ? shareInside(flight.path.ray, made.end, tau) : 1.0;
    hit = intersect(segment, flight.path.objects, flight.path.departs);
    if (hit.object >= 0 && !isBeforeFace(hit, pointOn(segment, hit.s), hit.s - face * segment.extent))
        hit.object = -1;
    if (hit.object >= 0) {
        tau *= max(min(hit.s / segment.extent, face), 1.0e-6);
        made = stepOf(flight.path.ray, tau);
        vec4 found = distanceAt(hit.object, made.end.x);
        vec3 direction = normalize(made.end.w);
        float slope = dot(found.xyz, direction);
        if (abs(found.w) < 0.1 * abs(slope)) made.end.x -= (found.w / slope) * direction;
        hit.gradient = found.xyz;
    }
    return hit;
}

// A step through an index that varies.
void flyBent(inout Flight flight, int region, float until) {
    Ray start = flight.path.ray;
    float n2 = dot(start.w, start.w);
    float longest = min(transport.steps.w, kLongest);
    float tau = min((until - flight.clock) / n2, longest * inversesqrt(n2));
    Step made = goodStep(start, tau);
    Hit hit = noHit(0.0);
    if (kObjects > 0) hit = hitOf(flight, made, tau);
    float optical = opticalOf(start, made);
    float extent = sqrt(abs(optical * tau));
    Ray middle = between(start, made.end, tau, 0.5);
    float n = length(middle.w);
    dim(flight, middle.x - (0.5 * extent / n) * middle.w, middle.w / n, extent, n);
    flight.path.ray = made.end;
    flight.clock += optical;
    flight.extent += extent;
    flight.path.departs = 0.0;
    stopAtVoxels(flight, start.x, made.end.x);
    if (flight.path.status != kAlive) return;
    if (kObjects > 0 && hit.object >= 0) {
        flight.ahead = hit;
        flight.path.status = kMeets;
    } else if (isOutside(made.end.x)) {
        flight.path.status = kLeft;
    }
}

// Until the clock says so, or a boundary is met. `reach` is how far those are looked for.
void fly(inout Flight flight, float until, float reach) {
    if (flight.path.status == kNone && until - flight.clock > kLate) approach(flight, until);
    for (int i = 0; i < kMostRounds && flight.path.status == kAlive && until - flight.clock > kLate; ++i) {
        int region = regionOf(flight.path.objects);
        if (indexVariesIn(region)) flyBent(flight, region, until);
        else flyStraight(flight, region, until, reach);
    }
    if (flight.path.status == kLeft) leave(flight, until);
}

// Whether there may be a boundary within reach beyond the step.
bool mayMeet(Flight flight) {
    if (kObjects == 0) return true;
    return flight.path.status == kNone ||
           freeBy(abs(clearanceAt(flight.path.ray.x))) * length(flight.path.ray.w) < params.time.y;
}

Flight flightFrom(FrontCorner corner) {
    Path path = pathFrom(corner.place.xyz, corner.wave.xyz, 0);
    path.departs = corner.wave.w;
    path.throughput = corner.weight.xyz;
    path.status = int(corner.state.x);
    if (kObjects > 0) path.objects = ObjectSet(corner.state.y);
#if NEAR > 0
    path.objects = corner.state.yz;
#endif
    return Flight(path, corner.place.w, vec3(0.0), vec3(0.0), 0.0, noHit(0.0));
}

uvec2 wordsOf(ObjectSet objects) {
#if NEAR > 0
    return objects;
#else
    return uvec2(objects, 0u);
#endif
}

FrontCorner cornerOf(Flight flight) {
    return FrontCorner(vec4(flight.path.ray.x, flight.clock), vec4(flight.path.ray.w, flight.path.departs),
                       vec4(flight.path.throughput, 0.0),
                       uvec4(flight.path.status, wordsOf(flight.path.objects), uint(flight.ahead.object)));
}

FrontDepth depthOf(Flight flight) {
    return FrontDepth(vec4(flight.absorbed, flight.extent), vec4(flight.scattered, 0.0));
}

// What goes on from the boundary met, or nothing where that is opaque.
FrontHit hitFrom(inout Flight flight) {
    FrontHit hit;
    hit.onward = vec4(flight.path.ray.w, 0.0);
    hit.back = vec4(0.0);
    hit.mirrored = vec4(0.0, 1.0, 1.0, 1.0);
    hit.after = uvec4(0u);
    if (kObjects > 0 && flight.path.status == kMeets) {
        Interface at = interfaceAt(flight.path.ray, flight.path.objects, flight.ahead);
        hit.after = uvec4(wordsOf(at.objects), 0u, 0u);
        if (kOpaqueObjects && at.here != at.there && isOpaque(at.there)) {
            flight.path.status = kStopped;
        } else if (!isNothing(at)) {
            Outgoing outgoing[kMostOutgoing];
            int rays = scatterAt(at, flight.path.ray.w, flight.path.objects, outgoing);
            hit.onward = vec4(outgoing[0].w, outgoing[0].departs);
            hit.back = vec4(outgoing[1].w, outgoing[1].departs);
            hit.mirrored = vec4(rays > 1 ? outgoing[1].share : 1.0, outgoing[1].tint);
            hit.after.z = 1u;
        }
    }
    hit.end = cornerOf(flight);
    hit.depth = depthOf(flight);
    return hit;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= 4u * params.list.x) return;
    uint corner = 4u * params.list.y + item;
    bool single = patches[corner >> 2u].flux.w == 1.0;
    bool ended = patches[corner >> 2u].state.y == kFrontEnds;
    if (ended || (single && (corner & 3u) != 0u)) return;
    Flight flight = flightFrom(before[corner]);
    fly(flight, params.time.x, kObjects > 0 ? params.time.y : 0.0);
    after[corner] = cornerOf(flight);
    if (kMedium) depths[item] = depthOf(flight);
    if (kMeetsAnything) {
        // A single ray has no other corners to agree with.
        if (!single && mayMeet(flight))
            fly(flight, max(flight.clock, params.time.x) + params.time.y, 0.0);
        hits[item] = hitFrom(flight);
    }
}
