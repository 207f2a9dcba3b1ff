// Pixels whose rays meet nothing: what surrounds the scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/imagespace_params.h"

#if !defined(MAP) || !defined(AOVS)
#error MAP and AOVS must be 0 or 1
#endif
const bool kMap = MAP == 1;

layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };

#include "camera/environment.glsl"
#include "imagespace/view.glsl"
#include "imagespace/paths.glsl"

layout(early_fragment_tests) in; // or paths would be written of all pixels
layout(location = 0) out vec4 colour; // of the pixel, to which it is added

void main() {
    vec2 pixel = floor(gl_FragCoord.xy);
    vec3 view = directionThrough(pixel);
    colour = params.pattern.z * vec4(surroundingsLight(view), 0.0);
    recordPath(ivec2(pixel), freePath(pointAt(pixel, 0.0), view));
}
