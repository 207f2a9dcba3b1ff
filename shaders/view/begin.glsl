// Where view rays begin: at the camera, with branches that waited, from other domains.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the paths of view/trace.comp.glsl are declared.

Load loadFrom(CameraRay camera, Path path) {
    return Load(vec3(0.0), vec3(0.0), 0, 0.0, 0.0, false, camera.isFirst, vec3(1.0), path, vec3(0.0),
                camera.start, camera.start, camera.start);
}

// A path from the camera, of what its polariser lets through.
Path pathFromCamera(CameraRay camera) {
    Path path = pathFrom(camera.start, camera.direction, params.limits.x);
    if (kCrystals && params.polarizer.w == 1.0) {
        path.polarisation = polarisedAcross(params.polarizer.xyz, camera.direction);
        path.throughput = vec3(0.5);
    }
    return path;
}

// A path into the domain, at the camera's start of it. `n` is the index at the eye, if that is within.
Path enter(CameraRay camera, inout Load load, inout float n) {
    Path path = pathFromCamera(camera);
    path.objects = objectsAt(camera.start, camera.direction, camera.within);
    int region = regionOf(path.objects);
    float entry = indexOf(region, camera.start);
    if (camera.within) n = entry;
    path.ray.w *= entry;
    if (isOpaque(region)) path.status = kStopped; // cut open by the domain's face
    return path;
}

#if DOMAINS == 1
// A ray that comes from another domain. `steps` were made in this launch before, which tell when to rest.
CameraRay arrive(int place, int steps, out Path path, out Load load, out float n) {
    Departure arrival = departures[place];
    atomicAdd(departed.y, 1u);
    isFirst = (arrival.kind.z & kFirstBranch) != 0;
    wasChanged = (arrival.kind.z & kChangedBranch) != 0;
    lengthsBefore = arrival.lengths.xyz - vec3(0.0, 0.0, float(steps));
    vec3 start = clampToDomain(arrival.place.xyz);
    CameraRay camera = CameraRay(start, start, dvec3(start), arrival.direction.xyz, true,
                                 arrival.direction.w == 0.0, isFirst);
    begunAlong = camera.direction;
    n = arrival.direction.w;
    path = pathFrom(camera.start, camera.direction, params.limits.x);
    load = loadFrom(camera, path);
    path = enter(camera, load, n);
    eyeIndex = n;
    path.throughput = arrival.throughput.xyz;
    path.depth = arrival.kind.y;
    path.steps = steps;
    path.mostSteps = steps + params.limits.x;
    load.along = arrival.along.xyz;
    return camera;
}
#endif

// Where a pixel's ray begins: at its camera ray, or with a branch that waits.
CameraRay begin(ivec2 pixel, int rested, bool resumes, out Path path, out Load load, out float n) {
    CameraRay camera = cameraRayOf(pixel);
    camera.isFirst = !resumes;
    if (kGround && camera.hits && !camera.within && isAbove(camera.eye) != isAbove(camera.start)) {
        camera.hits = false; // the ground is before the domain
        camera.start = camera.eye;
    }
    n = outsideIndex(); // at the eye
    path = pathFromCamera(camera);
    load = loadFrom(camera, path);
    bool elsewhere = false; // it meets another domain first
#if DOMAINS == 1
    isFirst = !resumes;
    begunAlong = camera.direction;
    if (!resumes) {
        Ahead ahead = nextDomain(camera.exact, dvec3(camera.direction));
        float ground = kGround ? wayToGround(camera.eye, camera.direction) : -1.0;
        bool before = ahead.domain >= 0 && !(ground >= 0.0 && ground < ahead.way) &&
                      !(camera.hits && distance(camera.start, camera.eye) <= ahead.way);
        if (before) {
            elsewhere = depart(ahead, camera.direction, ahead.way == 0.0 ? 0.0 : n, vec3(1.0), vec3(1.0), 0,
                               kFirstBranch, vec3(0.0));
            camera.hits = false;
            count(kRays, 1u);
        }
    }
#endif
    if (resumes) {
        n = rests[rested].n;
        fetchWaiting(rested);
        follow(path, waiting[--waitingCount]);
        camera.hits = true;
    } else if (camera.hits) {
        path = enter(camera, load, n);
        count(kRays, 1u);
    } else if (!elsewhere) {
        seeBeyond(path, load, camera.direction);
        if (kGround) load.firstPath = path;
    }
#if DOMAINS == 1
    eyeIndex = n;
#endif
    return camera;
}
