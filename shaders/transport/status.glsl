// What has become of a path.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kNone = 0;    // there is none: the pixel of the photon map saw nothing
const int kAlive = 1;
const int kLeft = 2;    // the domain
const int kStopped = 3; // met opaque material
const int kFaded = 4;   // too dim to follow
const int kTrapped = 5; // used up its steps
const int kDeep = 6;    // met more interfaces than it may
const int kMeets = 7;  // an interface, where it waits for the way it is to take
