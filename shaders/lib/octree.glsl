// How far a photon may step: the leaves of the tolerance octree (Sun et al. 2008, §4.2 and §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later

// A leaf as stored: its level in the low 5 bits, the step limit above them in 1/16 voxel.
uint packLeaf(uint level, float limit) {
    return level | (uint(clamp(limit, 0.0, 1.0e6) * 16.0) << 5u);
}

uint leafLevel(uint leaf) {
    return leaf & 31u;
}

float leafLimit(uint leaf) {
    return float(leaf >> 5u) * 0.0625;
}

// Distance [voxel] from p along unit direction d to the face of p's leaf of that level. p is in
// cell coordinates: voxel i is the cell from i to i + 1.
float distanceToLeafFace(vec3 p, vec3 d, uint level) {
    float edge = float(1u << level);
    vec3 low = floor(p / edge) * edge;
    float distance = 1.0e30;
    for (int i = 0; i < 3; ++i) {
        float face = d[i] > 0.0 ? low[i] + edge : low[i];
        // On the face already, going out: the leaf behind it is meant.
        if (d[i] < 0.0 && face == p[i]) face = low[i] - edge;
        if (abs(d[i]) > 1.0e-12) distance = min(distance, (face - p[i]) / d[i]);
    }
    return distance;
}
