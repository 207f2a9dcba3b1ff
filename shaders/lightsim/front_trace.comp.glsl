// Corners of a wavefront's patches through a step of time: dx/dt = w/n², dw/dt = ∇n/n (Ihrke et al. 2007,
// eqs 12–13), which is a step of the Hamiltonian form with dt = n² dτ.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A work item carries one corner. The clock is the optical path length. Before they enter the domain and
// behind it corners propagate straight on, so that a patch is whole until all of it has left. Where there are
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

// The path of a corner through a step.
struct CornerPath {
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
void enterDomain(inout CornerPath corner, vec3 direction) {
    corner.path.ray.x = clampToDomain(corner.path.ray.x);
    corner.path.objects = kObjects > 0 ? objectsAt(corner.path.ray.x, direction, params.time.z == 1.0)
                                       : corner.path.objects;
    int region = regionOf(corner.path.objects);
    // Steps keep |w| at n; one look-up tells where to begin, a device walks this branch every time.
    bool steps = kIntegrator == kVerlet && kField == 1 && indexVariesIn(region);
    float n = steps ? fieldAt(corner.path.ray.x).w : indexOf(region, corner.path.ray.x);
    corner.path.ray.w = n * direction;
    corner.path.status = isOpaque(region) ? kStopped : kAlive;
}

// Towards the domain, where it begins within the time.
void propagateToDomain(inout CornerPath corner, float until) {
    float n = length(corner.path.ray.w);
    vec3 direction = corner.path.ray.w / n;
    vec2 span = boxSpan(corner.path.ray.x, direction, vec3(-0.5), highCorner());
    float left = max(until - corner.clock, 0.0) / n;
    float way = max(span.x, 0.0);
    bool enters = span.x < span.y && span.y > 0.0 && way <= left;
    way = enters ? way : left;
    corner.path.ray.x += way * direction;
    corner.clock += n * way;
    if (enters) enterDomain(corner, direction);
    else if (span.x >= span.y || span.y <= 0.0) corner.path.status = kLeft;
}

// A piece of the way dims the corner.
void dim(inout CornerPath corner, vec3 start, vec3 direction, float extent, float n) {
    if (!kMedium) return;
    Extinction medium = extinctionOf(pieceFrom(start, direction, extent, n, regionOf(corner.path.objects)), kUnsplit);
    vec3 absorbed = extent * medium.absorbed;
    vec3 scattered = extent * medium.scattered;
    corner.absorbed += absorbed;
    corner.scattered += scattered;
    vec3 depth = absorbed + scattered;
    corner.path.throughput.x *= attenuationOf(depth.x).through;
    if (kColour) {
        corner.path.throughput.y *= attenuationOf(depth.y).through;
        corner.path.throughput.z *= attenuationOf(depth.z).through;
    }
}

// The first opaque voxel on a piece stops the corner there.
void stopAtVoxels(inout CornerPath corner, vec3 start, vec3 end) {
    if (!kOpaqueVoxels) return;
    float looks = max(ceil(length(end - start) / kOpaqueLook), 1.0);
    for (float i = 1.0; i <= looks && corner.path.status == kAlive; i += 1.0) {
        vec3 x = mix(start, end, i / looks);
        if (isOutside(x)) break;
        if (texelFetch(opaque, ivec3(x + 0.5), 0).x != 0u) {
            corner.path.status = kStopped;
            corner.path.ray.x = x;
        }
    }
}

// Straight on behind the domain. Media dim a corner as its neighbours still inside.
void propagateBehindDomain(inout CornerPath corner, float until) {
    float n = length(corner.path.ray.w);
    float way = max(until - corner.clock, 0.0) / n;
    dim(corner, corner.path.ray.x, corner.path.ray.w / n, way, n);
    corner.path.ray.x += (way / n) * corner.path.ray.w;
    corner.clock += n * way;
    corner.extent += way;
}

// How far a corner may propagate straight before the medium is looked up again [voxel].
float straightPiece(int region) {
    return kOpaqueVoxels || (kMedium && coefficientsVaryIn(region)) ? kLongest : 1.0e9;
}

// Through an index that does not vary. `reach` is how far boundaries are looked for.
void propagateStraight(inout CornerPath corner, int region, float until, float reach) {
    float n = indexOf(region, corner.path.ray.x);
    vec3 direction = corner.path.ray.w / n;
    float face = timeToFace(corner.path.ray.x, direction);
    float wanted = (until - corner.clock) / n;
    if (kObjects > 0 && corner.ahead.object < 0 && corner.ahead.s < min(wanted, face)) {
        float seen = min(face, wanted + reach / n);
        corner.ahead = intersectStraight(corner.path.ray.x, direction, seen, corner.path.objects,
                                         corner.path.departs);
    }
    bool meets = kObjects > 0 && corner.ahead.object >= 0 && corner.ahead.s <= wanted;
    float way = meets ? corner.ahead.s : wanted;
    float piece = straightPiece(region);
    if (way > piece) {
        way = piece;
        meets = false;
    }
    vec3 start = corner.path.ray.x;
    float within = min(way, face);
    dim(corner, start, direction, way, n);
    corner.path.ray.x = start + way * direction;
    corner.clock += n * way;
    corner.extent += way;
    corner.ahead.s -= way;
    if (way > 0.0) corner.path.departs = 0.0;
    stopAtVoxels(corner, start, start + within * direction);
    if (corner.path.status == kAlive) corner.path.status = meets ? kMeets : way > face ? kLeft : kAlive;
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
Hit hitOf(inout CornerPath corner, inout Step made, inout float tau) {
    Segment segment = curvedSegment(corner.path.ray, made.end, tau);
    Hit hit = noHit(segment.extent);
    if (freeBy(abs(clearanceAt(corner.path.ray.x))) >= segment.extent) return hit;
    float face = isOutside(made.end.x) ? shareInside(corner.path.ray, made.end, tau) : 1.0;
    hit = intersect(segment, corner.path.objects, corner.path.departs);
    if (hit.object >= 0 && !isBeforeFace(hit, pointOn(segment, hit.s), hit.s - face * segment.extent))
        hit.object = -1;
    if (hit.object >= 0) {
        tau *= max(min(hit.s / segment.extent, face), 1.0e-6);
        made = stepOf(corner.path.ray, tau);
        vec4 found = distanceAt(hit.object, made.end.x);
        vec3 direction = normalize(made.end.w);
        float slope = dot(found.xyz, direction);
        if (abs(found.w) < 0.1 * abs(slope)) made.end.x -= (found.w / slope) * direction;
        hit.gradient = found.xyz;
    }
    return hit;
}

// A step through an index that varies.
void propagateBent(inout CornerPath corner, int region, float until) {
    Ray start = corner.path.ray;
    float n2 = dot(start.w, start.w);
    float longest = min(transport.steps.w, kLongest);
    float tau = min((until - corner.clock) / n2, longest * inversesqrt(n2));
    Step made = goodStep(start, tau);
    Hit hit = noHit(0.0);
    if (kObjects > 0) hit = hitOf(corner, made, tau);
    float optical = opticalOf(start, made);
    float extent = sqrt(abs(optical * tau));
    Ray middle = between(start, made.end, tau, 0.5);
    float n = length(middle.w);
    dim(corner, middle.x - (0.5 * extent / n) * middle.w, middle.w / n, extent, n);
    corner.path.ray = made.end;
    corner.clock += optical;
    corner.extent += extent;
    corner.path.departs = 0.0;
    stopAtVoxels(corner, start.x, made.end.x);
    if (corner.path.status != kAlive) return;
    if (kObjects > 0 && hit.object >= 0) {
        corner.ahead = hit;
        corner.path.status = kMeets;
    } else if (isOutside(made.end.x)) {
        corner.path.status = kLeft;
    }
}

// Until the clock says so, or a boundary is met. `reach` is how far those are looked for.
void propagate(inout CornerPath corner, float until, float reach) {
    if (corner.path.status == kNone && until - corner.clock > kLate) propagateToDomain(corner, until);
    for (int i = 0; i < kMostRounds && corner.path.status == kAlive && until - corner.clock > kLate; ++i) {
        int region = regionOf(corner.path.objects);
        if (indexVariesIn(region)) propagateBent(corner, region, until);
        else propagateStraight(corner, region, until, reach);
    }
    if (corner.path.status == kLeft) propagateBehindDomain(corner, until);
}

// Whether there may be a boundary within reach beyond the step.
bool mayMeet(CornerPath corner) {
    if (kObjects == 0) return true;
    return corner.path.status == kNone ||
           freeBy(abs(clearanceAt(corner.path.ray.x))) * length(corner.path.ray.w) < params.time.y;
}

CornerPath pathOf(FrontCorner from) {
    Path path = pathFrom(from.place.xyz, from.wave.xyz, 0);
    path.departs = from.wave.w;
    path.throughput = from.weight.xyz;
    path.status = int(from.state.x);
    if (kObjects > 0) path.objects = ObjectSet(from.state.y);
#if NEAR > 0
    path.objects = from.state.yz;
#endif
    return CornerPath(path, from.place.w, vec3(0.0), vec3(0.0), 0.0, noHit(0.0));
}

uvec2 wordsOf(ObjectSet objects) {
#if NEAR > 0
    return objects;
#else
    return uvec2(objects, 0u);
#endif
}

FrontCorner cornerOf(CornerPath corner) {
    return FrontCorner(vec4(corner.path.ray.x, corner.clock), vec4(corner.path.ray.w, corner.path.departs),
                       vec4(corner.path.throughput, 0.0),
                       uvec4(corner.path.status, wordsOf(corner.path.objects), uint(corner.ahead.object)));
}

FrontDepth depthOf(CornerPath corner) {
    return FrontDepth(vec4(corner.absorbed, corner.extent), vec4(corner.scattered, 0.0));
}

// What goes on from the boundary met, or nothing where that is opaque.
FrontHit hitFrom(inout CornerPath corner) {
    FrontHit hit;
    hit.onward = vec4(corner.path.ray.w, 0.0);
    hit.back = vec4(0.0);
    hit.mirrored = vec4(0.0, 1.0, 1.0, 1.0);
    hit.after = uvec4(0u);
    if (kObjects > 0 && corner.path.status == kMeets) {
        Interface at = interfaceAt(corner.path, corner.ahead);
        hit.after = uvec4(wordsOf(at.objects), 0u, 0u);
        if (kOpaqueObjects && at.here != at.there && isMatt(at.there)) {
            corner.path.status = kStopped;
        } else if (!isNothing(at)) {
            Outgoing outgoing[kMostOutgoing];
            int rays = scatterAt(at, corner.path.ray.w, corner.path.objects, outgoing);
            hit.onward = vec4(outgoing[0].w, outgoing[0].departs);
            hit.back = vec4(outgoing[1].w, outgoing[1].departs);
            hit.mirrored = vec4(rays > 1 ? outgoing[1].share : 1.0, outgoing[1].tint);
            hit.after.z = 1u;
        }
    }
    hit.end = cornerOf(corner);
    hit.depth = depthOf(corner);
    return hit;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= 4u * params.list.x) return;
    takeLine(0u);
    uint number = 4u * params.list.y + item;
    bool single = patches[number >> 2u].flux.w == 1.0;
    bool ended = patches[number >> 2u].state.y == kFrontEnds;
    if (ended || (single && (number & 3u) != 0u)) return;
    CornerPath corner = pathOf(before[number]);
    propagate(corner, params.time.x, kObjects > 0 ? params.time.y : 0.0);
    after[number] = cornerOf(corner);
    if (kMedium) depths[item] = depthOf(corner);
    if (kMeetsAnything) {
        // A single ray has no other corners to agree with.
        if (!single && mayMeet(corner))
            propagate(corner, max(corner.clock, params.time.x) + params.time.y, 0.0);
        hits[item] = hitFrom(corner);
    }
}
