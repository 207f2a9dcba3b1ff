// Environment maps in OpenEXR's ENVMAP_LATLONG convention, Y up.
// SPDX-License-Identifier: GPL-3.0-or-later

// Map coordinates in [0, 1] of a unit direction: row 0 is +Y, the centre +Z, +X a quarter of the
// width left of it (longitude +π/2; longitude falls from +π to −π along a row).
vec2 latLongOf(vec3 direction) {
    float longitude = atan(direction.x, direction.z);
    // Not by asin, of which devices make no more than 4e-4: a quarter of a pixel in 4096.
    float latitude = atan(direction.y, length(vec2(direction.x, direction.z)));
    return vec2(0.5 - longitude * 0.15915494309189535, 0.5 - latitude * 0.3183098861837907);
}
