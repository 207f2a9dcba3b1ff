// What an opaque surface reflects of a photon: by Lambert's law, weighed by the albedo.
// SPDX-License-Identifier: GPL-3.0-or-later

// Corners of voxels whose middles are behind a plane reach so far off it [voxel].
const float kCorner = 0.87;
const float kStep = 0.75;
const int kMostSteps = 24;

// Where a ray that starts on a surface is free of its opaque voxels, whose corners would shade it: photons stop at
// those. Before that just in what is opaque itself. Nothing receives light on that way.
vec3 freeOfVoxels(vec3 x, vec3 outward, vec3 direction) {
    float slope = dot(direction, outward);
    bool within = true;
    for (int i = 1; within && i <= kMostSteps; ++i) {
        x = clampToDomain(x + kStep * direction);
        if (opacityAt(x) > 0.5) break;
        ivec3 voxel = clamp(ivec3(floor(x + 0.5)), ivec3(0), params.size.xyz - 1);
        within = float(i) * kStep * slope < kCorner || texelFetch(opaque, voxel, 0).x != 0u;
    }
    return x;
}

// What the next bounce would have sent on of a photon that has had its last one.
vec3 leftOver(Path path, Load load) {
    if (load.bounces < int(params.depth.z)) return vec3(0.0);
    return load.albedo * (kColour ? path.throughput : path.throughput.xxx);
}

// A photon that has landed goes on, if it may, with what is reflected.
void bounce(inout Path path, inout Load load) {
    if (load.bounces >= int(params.depth.z) || load.outward == vec3(0.0)) return;
    vec3 sent = path.throughput * load.albedo;
    load.absorbed += path.throughput - sent;
    path.throughput = sent;
    ++load.bounces;
    vec3 direction = lambertAbout(load.outward, load.id, load.bounces, params.depth.y);
    path.ray.w = length(path.ray.w) * direction;
    path.mode = kUnsplit;
    path.polarisation = vec3(0.0);
    int region = regionOf(path.objects);
    if (isCrystal(region)) { // what is in contact with one: one of its waves, by chance
        path.mode = (pcgHash(load.id + uint(load.bounces)) & 1u) == 0u ? kOrdinary : kExtraordinary;
        path.ray.w = waveVector(uniaxialOf(region, path.ray.x), path.mode, direction);
    }
    path.departs = dot(direction, load.outward);
    if (kOpaqueVoxels) path.ray.x = freeOfVoxels(path.ray.x, load.outward, direction);
    path.status = kAlive;
    fade(path);
}
