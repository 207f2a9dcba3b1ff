// What an opaque surface reflects of a photon: by Lambert's law, weighed by the albedo.
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a point is out of opaque voxels, or can be put there: photons stop on their faces.
bool isPutOutside(inout vec3 x, vec3 outward) {
    if (!kOpaqueVoxels) return true;
    bool within = true;
    for (int i = 0; i < 5 && within; ++i) {
        ivec3 voxel = clamp(ivec3(floor(x + 0.5)), ivec3(0), params.size.xyz - 1);
        within = texelFetch(opaque, voxel, 0).x != 0u;
        if (within) x = clampToDomain(x + 0.5 * outward);
    }
    return !within;
}

// A photon that has landed goes on, if it may, with what is reflected.
void bounce(inout Path path, inout Load load) {
    if (load.bounces >= int(params.depth.z) || load.outward == vec3(0.0)) return;
    if (!isPutOutside(path.ray.x, load.outward)) return;
    vec3 sent = path.throughput * load.albedo;
    load.absorbed += path.throughput - sent;
    path.throughput = sent;
    ++load.bounces;
    vec3 direction = lambertAbout(load.outward, load.id, params.depth.y ^ uint(load.bounces) << 8u);
    path.ray.w = length(path.ray.w) * direction;
    path.departs = dot(direction, load.outward);
    path.status = kAlive;
    fade(path);
}
