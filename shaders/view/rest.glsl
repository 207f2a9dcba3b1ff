// Branches that one launch does not come to: kept for the next.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Software devices end every loop once the eight lanes of a vector have made 65,535 rounds, of all loops
// together, and say nothing of it. Rays that are led along within a wall part so often that they come to
// this. So after as many looks as eight lanes that each go their own way can make by then, a ray rests
// when a branch has ended, and those that wait go on in another launch.
//
// Included where `params`, a ViewParams, the struct Branch and its `waiting` are declared.

// Looks of a launch. A look takes some two rounds, of several objects more.
const int kMostLooksAtOnce = 1024 / min(kObjectSlots, 4);

struct Rest {
    float n; // the index at the eye
    int at;  // the pixel's place in the strip
    int count;
    Branch waiting[WAITING];
};

// Two halves: a launch reads what the last one left in one, and leaves what rests in the other.
layout(std430, binding = kRestsBuffer) buffer Rests {
    uint resting; // how many this launch leaves
    Rest rests[];
};

int restAt = -1;    // where this ray's place is, if it rests
bool asked = false; // for a place; there may be none left

int firstOfHalf(int which) {
    return which * (rests.length() / 2);
}

// Whether a ray that has looked so often is to rest now.
bool isToRest(int looks) {
    if (!asked && looks > kMostLooksAtOnce) {
        asked = true;
        int place = int(atomicAdd(resting, 1u));
        if (place < rests.length() / 2) restAt = firstOfHalf(1 - params.limits.w) + place;
    }
    return restAt >= 0;
}

// Downward, since compilers write a loop out that begins at 0 and ends with an array.
void rest(float n, int at) {
    rests[restAt].n = n;
    rests[restAt].at = at;
    rests[restAt].count = waitingCount;
    for (int i = waitingCount - 1; i >= 0; --i) rests[restAt].waiting[i] = waiting[i];
}

void fetchWaiting(int from) {
    waitingCount = rests[from].count;
    for (int i = waitingCount - 1; i >= 0; --i) waiting[i] = rests[from].waiting[i];
}
