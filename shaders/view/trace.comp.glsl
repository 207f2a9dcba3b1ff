// Viewing rays: from each pixel backwards through the volume (Sun et al. 2008, §4.5), along curved paths
// where the index varies, by Snell's and Fresnel's laws at sharp boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// At an interface a ray parts. What is refracted is followed first, what is reflected waits: so the first
// branch to end is the one that refracts wherever it can.
#include "shared/bindings.h"
#include "shared/view_params.h"
#include "transport/integrate.glsl"
#include "transport/interface.glsl"
#include "transport/path.glsl"

#if !defined(CHANNELS) || !defined(SOURCE) || !defined(EMISSION) || !defined(MAP) || \
    !defined(AOVS) || !defined(WAITING) || !defined(SURFACES) || !defined(POINTS) || !defined(GROUND)
#error SOURCE must be 0 to 2, CHANNELS, SURFACES 0, 1, 3, EMISSION, MAP, AOVS, POINTS, GROUND 0 or 1, WAITING from 1
#endif
// POINTS: light is known for the points where first branches end.
const bool kDims = CHANNELS > 0;      // something absorbs or scatters
const bool kColour = CHANNELS == 3;   // it does so, or glows, by wavelength
const bool kGlows = SOURCE > 0;       // light is scattered towards the eye; if blurred, or emitted
const bool kAnisotropic = SOURCE == 2; // scattering prefers a direction
const bool kEmission = EMISSION == 1; // something emits; if blurred, beside anisotropic scattering
const bool kMap = MAP == 1;           // an environment map surrounds the scene, not a colour
const bool kAovs = AOVS == 1;         // each ray's path is written, beside its colour
const bool kGround = GROUND == 1;     // an infinite plane goes on beyond the domain

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = kParamsBlock) uniform Params { ViewParams params; };
layout(std430, binding = kColoursBuffer) buffer Colours { vec4 colours[]; };
layout(std430, binding = kPixelPathsBuffer) writeonly buffer Paths { PixelPath paths[]; };
layout(std430, binding = kCountersBuffer) buffer Counters { uvec2 counters[]; };
// All padded by one voxel; the first two and the emission are of blurred media.
layout(binding = kExtinctionUnit) uniform sampler3D extinctions; // grey: (σ_t, source) [1/voxel]
layout(binding = kSourceUnit) uniform sampler3D sources;         // radiance per voxel of length
layout(binding = kDirectionUnit) uniform sampler3D lightDirection; // see meanDirectionAt(); g
layout(binding = kEmissionUnit) uniform sampler3D emission;
layout(binding = kOpacityUnit) uniform sampler3D surfaceOpacity; // opacity, albedo
layout(binding = kFluenceUnit) uniform sampler3D fluence; // [W/m²]

#include "lib/octahedral.glsl"
ivec2 pixelNow; // in the picture
#include "view/environment.glsl"
#include "view/camera_ray.glsl"
#include "view/counters.glsl"
#include "view/surface.glsl"
#include "view/ground.glsl"

// What a pixel's ray has met on all its branches so far.
struct Load {
    vec3 light;     // L/n² from media and surfaces
    vec3 sky;       // L/n² from behind the domain
    int interfaces; // met
    float deep;     // shares dropped because they had met too many interfaces
    float dim;      // shares dropped because nothing worth following was left
    bool trapped;   // some branch
    bool first;     // the first branch is on its way
    vec3 along;     // by what its throughput is more than its own: reflections not followed
    Path firstPath; // where that ended
    vec3 outward;   // normal of the surface it ended on
    vec3 left;      // where it ended, or left the domain
    vec3 clear;     // opaque voxels: the last point known to be outside them
    vec3 inside;    // a point within them, when stopped
};

#include "view/gather.glsl"

const bool kGathers = kDims || kGlows || kEmission;
const bool kSamples = kGathers || kOpaqueVoxels;
const bool kMeasures = kAovs;
const bool kEqualSteps = true;
#include "transport/trace.glsl"

// Branches that wait: a ray's own, in the order they parted.
struct Branch {
    Ray ray;
    vec3 throughput;
    ObjectSet objects;
    int depth;
    float departs;
};
Branch waiting[WAITING];
int waitingCount = 0;

#include "view/rest.glsl"

// The index outside, and what it makes of radiance there.
float outsideIndex() {
    return dispersed(params.medium.x, params.medium.z);
}

float outsideWeight() {
    float n = outsideIndex();
    return kDisperses ? 1.0 / (n * n) : params.medium.w;
}

float stepLimit(Ray ray, float n) {
    return kIntegrator == kEuler ? transport.steps.w / n : transport.steps.x;
}

// Light varies from voxel to voxel; what a region is made of mostly does not.
float pieceLimit(int region, vec3 x, vec3 direction, float n) {
    bool glows = kGlows && (kObjects == 0 || scene.regions[region].scattering.xyz != vec3(0.0));
    return glows || coefficientsVaryIn(region) ? min(transport.steps.w, 1.0) : 1.0e9;
}

void onPiece(inout Path path, inout Load load, Piece piece) {
    if (kOpaqueVoxels && opacityAt(piece.middle) > 0.5) {
        path.status = kStopped;
        path.ray.x = piece.start;
        load.inside = piece.middle;
    } else {
        load.clear = piece.middle;
        if (kGathers)
            gather(path, load, piece.middle, piece.direction, piece.extent, piece.n, piece.region);
    }
}

// A path that ends on an opaque surface of that irradiance, seen through index n.
void land(Path path, inout Load load, vec3 light, vec3 normal, vec3 albedo, float n) {
    load.light += path.throughput * albedo * light * (0.3183098861837907 / (n * n));
    // Where nothing tells, as if it were across the ray.
    if (kAovs && load.first) load.outward = normal == vec3(0.0) ? -normalize(path.ray.w) : normal;
}

// The same on an object, whose coat has an index so many times that of what is before it; 0: it has none.
void landOn(int region, float coat, Path path, inout Load load, vec3 x, vec3 normal, float n) {
    bool isGround = kGround && region == ground.numbers.y;
    vec3 albedo = scene.regions[region].albedo.xyz;
    if (isGround) albedo = groundAlbedoAt(x);
    if (kCoats && coat > 0.0) albedo = albedoUnderCoat(albedo, coat);
    vec3 light = vec3(0.0);
    if (isGround && isAtSide(x)) light = groundIrradianceAt(x);
    else light = irradianceOn(x, normal, load.first);
    land(path, load, light, normal, albedo, n);
}

void onSurface(inout Path path, inout Load load, Interface at) {
    ++load.interfaces;
    bool coated = isCoated(at);
    landOn(at.there, coated ? at.beyond / at.n : 0.0, path, load, at.x, -at.normal,
           coated ? at.beyond : length(path.ray.w));
}

float brightest(vec3 share) {
    return max(share.x, max(share.y, share.z));
}

float meanOf(vec3 share) {
    return (share.x + share.y + share.z) / 3.0;
}

void follow(inout Path path, Branch branch) {
    path.ray = branch.ray;
    path.throughput = branch.throughput;
    path.objects = branch.objects;
    path.depth = branch.depth;
    path.departs = branch.departs;
}

Branch branchOf(Path path, vec3 x, Outgoing ray) {
    return Branch(Ray(x, ray.w), path.throughput * ray.share * ray.tint, ray.objects, path.depth + 1,
                  ray.departs);
}

bool isBrighter(Branch branch, float least) {
    return brightest(branch.throughput) >= least;
}

// Numbers for a rough interface: each pixel, and each interface its rays meet, has two that the pixel's rays go on
// from, so that few of them lie evenly.
void chooseFacet(inout Interface at, int depth, int met) {
    uint pixel = pcgHash(uint(pixelNow.x) ^ pcgHash(uint(pixelNow.y) + pcgHash(uint(depth + 64 * met))));
    vec2 first = vec2(uniformOf(pixel), uniformOf(pcgHash(pixel)));
    at.facetPlace = fract(first + float(params.ray.x) * vec2(0.7548776662466927, 0.5698402909980532));
    at.facetSeed = pcgHash(pixel + uint(params.ray.x));
}

void onInterface(inout Path path, inout Load load, Interface at) {
    ++load.interfaces;
    if (kRoughBoundaries) chooseFacet(at, path.depth, load.interfaces);
    if (path.depth >= params.limits.y) {
        load.deep += meanOf(path.throughput);
        path.status = kDeep;
    } else {
        Outgoing outgoing[kMostOutgoing];
        int rays = scatterAt(at, path.ray.w, path.objects, outgoing);
        // By a constant place, not in a loop: what is read at a variable one lives in memory.
        Branch next = branchOf(path, at.x, outgoing[0]);
        if (rays > 1) {
            // A reflection too dim to follow is not lost: what goes through takes its light along.
            // Dropped, it would add up to darkness where there are many boundaries.
            Branch mirrored = branchOf(path, at.x, outgoing[1]);
            if (isBrighter(mirrored, params.medium.y) && waitingCount < WAITING) waiting[waitingCount++] = mirrored;
            else {
                vec3 both = next.throughput + mirrored.throughput;
                if (kAovs && load.first) load.along *= both / max(next.throughput, vec3(1.0e-30));
                next.throughput = both;
            }
        }
        if (!isBrighter(next, params.medium.y * params.medium.y)) { // dimmed by what it went through
            load.dim += meanOf(next.throughput);
            path.status = kFaded;
        }
        follow(path, next);
    }
}

// To where opaque voxels begin, between the last point outside them and the one inside.
void reachVoxels(inout Path path, inout Load load) {
    vec3 inside = opaqueBetween(load.clear, load.inside);
    float n = length(path.ray.w);
    vec3 direction = path.ray.w / n;
    float extent = max(dot(inside - path.ray.x, direction), 0.0);
    if (kGathers)
        gather(path, load, 0.5 * (path.ray.x + inside), direction, extent, n, 0);
    if (kMeasures) path.lengths += dvec2(extent * n, extent);
    path.ray.x = inside;
    vec3 normal = opaqueNormalAt(inside);
    land(path, load, irradianceOn(inside, normal, load.first), normal, opaqueAlbedoAt(inside, normal), n);
}

// What is straight ahead of a path beyond the domain. On the ground it ends, as on any opaque surface.
void seeBeyond(inout Path path, inout Load load, vec3 direction) {
    float way = kGround ? wayToGround(path.ray.x, direction) : -1.0;
    vec3 seen = vec3(0.0);
    if (kGround && way >= 0.0) {
        seen = groundLight(path.ray.x, direction, way);
        if (load.first) load.outward = isAbove(path.ray.x) ? ground.plane.xyz : -ground.plane.xyz;
        path.ray.x += way * direction;
        path.status = kStopped;
    } else {
        seen = backgroundLight(direction);
    }
    load.sky += path.throughput * seen * outsideWeight();
}

bool onEnd(inout Path path, inout Load load) {
    if (path.status == kAlive) path.status = kTrapped;
    if (kOpaqueVoxels && path.status == kStopped) reachVoxels(path, load);
    bool escapes = path.status == kLeft;
    bool traps = path.status == kTrapped;
    if (kGround && load.first) load.left = path.ray.x;
    // What goes on no further sees what is straight ahead: a guess by which clear scenes stay clear.
    if (escapes || traps || (kObjects > 0 && path.status == kDeep))
        seeBeyond(path, load, normalize(path.ray.w));
    load.trapped = traps || load.trapped;
    if (load.first) load.firstPath = path;
    load.first = false;
    bool more = kObjects > 0 && waitingCount > 0 && !isToRest(path.steps);
    if (more) {
        follow(path, waiting[--waitingCount]);
        path.status = kAlive;
        path.mostSteps = path.steps + params.limits.x;
    }
    return more;
}

void countPath(Path path, Load load) {
    count(kSteps, uint(path.steps));
    // A ray that found no place to rest may have been cut off.
    if (load.trapped || (kObjects > 0 && waitingCount > 0 && restAt < 0)) count(kTrappedRays, 1u);
    if (kObjects > 0) {
        count(kInterfaces, uint(load.interfaces));
        countShare(kDroppedByDepth, load.deep);
        countShare(kDroppedAsDim, load.dim);
    }
    if (kIntegrator == kAdaptive) noteError(errorOf(path.error, path.steps));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool resumes = kObjects > 0 && params.limits.z > 0;
    ivec2 size = params.picture.xw;
    if (resumes) size = ivec2(min(params.limits.z, rests.length() / 2), 1);
    if (any(greaterThanEqual(pixel, size))) return;
    int at = pixel.y * params.picture.x + pixel.x;
    int rested = 0; // of a ray at rest, where
    if (resumes) {
        rested = firstOfHalf(params.limits.w) + at;
        at = rests[rested].at;
        pixel = ivec2(at % params.picture.x, at / params.picture.x);
    }
    pixel.y += params.picture.z;
    pixelNow = pixel;

    CameraRay camera = cameraRayOf(pixel);
    if (kGround && camera.hits && !camera.within && isAbove(camera.eye) != isAbove(camera.start)) {
        camera.hits = false; // the ground is before the domain
        camera.start = camera.eye;
    }
    Path path = pathFrom(camera.start, camera.direction, params.limits.x);
    Load load = Load(vec3(0.0), vec3(0.0), 0, 0.0, 0.0, false, !resumes, vec3(1.0), path, vec3(0.0),
                     camera.start, camera.start, camera.start);
    vec3 white = vec3(1.0); // the share of white light that this ray sees
    if (kDisperses) white = takeLine(lineOf(pixel) + uint(params.ray.y));
    float n = outsideIndex(); // at the eye
    if (resumes) { // branches of a ray at rest
        n = rests[rested].n;
        fetchWaiting(rested);
        follow(path, waiting[--waitingCount]);
        camera.hits = true;
    } else if (camera.hits) {
        path.objects = objectsAt(camera.start, camera.direction, camera.within);
        int region = regionOf(path.objects);
        float entry = indexOf(region, camera.start);
        if (camera.within) n = entry;
        path.ray.w *= entry;
        if (isOpaque(region)) { // cut open by the domain's face
            path.status = kStopped;
            landOn(region, 0.0, path, load, camera.start, faceNormal(camera.start), n);
        }
        count(kRays, 1u);
    } else {
        seeBeyond(path, load, camera.direction);
        if (kGround) load.firstPath = path;
    }
    if (camera.hits) {
        trace(path, load);
        countPath(path, load);
        if (restAt >= 0) rest(n, at);
    }
    vec3 light = (load.light + load.sky) * (n * n);
    if (kDisperses) light *= white;
    if (resumes) {
        colours[at] += params.weight * vec4(light, 0.0);
        return;
    }
    Path first = load.firstPath;
    vec3 direction = normalize(first.ray.w);
    vec3 turned = direction - camera.direction;
    bool stopped = first.status == kStopped;
    // Where no gradient acted the direction is the same but for rounding.
    bool changed = load.interfaces > 0 || stopped || dot(turned, turned) > 1.0e-12 ||
                   first.throughput != vec3(1.0) || load.light != vec3(0.0);
    putColour(at, vec4(light, changed ? 1.0 : 0.0));
    if (kAovs && params.pattern.z == 1.0) {
        PixelPath found;
        found.place = vec4(first.ray.x, first.lengths.x);
        found.direction = vec4(direction, first.lengths.y);
        found.through = vec4(stopped ? vec3(0.0) : first.throughput / load.along, float(first.steps));
        float atExit = camera.hits ? indexOf(regionOf(first.objects), kGround ? load.left : first.ray.x) : 1.0;
        vec2 outward = stopped ? octahedralOf(load.outward) : vec2(0.0);
        found.error = vec4(abs(length(first.ray.w) - atExit), stopped ? 1.0 : 0.0, outward);
        paths[at] = found;
    }
}
