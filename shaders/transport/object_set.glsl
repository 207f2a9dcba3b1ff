// Sets of objects, a bit each: in one word of few objects, in two of many.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of each object in a set stands in an array, at how many of the set come before it: loops visit
// the set alone, since software devices walk what a condition passes over.

#if !defined(OBJECTS) || !defined(NEAR)
#error OBJECTS must be 0 (blurred boundaries) to 64, NEAR 0 of up to 16 objects and from 1 of more
#endif
const int kObjects = OBJECTS;
const bool kMany = NEAR > 0;
const int kObjectSlots = NEAR > 0 ? NEAR : OBJECTS > 0 ? OBJECTS : 1; // the most objects near a point
#if NEAR > 0
#define ObjectSet uvec2
#else
#define ObjectSet uint
#endif

uvec2 bitsOf(int k) {
    uint bit = 1u << (k & 31);
    return k < 32 ? uvec2(bit, 0u) : uvec2(0u, bit);
}

bool contains(uint set, int k) {
    return ((set >> k) & 1u) == 1u;
}

bool contains(uvec2 set, int k) {
    return (((k < 32 ? set.x : set.y) >> (k & 31)) & 1u) == 1u;
}

uint toggled(uint set, int k) {
    return set ^ (1u << k);
}

uvec2 toggled(uvec2 set, int k) {
    return set ^ bitsOf(k);
}

// The set with k if `holds`, without it if not.
uint changed(uint set, int k, bool holds) {
    return (set & ~(1u << k)) | ((holds ? 1u : 0u) << k);
}

uvec2 changed(uvec2 set, int k, bool holds) {
    uvec2 bits = bitsOf(k);
    return holds ? set | bits : set & ~bits;
}

// The first of a set, or else kObjects.
int firstOf(uint set) {
    return findLSB(set | (1u << kObjects));
}

int firstOf(uvec2 set) {
    return set.x != 0u ? findLSB(set.x) : set.y != 0u ? 32 + findLSB(set.y) : kObjects;
}

// What of a set goes into the lower half of a word: all of a few.
uint firstBits(uint set) {
    return set;
}

uint firstBits(uvec2 set) {
    return set.x & 0xFFFFu;
}

// Places in an array of what is known of a set's objects.
int slotsOf(uint set) {
    return bitCount(set);
}

int slotsOf(uvec2 set) {
    return bitCount(set.x) + bitCount(set.y);
}

// The place of k, which is in the set.
int slotOf(uint set, int k) {
    return kObjects == 1 ? 0 : bitCount(set & ((1u << k) - 1u));
}

int slotOf(uvec2 set, int k) {
    uint before = (1u << (k & 31)) - 1u;
    return k < 32 ? bitCount(set.x & before) : bitCount(set.x) + bitCount(set.y & before);
}

// The first object of a set that is visited, which loses it.
int objectAt(inout uint rest) {
    int k = kObjects == 1 ? 0 : findLSB(rest);
    rest &= rest - 1u;
    return k;
}

int objectAt(inout uvec2 rest) {
    int k = firstOf(rest);
    if (rest.x != 0u) rest.x &= rest.x - 1u;
    else rest.y &= rest.y - 1u;
    return k;
}
