// What a viewing ray gathers within an object, or around them all.
// SPDX-License-Identifier: GPL-3.0-or-later

// A piece of length ds [voxel] round x.
void gatherPiece(inout Seen seen, inout Branch branch, int region, vec3 x, vec3 direction, float n,
                 float ds) {
    Coefficients medium = coefficientsAt(region, x);
    vec3 sigma = medium.absorption + medium.scattering;
    vec3 shine = kEmission ? medium.emission : vec3(0.0);
    if (kShines) {
        vec3 at = coordinate(x);
        float phase = kIsotropicPhase;
        if (kLobes) {
            // One lobe round the mean direction; its length m makes the first moment right as g m.
            vec3 lobe = textureLod(lobes, at, 0.0).xyz;
            float m = length(lobe);
            float cosine = m > 0.0 ? -dot(lobe, direction) / m : 0.0;
            phase = henyeyGreenstein(medium.g * min(m, 1.0), cosine);
        }
        shine += medium.scattering * textureLod(fluence, at, 0.0).xyz * phase;
    }
    vec3 depth = sigma * ds;
    Attenuation red = attenuationOf(depth.x);
    Attenuation green = attenuationOf(depth.y);
    Attenuation blue = attenuationOf(depth.z);
    vec3 gained = branch.through * vec3(red.mean, green.mean, blue.mean) * shine * (ds / (n * n));
    seen.light += gained;
    seen.lit = seen.lit || gained != vec3(0.0);
    branch.through *= vec3(red.through, green.through, blue.through);
}

// A straight piece. Light varies from voxel to voxel; what a region is made of mostly does not.
void gatherStraight(inout Seen seen, inout Branch branch, int region, vec3 direction, float n,
                    float ds) {
    bool scatters = kShines && surfaces.regions[region].scattering.xyz != vec3(0.0);
    int pieces = scatters || variesIn(region) ? max(int(ceil(ds)), 1) : 1;
    float piece = ds / float(pieces);
    for (int i = 0; i < pieces; ++i)
        gatherPiece(seen, branch, region, branch.ray.x + ((float(i) + 0.5) * piece) * direction,
                    direction, n, piece);
}

// Outward, at a point on a face of the domain.
vec3 faceNormal(vec3 x) {
    vec3 halves = 0.5 * vec3(params.size.xyz);
    vec3 off = x + 0.5 - halves;
    vec3 left = halves - abs(off);
    float least = min(left.x, min(left.y, left.z));
    return left.x == least   ? vec3(sign(off.x), 0.0, 0.0)
           : left.y == least ? vec3(0.0, sign(off.y), 0.0)
                             : vec3(0.0, 0.0, sign(off.z));
}

// Light leaving an opaque object's surface towards the eye: a Lambertian reflector under the stored
// light. Of fluence φ the part m is a beam along the mean direction, the rest comes from all sides
// and gives an irradiance of a quarter of it.
vec3 surfaceLight(int region, vec3 x, vec3 normal) {
    if (params.light.x == 0.0) return vec3(0.0);
    // Read in front of the surface: behind it there is no light.
    vec3 at = coordinate(x + 1.5 * normal);
    vec3 arriving = textureLod(fluence, at, 0.0).xyz;
    vec3 towards = textureLod(lobes, at, 0.0).xyz;
    float share = max(-dot(towards, normal), 0.0) + 0.25 * max(1.0 - length(towards), 0.0);
    return surfaces.regions[region].albedo.xyz * arriving * (share * 0.3183098861837907);
}
