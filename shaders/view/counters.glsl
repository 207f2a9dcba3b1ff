// What is counted of rays, and where their colour goes.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the buffers `colours` and `counters` are declared.

uint slotOf() {
    return (gl_WorkGroupID.x + 7u * gl_WorkGroupID.y) % kSlots;
}

void count(uint counter, uint amount) {
    uint at = slotOf() * kCounters + counter;
    uint before = atomicAdd(counters[at].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(counters[at].y, 1u);
}

void countShare(uint counter, float share) {
    if (share > 0.0) count(counter, uint(share * kShareUnit + 0.5));
}

// The largest estimate of a ray's error, as the bits of a float, and the rays above the tolerance.
void noteError(float error) {
    atomicMax(counters[slotOf() * kCounters + kWorstError].x, floatBitsToUint(error));
    if (error > transport.tolerance.x) count(kOverTolerance, 1u);
}

// A ray's share of its pixel, added to those of the rays before it.
void putColour(int at, vec4 colour) {
    vec4 before = params.pattern.z == 1.0 ? vec4(0.0) : colours[at];
    colours[at] = before + params.weight * colour;
}
