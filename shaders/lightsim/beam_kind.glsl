// A kind of path: the branches that it takes at interfaces, bits of a word, the first lowest.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// 0 goes on, 1 back; in scenes with crystals two bits each, 2 and 3 the e-waves.

const int kBranchBits = CRYSTALS > 0 ? 2 : 1;

// The branch taken at an interface by its number.
uint branchAt(uint kind, int number) {
    return kind >> (kBranchBits * number) & ((1u << kBranchBits) - 1u);
}

// The kind that takes one more, by how many there are so far.
uint kindAfter(uint kind, int branches, uint branch) {
    return kind | branch << (kBranchBits * branches);
}

// A point that goes on by a branch, in one word, and back.
uint wantedAs(uint point, uint branch) {
    return point << kBranchBits | branch;
}

uint wantedPoint(uint word) {
    return word >> kBranchBits;
}

uint wantedBranch(uint word) {
    return branchAt(word, 0);
}
