// Random numbers as a function of the work item and the seed, never of thread order.
// SPDX-License-Identifier: GPL-3.0-or-later

// PCG-RXS-M-XS as a hash (Jarzynski and Olano 2020, "Hash functions for GPU rendering").
uint pcgHash(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Uniform in [0, 1) with 24 bits.
float uniformOf(uint hash) {
    return float(hash >> 8u) * 5.9604644775390625e-8;
}
