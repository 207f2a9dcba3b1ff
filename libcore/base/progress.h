// How an engine tells its caller how far it is; the caller may ask it to stop.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace eikonal {

/// Called with the finished fraction in [0, 1], never decreasing. Cheap to call; may be empty.
using Progress = std::function<void(double fraction)>;

inline void report(const Progress& progress, double fraction) {
    if (progress) progress(fraction);
}

/// A part [from, to] of a larger progress.
inline Progress partOf(const Progress& whole, double from, double to) {
    if (!whole) return {};
    return [whole, from, to](double fraction) { whole(from + (to - from) * fraction); };
}

} // namespace eikonal
