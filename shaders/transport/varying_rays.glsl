// How a path goes through a crystal that varies: e-rays, and all rays where n_o varies.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the functions that an entry file answers are declared.

#if CRYSTALS == 2
// Whether light of a mode has a curved way there.
bool bendsIn(int region, int mode) {
    return crystalVaries(region) && (mode == kExtraordinary || bendsOrdinary(region));
}

// Both waves together over a step from `start`, whose way turns a little: what f is by goes along, across it.
void turnOnStep(inout Path path, int region, Ray start) {
    vec3 along = path.ray.x - start.x;
    vec3 d = along / max(length(along), 1.0e-20);
    vec3 before = normalize(start.w);
    vec3 behind = normalize(path.ray.w);
    vec3 f = acrossOf(before);
    path.polarisation = polarisedBy(path.polarisation, f, cross(f, before), acrossOf(d));
    path.polarisation = polarisedAlong(region, path.polarisation, start.x, along, path.steps);
    f = acrossOf(d);
    path.polarisation = polarisedBy(path.polarisation, f, cross(f, d), acrossOf(behind));
}

// To the next interface, in steps of a voxel or what is asked for. The last one, which meets it, is made again.
Hit propagateVarying(inout Path path, inout Load load, int region) {
    const float kLongest = 1.0; // [voxel]
    const int kLooks = 4;       // of a step, as software devices count
    bool extraordinary = path.mode == kExtraordinary;
    float longest = min(transport.steps.w, kLongest);
    Hit hit = noHit(0.0);
    float share = 1.0; // of a step
    bool ends = false;
    bool going = true;
    Flow first = flowOf(varyingCrystalAt(region, path.ray.x, path.ray.w), extraordinary, path.ray.w);
    while (going) {
        Ray start = path.ray;
        float tau = share * longest / length(first.x);
        VaryingStep made = varyingStep(region, extraordinary, start.x, start.w, first, tau);
        Flow change = made.change;
        Flow last = made.last;
        path.steps += kLooks;
        bool again = false;
        if (!ends) {
            Segment segment = curvedSegment(Ray(start.x, first.x), Ray(start.x + change.x, last.x), tau);
            if (freeOf(path) < segment.extent) {
                hit = intersect(segment, path.objects, path.departs);
                path.steps += hit.looks;
                ends = hit.object >= 0;
                if (ends) share = hit.s / segment.extent;
                again = ends && share > 0.0;
            }
        }
        if (!again && share > 0.0) {
            float extent = length(change.x);
            if (kSamples)
                onPiece(path, load, Piece(start.x, change.x, start.x + 0.5 * change.x, change.x / max(extent, 1.0e-20),
                                          extent, first.o, region));
            if (kMeasures) path.lengths += dvec2(dot(start.w + 0.5 * change.k, change.x), extent);
            if (path.status != kStopped) goOn(path.ray, path.lost, Ray(change.x, change.k));
            if (path.mode == kTogether) turnOnStep(path, region, start);
            first = last;
        }
        if (!again) path.departs = 0.0;
        if (isOutside(path.ray.x)) path.status = kLeft; // no crystal comes to a face
        going = again || (!ends && path.status == kAlive && path.steps < path.mostSteps);
    }
    if (path.status != kAlive) hit.object = -1;
    if (hit.object >= 0) { // a last step of Newton's
        vec4 found = distanceAt(hit.object, path.ray.x);
        vec3 direction = first.x / length(first.x);
        float slope = dot(found.xyz, direction);
        if (abs(found.w) < 0.1 * abs(slope)) path.ray.x -= (found.w / slope) * direction;
        hit.gradient = found.xyz;
    }
    return hit;
}
#endif
