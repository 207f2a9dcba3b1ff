// The nine points of a cell of the light's map, three by three, row by row.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/beam_params.h"
#include "transport/status.glsl"

uint pointOf(BeamNode node, int i) {
    return i < 4 ? node.first[i] : i < 8 ? node.second[i - 4] : uint(node.place.w);
}

// A place on the light's map in one word, and back.
int packedPlace(ivec2 map) {
    return map.x | map.y << 16;
}

ivec2 placeFrom(int word) {
    return ivec2(word & 0xFFFF, word >> 16);
}

// Whether the light of a point, and that of another wavelength beside it, fall on the same surface, which is nearly
// flat between them.
bool landTogether(BeamPoint point, BeamPoint there) {
    const float kFlat = 0.99; // cosine between normals
    return point.event.x == uint(kStopped) && there.event.xy == point.event.xy &&
           dot(point.wave.xyz, there.wave.xyz) > kFlat;
}

// A part of a beam in one word: which of so many, up to 16 along each side, at which of 2^shifts places.
uint packedPart(ivec2 cell, ivec2 count, int step, int shifts) {
    return uint(cell.x | cell.y << 4 | count.x - 1 << 8 | count.y - 1 << 12 | step << 16 | shifts << 24);
}

// A point's share of a cell (Simpson's rule).
float shareOf(int i) {
    return i == 4 ? 16.0 / 36.0 : (i & 1) == 1 ? 4.0 / 36.0 : 1.0 / 36.0;
}

// The same of one that is no beam: of each quarter a fourth (the trapezoidal rule).
float brokenShareOf(int i) {
    return i == 4 ? 0.25 : (i & 1) == 1 ? 0.125 : 0.0625;
}
