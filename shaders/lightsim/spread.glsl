// Where a point source shines: the share of its intensity that goes in a direction.
// SPDX-License-Identifier: GPL-3.0-or-later

float shareTowards(vec4 axis, vec4 cone, vec3 direction) {
    float along = dot(axis.xyz, direction);
    if (axis.w == 0.0) return 1.0;
    if (axis.w == 1.0) return max(along, 0.0);
    float angle = atan(length(cross(axis.xyz, direction)), along);
    float t = clamp((cone.y - angle) / max(cone.y - cone.x, 1.0e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
