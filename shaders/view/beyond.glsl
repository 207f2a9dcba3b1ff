// What a view ray sees beyond the domain: another domain, the ground, what surrounds the scene.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where the paths of view/trace.comp.glsl are declared.

// Whether a pixel's first branch, which began along a direction, is not as if there were nothing. Where no
// gradient acted the direction is the same but for rounding.
bool hasChanged(Path first, Load load, vec3 began) {
    vec3 turned = normalize(first.ray.w) - began;
    return load.interfaces > 0 || first.status == kStopped || dot(turned, turned) > 1.0e-12 ||
           first.throughput != vec3(1.0) || load.light != vec3(0.0);
}

// Whether a path that has left the domain goes on in another one.
bool goesOn(Path path, Load load, vec3 direction) {
#if DOMAINS == 1
    Ahead ahead = nextDomain(dvec3(path.ray.x), dvec3(direction));
    float ground = kGround ? wayToGround(path.ray.x, direction) : -1.0;
    if (ahead.domain < 0 || (ground >= 0.0 && ground < ahead.way)) return false;
    bool first = isFirst && load.first;
    bool changed = first && (wasChanged || hasChanged(path, load, begunAlong));
    vec3 lengths = lengthsBefore + vec3(vec2(path.lengths) * domains.scale.x, float(path.steps));
    return depart(ahead, direction, eyeIndex, path.throughput, load.along, path.depth,
                  (first ? kFirstBranch : 0) | (changed ? kChangedBranch : 0), lengths);
#else
    return false;
#endif
}

// The share of unpolarised light from around the scene that its polariser leaves, as the path takes it.
float polarisedShare(Path path, vec3 direction) {
    if (params.backPolarizer.w == 0.0) return 1.0;
    float along = dot(path.polarisation, polarisedAcross(params.backPolarizer.xyz, direction));
    return 0.5 * (1.0 - dot(path.polarisation, path.polarisation)) + along * along;
}

// What is straight ahead of a path beyond the domain. On the ground it ends, as on any opaque surface.
void seeBeyond(inout Path path, inout Load load, vec3 direction) {
    float way = kGround ? wayToGround(path.ray.x, direction) : -1.0;
    float plateWay = kPlate ? wayToPlate(path.ray.x, direction) : -1.0;
    vec3 seen = vec3(0.0);
    if (kPlate && plateWay >= 0.0 && !(way >= 0.0 && way < plateWay)) {
        seen = plateLight(path.ray.x + plateWay * direction);
        if (kCrystals) seen *= polarisedShare(path, direction);
    } else if (kGround && way >= 0.0) {
        seen = groundLight(path.ray.x, direction, way);
        if (load.first) load.outward = isAbove(path.ray.x) ? ground.plane.xyz : -ground.plane.xyz;
        path.ray.x += way * direction;
        path.status = kStopped;
    } else {
        seen = backgroundLight(direction);
        if (kCrystals) seen *= polarisedShare(path, direction);
    }
    load.sky += path.throughput * seen * outsideWeight();
}
