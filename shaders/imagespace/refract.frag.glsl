// Refraction at two interfaces in image space: each pixel's ray through the front face that it meets, and out
// through the back face that it finds.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// dir: Oliveira and Brauwers 2007, "Real-time refraction through deformable objects", §3; isr: Wyman 2005, as that
// paper has it in eqs 1–2; sir: one interface alone. At the second interface what is reflected goes along with
// what is refracted, so that no light is lost; past the critical angle the ray leaves along the surface, as
// in both sources.
#include "shared/bindings.h"
#include "shared/imagespace_params.h"
#include "lib/fresnel.glsl"

#if !defined(METHOD) || !defined(MAP) || !defined(AOVS)
#error METHOD must be 0 to 2, MAP and AOVS 0 or 1
#endif
const int kDir = 0;
const int kIsr = 1;
const int kSir = 2;
const bool kMap = MAP == 1;


layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };
layout(binding = kFrontsUnit) uniform sampler2DArray fronts;
layout(binding = kBacksUnit) uniform sampler2DArray backs;
layout(binding = kDistancesUnit2d) uniform sampler2DArray distances;
layout(std430, binding = kDepthRangeBuffer) readonly buffer Range { uint least; uint greatest; };

#include "camera/environment.glsl"
#include "imagespace/view.glsl"
#include "imagespace/paths.glsl"

layout(early_fragment_tests) in; // or paths would be written of all pixels
layout(location = 0) out vec4 colour; // of the pixel, to which it is added

// Where a ray leaves, as far as image space tells.
struct Exit {
    vec3 x;
    vec2 texel; // whose normal it has there
    int probes;
};

// Of the furthest back face; 0 where there is none.
float backDepthAt(vec2 texel) {
    return isInPicture(texel) ? abs(texelFetch(backs, ivec3(texel, 0), 0).w) : 0.0;
}

// The conservative binary search (Algorithms 1 and 2): a ray that only advances, between the depths of the back
// faces. Depths are positive here; 1 / depth is linear in texture space (eq. 8, which lacks a sign there), so
// alpha is eq. 9. The search starts no nearer than the front face.
Exit search(vec3 start, vec3 direction, vec2 own) {
    float low = max(uintBitsToFloat(least), start.z);
    float high = max(uintBitsToFloat(greatest), low) * (1.0 + 1.0e-6);
    Exit found = Exit(start, own, 0);
    // A ray that does not go away from the eye meets no depths: it leaves where it came in.
    if (direction.z < 1.0e-3) return found;
    vec3 S = start + direction * ((low - start.z) / direction.z);  // eq. 3
    vec3 E = start + direction * ((high - start.z) / direction.z); // eq. 4
    bool perspective = params.window.z == 1.0;
    float k1 = perspective ? 1.0 / S.z : S.z;
    float k2 = perspective ? S.z * E.z / (S.z - E.z) : 1.0 / (E.z - S.z);
    vec2 ts = texelOf(S);
    vec2 dt = texelOf(E) - ts;
    vec3 dv = E - S;
    found.x = S;
    if (backDepthAt(ts) > S.z) found.texel = ts;
    for (int i = 0; i < params.limits.x; ++i) {
        dv *= 0.5;
        float z = found.x.z + dv.z;
        float alpha = ((perspective ? 1.0 / z : z) - k1) * k2;
        vec2 texel = ts + alpha * dt; // eq. 10
        if (z < backDepthAt(texel)) {
            found.x += dv;
            found.texel = texel;
        }
    }
    found.probes = params.limits.x + 1;
    return found;
}

// Eqs 1–2: between the distances along the view ray and along the normal by the ratio of the angles.
Exit guess(vec3 start, vec3 direction, vec3 view, vec3 normal, vec2 own) {
    float along = (backDepthAt(own) - start.z) / view.z;
    float inward = texelFetch(distances, ivec3(own, 0), 0).x;
    float in1 = acos(clamp(abs(dot(view, normal)), 0.0, 1.0));
    float in2 = acos(clamp(abs(dot(direction, normal)), 0.0, 1.0));
    float ratio = in1 > 1.0e-3 ? min(in2 / in1, 1.0) : 1.0 / params.optics.x;
    vec3 x = start + direction * (ratio * along + (1.0 - ratio) * inward);
    vec2 texel = texelOf(x);
    return Exit(x, x.z > 0.0 && backDepthAt(texel) > 0.0 ? texel : own, 1);
}

// Of the mip levels, so that neighbours which leave far from each other do not sparkle (§3.1): as many texels as
// lie between two neighbours' exits. Neighbours on other surfaces do not count.
float levelOf(vec2 texel, vec3 x, vec3 normal) {
    vec2 across = dFdx(texel);
    vec2 down = dFdy(texel);
    vec3 aside = dFdx(x);
    vec3 below = dFdy(x);
    float spread = 1.0;
    if (abs(dot(aside, normal)) <= 0.7 * length(aside)) spread = max(spread, dot(across, across));
    if (abs(dot(below, normal)) <= 0.7 * length(below)) spread = max(spread, dot(down, down));
    return min(0.5 * log2(spread), 3.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 own = vec2(pixel) + 0.5;
    vec3 view = directionThrough(vec2(pixel));
    vec4 front = texelFetch(fronts, ivec3(pixel, 0), 0);
    bool hit = front.w != 0.0; // or only neighbours are, who want to know where this pixel's ray leaves
    vec3 start = pointAt(vec2(pixel), front.w);
    float n = params.optics.x;
    Dielectric first = dielectricAt(view, front.xyz, 1.0, n);
    vec3 direction = normalize(first.refracted);
    Exit found = Exit(start, own, 0);
    if (hit && METHOD == kDir) found = search(start, direction, own);
    if (hit && METHOD == kIsr) found = guess(start, direction, view, front.xyz, own);
    float level = METHOD == kSir ? 0.0 : levelOf(found.texel, start, front.xyz);
    vec3 leaves = direction;
    float reflected = first.reflectance;
    float through = 1.0 - reflected;
    if (METHOD != kSir) {
        vec3 normal = textureLod(backs, vec3(found.texel / vec2(params.picture.xy), 0.0), level).xyz;
        if (dot(normal, normal) < 1.0e-6) normal = direction;
        Dielectric second = dielectricAt(n * direction, normalize(normal), n, 1.0);
        leaves = normalize(second.refracted);
        through *= 1.0 - (second.reflectance < 1.0 ? second.reflectance : 0.0);
    }
    if (reflected == 1.0) { // into a lower index, past the critical angle
        leaves = normalize(first.reflected);
        through = 1.0;
        found.x = start;
    }
    float extent = length(found.x - start);
    vec3 kept = exp(-params.absorption.xyz * extent);
    recordPath(pixel, SurfacePath(vec4(found.x, n * extent), vec4(leaves, extent),
                                  vec4(through * kept, float(found.probes)), vec4(0.0, 0.0, 0.0, 1.0)));
    vec3 light = (1.0 - reflected) * kept * surroundingsLight(leaves) +
                 reflected * surroundingsLight(normalize(first.reflected));
    colour = params.pattern.z * vec4(light, 1.0);
}
