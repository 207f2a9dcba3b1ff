// What a viewing ray gathers along a piece of its path.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is gathered is L/n², which is conserved along a path and over an interface, but for the share that
// goes the other way; L is not.
#include "lib/attenuation.glsl"
#include "lib/phase.glsl"

struct Medium {
    vec3 extinction; // [1/voxel]
    vec3 source;     // radiance gained towards the eye per voxel of length
};

// The mean direction of the stored light, in voxel space, and g. The texture has it times the light, so
// that dark voxels say nothing of it.
vec4 meanDirectionAt(vec3 at, vec3 light) {
    vec4 found = textureLod(lightDirection, at, 0.0);
    float sum = light.x + light.y + light.z;
    return vec4(sum > 0.0 ? found.xyz / sum : vec3(0.0), found.w);
}

// Henyey–Greenstein for the stored light: one lobe round its mean direction, whose length m makes the
// first moment right as g m. Towards the eye, against the ray's direction. [1/sr]
float phaseTowards(vec3 mean, float g, vec3 direction) {
    float m = length(mean);
    float cosine = m > 0.0 ? -dot(mean, direction) / m : 0.0;
    return henyeyGreenstein(g * min(m, 1.0), cosine);
}

// Blurred media: extinction and source come from the host, of grey ones in one texture.
Medium blurredMediumAt(vec3 at, vec3 direction) {
    vec4 first = textureLod(extinctions, at, 0.0);
    Medium medium = Medium(kColour ? first.xyz : vec3(first.x), vec3(0.0));
    if (kGlows) medium.source = kColour ? textureLod(sources, at, 0.0).xyz : vec3(first.y);
    if (kAnisotropic) {
        vec4 light = meanDirectionAt(at, textureLod(fluence, at, 0.0).xyz);
        medium.source *= phaseTowards(light.xyz, light.w, direction);
        if (kEmission) medium.source += textureLod(emission, at, 0.0).xyz;
    }
    return medium;
}

// Within sharp boundaries each region knows its coefficients.
Medium regionMediumAt(int mode, int region, vec3 x, vec3 direction) {
    Coefficients here = coefficientsFor(mode, region, x, direction);
    Medium medium = Medium(here.absorption + here.scattering, kEmission ? here.emission : vec3(0.0));
    if (kGlows) {
        vec3 at = coordinate(x);
        vec3 light = textureLod(fluence, at, 0.0).xyz;
        float phase = kAnisotropic ? phaseTowards(meanDirectionAt(at, light).xyz, here.g, direction)
                             : kIsotropicPhase;
        medium.source += here.scattering * light * phase;
    }
    return medium;
}

void gather(inout Path path, inout Load load, vec3 middle, vec3 direction, float extent, float n,
            int region) {
    Medium medium = Medium(vec3(0.0), vec3(0.0));
    if (kObjects == 0) medium = blurredMediumAt(coordinate(middle), direction);
    else medium = regionMediumAt(path.mode, region, middle, direction);
    float scale = extent / (n * n);
    if (!kDims) {
        load.light += path.throughput * medium.source * scale;
    } else if (kColour) {
        Attenuation red = attenuationOf(medium.extinction.x * extent);
        Attenuation green = attenuationOf(medium.extinction.y * extent);
        Attenuation blue = attenuationOf(medium.extinction.z * extent);
        if (kGlows || kEmission)
            load.light += path.throughput * vec3(red.mean, green.mean, blue.mean) * medium.source *
                          scale;
        path.throughput *= vec3(red.through, green.through, blue.through);
    } else { // grey: one number stands for three
        Attenuation grey = attenuationOf(medium.extinction.x * extent);
        if (kGlows || kEmission)
            load.light += path.throughput.x * grey.mean * medium.source.x * scale;
        path.throughput = vec3(path.throughput.x * grey.through);
    }
}
