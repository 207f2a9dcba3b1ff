// A view ray from its start to its end, and what is kept of it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the paths of view/trace.comp.glsl are declared.

void countPath(Path path, Load load, int stepsBefore) {
    count(kSteps, uint(path.steps - stepsBefore));
    // A ray that found no place to rest may have been cut off.
    if (load.trapped || (kObjects > 0 && waitingCount > 0 && restAt < 0)) count(kTrappedRays, 1u);
    if (kObjects > 0) {
        count(kInterfaces, uint(load.interfaces));
        countShare(kDroppedByDepth, load.deep);
        countShare(kDroppedAsDim, load.dim);
    }
    if (kIntegrator == kAdaptive) noteError(errorOf(path.error, path.steps));
}

// What a ray adds to its pixel.
struct Seen {
    vec3 light;
    bool changed; // see hasChanged()
};

// Traces a ray, and writes the path of its pixel's first branch.
Seen look(CameraRay camera, inout Path path, inout Load load, float n, int at, int stepsBefore) {
    if (camera.hits) {
        trace(path, load);
        countPath(path, load, stepsBefore);
        if (restAt >= 0) rest(n, at);
    }
    Path first = load.firstPath;
    bool changed = hasChanged(first, load, camera.direction);
    if (kAovs && params.pattern.z == 1.0 && camera.isFirst) {
        bool stopped = first.status == kStopped;
        PixelPath found;
        vec3 before = vec3(0.0);
        float domain = 0.0;
#if DOMAINS == 1
        before = vec3(lengthsBefore.xy / domains.scale.x, lengthsBefore.z);
        domain = float(domains.numbers.x);
#endif
        found.place = vec4(first.ray.x, float(first.lengths.x) + before.x);
        found.direction = vec4(normalize(first.ray.w), float(first.lengths.y) + before.y);
        found.through = vec4(stopped ? vec3(0.0) : first.throughput / load.along, float(first.steps) + before.z);
        float atExit = camera.hits ? indexOf(regionOf(first.objects), kGround ? load.left : first.ray.x) : 1.0;
        vec2 outward = stopped ? octahedralOf(load.outward) : vec2(0.0);
        found.error = vec4(abs(length(first.ray.w) - atExit), (stopped ? 1.0 : 0.0) + 2.0 * domain, outward);
        paths[at] = found;
    }
    return Seen((load.light + load.sky) * (n * n), changed);
}
