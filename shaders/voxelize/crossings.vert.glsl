// A triangle seen along z, placed so that its corners fall exactly where the host put them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/voxelize_params.h"

layout(std140, binding = kParamsBlock) uniform Params { StripParams params; };
layout(std430, binding = kFacetsBuffer) readonly buffer Facets { Facet facets[]; };
layout(location = 0) flat out vec4 depth;
layout(location = 1) flat out vec4 slope; // x, y of corner a, the depth's rise along x and y

void main() {
    Facet facet = facets[gl_VertexID / 3];
    int corner = gl_VertexID % 3;
    vec2 at = corner == 0 ? facet.corners.xy : corner == 1 ? facet.corners.zw : facet.rest.xy;
    depth = facet.depth;
    slope = vec4(facet.corners.xy, facet.rest.zw);
    // The view's edge is a power of two and corners are multiples of 1/256: no step here or in the
    // viewport rounds. The depth stays out of the position, where it could be clipped.
    gl_Position = vec4(at * (2.0 / float(params.place.y)) - 1.0, 0.0, 1.0);
}
