// A layer of a surface: its normals, and depths, which are negative on back faces.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// With PEELS, the nearest surface behind the layer before (depth peeling: Mammen 1989; Everitt 2001).
#include "shared/bindings.h"
#include "shared/imagespace_params.h"

#if !defined(PEELS) || !defined(EXTRA)
#error PEELS and EXTRA must be 0 or 1
#endif
const bool kPeels = PEELS == 1;

layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };
layout(location = 0) in vec3 normal;
layout(location = 1) in float depth;
layout(location = 0) out vec4 surface;
#if EXTRA == 1
layout(location = 2) in vec3 extra;
layout(location = 1) out vec4 beside;
#endif
#if PEELS == 1
layout(binding = kFrontsUnit) uniform sampler2DArray layers;
#endif

void main() {
#if PEELS == 1
    float before = abs(texelFetch(layers, ivec3(gl_FragCoord.xy, params.limits.y - 1), 0).w);
    // Where a layer has nothing, those behind it have nothing either.
    if (params.limits.y > 0 && (before == 0.0 || depth <= before)) discard;
#endif
    surface = vec4(normalize(normal), gl_FrontFacing ? depth : -depth);
#if EXTRA == 1
    beside = vec4(extra, 1.0);
#endif
}
