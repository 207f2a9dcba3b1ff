// What became of a photon.
// SPDX-License-Identifier: GPL-3.0-or-later

const uint kNone = 0u;    // the pixel saw nothing: no photon
const uint kAlive = 1u;
const uint kEscaped = 2u; // left the domain
const uint kStopped = 3u; // met opaque material, which absorbed it
const uint kFaded = 4u;   // too dim to follow
const uint kTrapped = 5u; // used up its steps
const uint kDeep = 6u;    // met more boundaries than it may
