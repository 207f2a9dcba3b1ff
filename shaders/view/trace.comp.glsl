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
    !defined(AOVS) || !defined(WAITING) || !defined(SURFACES) || !defined(POINTS) || !defined(GROUND) || \
    !defined(PLATE) || !defined(DOMAINS)
#error SOURCE must be 0 to 2, CHANNELS, SURFACES 0, 1, 3, EMISSION, MAP, AOVS, POINTS, GROUND, PLATE, DOMAINS \
0 or 1, WAITING from 1
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
const bool kPlate = PLATE == 1;       // a picture stands behind the scene
const bool kDomains = DOMAINS == 1;   // there are several

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
#if DOMAINS == 1
vec3 begunAlong = vec3(0.0); // the ray, in this domain
#endif
#include "view/background.glsl"
#include "view/camera_ray.glsl"
#include "view/counters.glsl"
#include "view/surface.glsl"
#include "view/ground.glsl"
#include "view/plate.glsl"
#include "view/domains.glsl"

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
#if CRYSTALS > 0
    int mode;
    vec3 polarisation;
#endif
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

#include "view/branches.glsl"

// To where opaque voxels begin, between the last point outside them and the one inside. That may lie before
// the path's end, since a piece is gathered whole whose middle is outside them: then a way of less than 0 takes
// back what is too much.
void reachVoxels(inout Path path, inout Load load) {
    vec3 inside = opaqueBetween(load.clear, load.inside);
    float n = length(path.ray.w);
    vec3 direction = path.ray.w / n;
    float extent = dot(inside - path.ray.x, direction);
    if (kGathers)
        gather(path, load, 0.5 * (path.ray.x + inside), direction, extent, n, 0);
    if (kMeasures) path.lengths += dvec2(extent * n, extent);
    path.ray.x = inside;
    vec3 normal = opaqueNormalAt(inside);
    land(path, load, irradianceOn(inside, normal, load.first), normal, opaqueAlbedoAt(inside, normal), n);
}

#include "view/beyond.glsl"

bool onEnd(inout Path path, inout Load load) {
    if (path.status == kAlive) path.status = kTrapped;
    if (kOpaqueVoxels && path.status == kStopped) reachVoxels(path, load);
    bool escapes = path.status == kLeft;
    bool traps = path.status == kTrapped;
    if (kGround && load.first) load.left = path.ray.x;
    // What goes on no further sees what is straight ahead: a guess by which clear scenes stay clear.
    if (kDomains && escapes) escapes = !goesOn(path, load, normalize(path.ray.w));
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

#include "view/look.glsl"
#include "view/begin.glsl"

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
    vec3 white = vec3(1.0); // the share of white light that this ray sees
    if (kDisperses) white = takeLine(lineOf(pixel) + uint(params.ray.y));
    bool arrives = false;
    int place = -1;
#if DOMAINS == 1
    stripPixel = at;
    arrives = domains.numbers.z == 1 && !resumes;
    if (arrives) {
        place = pending[at] - 1;
        pending[at] = 0;
        place = arrivalFrom(place, true);
        if (place < 0) return;
    }
#endif

    int steps = 0;
    bool more = true;
    while (more) {
        CameraRay camera;
        Path path;
        Load load;
        float n = 1.0;
        int next = -1;
#if DOMAINS == 1
        if (arrives) {
            next = departures[place].kind.w;
            camera = arrive(place, steps, path, load, n);
        } else
#endif
        camera = begin(pixel, rested, resumes, path, load, n);
        if (kOpaqueObjects && camera.hits && !resumes && path.status == kStopped)
            landOn(regionOf(path.objects), 0.0, path, load, camera.start, faceNormal(camera.start), n);
        Seen seen = look(camera, path, load, n, at, steps);
        if (kDisperses) seen.light *= white;
        float coverage = seen.changed ? 1.0 : 0.0;
        more = false;
#if DOMAINS == 1
        if (arrives) {
            if (!isFirst || wasChanged) coverage = 0.0;
            steps = path.steps;
            place = arrivalFrom(next, restAt < 0);
            more = place >= 0;
        }
#endif
        if (resumes) coverage = 0.0;
        if (resumes || arrives) colours[at] += params.weight * vec4(seen.light, coverage);
        else putColour(at, vec4(seen.light, coverage));
    }
}
