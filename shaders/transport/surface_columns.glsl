// What surface voxels store, read on a surface between the columns of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "transport/surface_voxels.glsl"

// The surface voxels of the four columns round a place on a surface, and their weights, whose sum is 1; −1 and 0
// where a column has none.
struct Columns {
    ivec4 numbers;
    vec4 weights;
};

// Round x, `normal` outward: those along the normal's longest axis whose middles are round it. Each is asked where
// the surface's plane passes it.
Columns columnsAt(vec3 x, vec3 normal) {
    int axis = axisOf(normal);
    ivec3 along = axisVector(axis);
    ivec3 u = axis == 0 ? ivec3(0, 1, 0) : ivec3(1, 0, 0);
    ivec3 v = axis == 2 ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
    vec3 at = (x + 0.5) * float(surface.size.w);
    vec2 p = vec2(dot(at, vec3(u)), dot(at, vec3(v))) - 0.5;
    vec2 base = floor(p);
    vec2 share = p - base;
    vec2 slope = -vec2(dot(normal, vec3(u)), dot(normal, vec3(v))) / dot(normal, vec3(along));
    float height = dot(at, vec3(along));
    Columns found = Columns(ivec4(-1), vec4(0.0));
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(i & 1, i >> 1);
        vec2 column = base + corner;
        float there = height + dot(slope, column - p);
        float whole = floor(there);
        ivec3 fine = ivec3(column.x) * u + ivec3(column.y) * v + ivec3(whole) * along;
        int nearer = there - whole < 0.5 ? -1 : 1;
        int number = surfaceVoxelOf(fine);
        if (number < 0) number = surfaceVoxelOf(fine + nearer * along);
        if (number < 0) number = surfaceVoxelOf(fine - nearer * along);
        vec2 weight = mix(1.0 - share, share, corner);
        found.numbers[i] = number;
        found.weights[i] = number < 0 ? 0.0 : max(weight.x * weight.y, 1.0e-6);
    }
    float sum = dot(found.weights, vec4(1.0));
    if (sum > 0.0) found.weights /= sum;
    return found;
}
