// A mip level of the back faces' normals and depths, from the one before.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Not by glGenerateMipmap: software devices take ten times as long for it.
#include "shared/bindings.h"
#include "shared/imagespace_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };
layout(binding = kBacksUnit) uniform sampler2DArray backs;
layout(rgba32f, binding = kLevelImage) writeonly uniform image2DArray level;

void main() {
    vec2 size = vec2(imageSize(level).xy);
    vec2 texel = vec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    // Filtered: of an odd size not every texel has four.
    vec4 mean = textureLod(backs, vec3((texel + 0.5) / size, 0.0), float(params.picture.w - 1));
    imageStore(level, ivec3(texel, 0), mean);
}
