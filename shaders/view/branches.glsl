// What becomes of a view ray at an interface: it goes on as its first branch, the others wait.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the paths of view/trace.comp.glsl are declared.

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
#if CRYSTALS > 0
    path.mode = branch.mode;
    path.polarisation = branch.polarisation;
#endif
}

Branch branchOf(Path path, vec3 x, Outgoing ray) {
    return Branch(Ray(x, ray.w), path.throughput * ray.share * ray.tint, ray.objects, path.depth + 1,
                  ray.departs
#if CRYSTALS > 0
                  , ray.mode, ray.polarisation
#endif
    );
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

// A reflection too dim to follow is not lost: what goes on first takes its light along. Dropped, it would add up to
// darkness where there are many boundaries.
void letWait(Path path, inout Load load, inout Branch next, Branch other) {
    if (isBrighter(other, params.medium.y) && waitingCount < WAITING) waiting[waitingCount++] = other;
    else {
        vec3 both = next.throughput + other.throughput;
        if (kAovs && load.first) load.along *= both / max(next.throughput, vec3(1.0e-30));
        next.throughput = both;
    }
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
        if (kCrystals) // the last first, so that what goes on is taken up before what comes back
            for (int i = rays - 1; i > 1; --i) letWait(path, load, next, branchOf(path, at.x, outgoing[i]));
        if (rays > 1) letWait(path, load, next, branchOf(path, at.x, outgoing[1]));
        if (!isBrighter(next, params.medium.y * params.medium.y)) { // dimmed by what it went through
            load.dim += meanOf(next.throughput);
            path.status = kFaded;
        }
        follow(path, next);
    }
}
