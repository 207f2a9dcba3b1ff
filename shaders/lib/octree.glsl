// How far a photon may step: the leaves of the tolerance octree (Sun et al. 2008, §4.2 and §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later

// A leaf is stored with its level in the low 5 bits, the step limit above them in 1/16 voxel.
uint leafLevel(uint leaf) {
    return leaf & 31u;
}

float leafLimit(uint leaf) {
    return float(leaf >> 5u) * 0.0625;
}

// Distance [voxel] from x along a direction to the face of x's leaf of that level. Of the direction
// the signs and the inverses of the components' sizes are given. Voxel i reaches from i − ½ to i + ½.
// On a face already, the leaf ahead is meant.
float distanceToLeafFace(vec3 x, vec3 signs, vec3 inverses, uint level) {
    float edge = float(1u << level);
    vec3 p = (x + 0.5 + 1.0e-4 * signs) * (1.0 / edge);
    vec3 middle = (floor(p) + 0.5) * edge - 0.5;
    vec3 reach = (0.5 * edge - (x - middle) * signs) * inverses;
    return min(reach.x, min(reach.y, reach.z));
}
