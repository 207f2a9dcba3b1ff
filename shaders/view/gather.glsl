// What a viewing ray gathers on its way: the light of the medium it crosses and of surfaces it meets.
// SPDX-License-Identifier: GPL-3.0-or-later

// A ray on its way, and what it has met.
const int kWalking = 0, kLeft = 1, kStopped = 2, kTrapped = 3;
struct Walk {
    Ray ray;
    Ray lost;   // what rounding has kept back of it
    vec3 light; // L/n²
    vec3 through;
    float pathLength;    // [voxel]
    float opticalLength; // [voxel]
    int steps;
    int fate;
    float error; // adaptive: the steps' own estimates of how far off the exit is, added up [voxel]
    vec3 clear;  // the last point known to be outside opaque material
    vec3 met;    // a point inside it, when stopped
};

// Adds a piece of length ds [voxel] with the medium as sampled at coordinate `at`.
Walk gather(Walk walk, vec3 at, vec3 direction, float n, float ds) {
    vec3 sigma = vec3(0.0);
    vec3 shine = vec3(0.0);
    vec4 medium = textureLod(dimming, at, 0.0);
    if (kColour) {
        sigma = medium.xyz;
        if (kShines) shine = textureLod(source, at, 0.0).xyz;
    } else {
        sigma = vec3(medium.x);
        if (kShines) shine = vec3(medium.y);
    }
    if (kLobes) {
        // One lobe round the mean direction; its length m makes the first moment right as g m.
        vec4 lobe = textureLod(lobes, at, 0.0);
        float m = length(lobe.xyz);
        float cosine = m > 0.0 ? -dot(lobe.xyz, direction) / m : 0.0;
        shine *= henyeyGreenstein(lobe.w * min(m, 1.0), cosine);
        if (kEmission) shine += textureLod(emission, at, 0.0).xyz;
    }
    float scale = ds / (n * n);
    vec3 depth = sigma * ds;
    if (!kDims) {
        walk.light += shine * scale;
    } else if (kColour) {
        Attenuation red = attenuationOf(depth.x);
        Attenuation green = attenuationOf(depth.y);
        Attenuation blue = attenuationOf(depth.z);
        if (kShines)
            walk.light += walk.through * vec3(red.mean, green.mean, blue.mean) * shine * scale;
        walk.through *= vec3(red.through, green.through, blue.through);
    } else {
        Attenuation grey = attenuationOf(depth.x);
        float added = kShines ? walk.through.x * grey.mean * shine.x * scale : 0.0;
        if (kOpaque) walk.light += vec3(added); // surfaces may be coloured in a grey medium
        else walk.light.x += added;
        walk.through.x *= grey.through;
    }
    return walk;
}

float opacityAt(vec3 x) {
    return textureLod(surface, coordinate(x), 0.0).x;
}

// Light leaving an opaque surface at x towards the eye: a Lambertian reflector under the stored
// light. Of fluence φ the part m is a beam along the mean direction, the rest comes from all sides
// and gives an irradiance of a quarter of it.
vec3 surfaceLight(vec3 x) {
    if (params.light.x == 0.0) return vec3(0.0);
    vec3 outward = -vec3(opacityAt(x + vec3(1, 0, 0)) - opacityAt(x - vec3(1, 0, 0)),
                         opacityAt(x + vec3(0, 1, 0)) - opacityAt(x - vec3(0, 1, 0)),
                         opacityAt(x + vec3(0, 0, 1)) - opacityAt(x - vec3(0, 0, 1)));
    float size = length(outward);
    vec3 normal = size > 0.0 ? outward / size : vec3(0.0);
    // Read in front of the surface: behind it there is no light.
    vec3 at = coordinate(x + 1.5 * normal);
    vec3 arriving = textureLod(fluence, at, 0.0).xyz;
    vec3 towards = textureLod(lobes, at, 0.0).xyz;
    float share = max(-dot(towards, normal), 0.0) + 0.25 * max(1.0 - length(towards), 0.0);
    // Its albedo half a voxel behind: in front there may be none.
    vec3 albedo = textureLod(surface, coordinate(x - 0.5 * normal), 0.0).yzw;
    return albedo * arriving * (share * 0.3183098861837907);
}


// Where the opaque surface lies between the last point outside it and the one inside, and what it sends
// to the eye.
Walk meetSurface(Walk walk) {
    vec3 outside = walk.clear;
    vec3 inside = walk.met;
    for (int i = 0; i < 12; ++i) {
        vec3 middle = 0.5 * (outside + inside);
        if (opacityAt(middle) > 0.5) inside = middle;
        else outside = middle;
    }
    float n = length(walk.ray.w);
    float ds = max(dot(inside - walk.ray.x, walk.ray.w) / n, 0.0);
    if (kDims || kShines)
        walk = gather(walk, coordinate(0.5 * (walk.ray.x + inside)), walk.ray.w / n, n, ds);
    walk.pathLength += ds;
    walk.opticalLength += ds * n;
    walk.ray.x = inside;
    vec3 through = kColour ? walk.through : vec3(walk.through.x);
    walk.light += through * surfaceLight(inside) / (n * n);
    return walk;
}
