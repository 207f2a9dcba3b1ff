// A body's or a plate's corners, seen by the camera.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/imagespace_params.h"

layout(std140, binding = kParamsBlock) uniform Params { ImageSpaceParams params; };
layout(location = 0) in vec3 cornerPlace;  // body space [unit]
layout(location = 1) in vec3 cornerNormal; // outward, length 1
layout(location = 2) in vec3 cornerExtra;  // x: distance along the normal [unit]; of a plate: albedo
layout(location = 0) out vec3 normal;
layout(location = 1) out float depth;
#if EXTRA == 1
layout(location = 2) out vec3 extra;
#endif

void main() {
    vec4 place = params.cameraFromBody * vec4(cornerPlace, 1.0);
    normal = mat3(params.cameraFromBody) * cornerNormal;
    depth = place.z;
#if EXTRA == 1
    extra = cornerExtra;
#endif
    gl_Position = params.clipFromCamera * place;
}
