// The bare march that the view pass is measured against: one fetch and an Euler update a step.
// SPDX-License-Identifier: GPL-3.0-or-later

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params { uvec4 params; }; // width, height, steps
layout(std430, binding = 0) writeonly buffer Result { vec4 result[]; };
layout(binding = 0) uniform sampler3D field;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, params.xy))) return;
    vec3 x = vec3((vec2(pixel) + 0.5) / vec2(params.xy), 0.0);
    vec3 w = vec3(0.0, 0.0, 1.0);
    float ds = 1.0 / float(params.z);
    for (uint i = 0u; i < params.z; ++i) {
        vec4 sampled = textureLod(field, x, 0.0);
        x += (ds / sampled.w) * w;
        w += (ds / sampled.w) * sampled.xyz;
    }
    result[pixel.y * params.x + pixel.x] = vec4(x, w.z);
}
