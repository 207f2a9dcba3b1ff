// Rays that one launch does not bring to their end: kept as they are for the next.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Software devices end every loop once the eight lanes of a vector have made 65,535 rounds, of all loops
// together, and say nothing of it. Rays that are led along within a wall part so often that they come to
// this. So a ray rests after as many looks as eight lanes that each go their own way can make by then.
//
// Included where `params`, a ViewParams, and the structs Path, Load and Branch are declared.

// Looks of a launch. A look takes some two rounds, of several objects more.
const int kMostLooksAtOnce = 1024 / min(kObjectSlots, 4);

struct Rest {
    Path path;
    Load load;
    vec3 direction; // of the pixel's ray at the eye, of length 1
    float n;        // the index there
    int at;         // the pixel's place in the strip
    int waitingCount;
    Branch waiting[WAITING];
};

// Two halves: a launch reads what the last one left in one, and leaves what rests in the other.
layout(std430, binding = kRestsBuffer) buffer Rests {
    uint resting; // how many this launch leaves
    Rest rests[];
};

int restAt = -1;       // where this ray's place is, if it has one
bool asked = false;    // for a place; there may be none left
int launchedWith = 0;  // looks made before this launch

int halfOf(int parity) {
    return parity == 0 ? 0 : rests.length() / 2;
}

// Whether a ray is to rest here.
bool pauses(Path path) {
    if (kObjects > 0 && !asked && path.steps - launchedWith > kMostLooksAtOnce) {
        asked = true;
        uint place = atomicAdd(resting, 1u);
        if (int(place) < rests.length() / 2) restAt = halfOf(1 - params.limits.w) + int(place);
    }
    return restAt >= 0;
}
