// Where the photon kernels book what happened: energies in fixed point, counts.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything is an integer sum, so no result depends on the order of atomics. A number is two
// 32-bit words with carry. Energies are in units of 2^-kFractionBits of the brightest photon's
// weight; they can't overflow: a photon books at most its weight, 1, in each account, and a launch
// has fewer than 2^40 photons. Accounts are spread over slots so that work groups do not queue.

const uint kLedgerSlots = 256u;
const int kFractionBits = 22;
const float kFixedOne = 4194304.0; // 2^kFractionBits

// Accounts of one slot. Those of a colour take three, one per channel.
const uint kEmitted = 0u;
const uint kAbsorbed = 1u;
const uint kScattered = 4u;
const uint kEscaped = 7u;
const uint kLost = 10u;
const uint kSteps = 13u;
const uint kDeposits = 14u;
const uint kTrapped = 15u;
const uint kAccounts = 16u;

layout(std430, binding = 0) buffer Ledger {
    uint nextCount; // photons in the list being written
    uint unused[3];
    uvec2 accounts[]; // kLedgerSlots × kAccounts, (low, high)
};

void book(uint account, uint amount) {
    uint slot = gl_WorkGroupID.x + 7u * gl_WorkGroupID.y;
    uint at = (slot % kLedgerSlots) * kAccounts + account;
    uint before = atomicAdd(accounts[at].x, amount);
    if (before > 0xFFFFFFFFu - amount) atomicAdd(accounts[at].y, 1u);
}

void tally(uint account, float weight) {
    book(account, uint(weight * kFixedOne + 0.5));
}
