// Several numbers side by side, on which a processor works at once.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that takes or gives such is part of its caller: how it would be handed over does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace eikonal::mesh {

using Double4 = double __attribute__((vector_size(32)));
using Long4 = long long __attribute__((vector_size(32))); ///< of a comparison: −1 or 0 each
using Float8 = float __attribute__((vector_size(32)));
using Int8 = int __attribute__((vector_size(32)));

/// Before a function: it is compiled for processors with and without AVX2, and the one that fits is
/// called. Sums and products are rounded alike in both.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define EIKONAL_LANES __attribute__((target_clones("avx2", "default")))
#else
#define EIKONAL_LANES
#endif
/// Before what such a function calls, to be part of both.
#define EIKONAL_LANES_PART __attribute__((always_inline)) inline

EIKONAL_LANES_PART Double4 four(double x) {
    return Double4{x, x, x, x};
}

EIKONAL_LANES_PART Float8 eight(float x) {
    return Float8{x, x, x, x, x, x, x, x};
}

/// The second where the first is no number.
template<typename Lanes> EIKONAL_LANES_PART Lanes greater(const Lanes& a, const Lanes& b) {
    return a > b ? a : b;
}

template<typename Lanes> EIKONAL_LANES_PART Lanes lesser(const Lanes& a, const Lanes& b) {
    return a < b ? a : b;
}

EIKONAL_LANES_PART bool any(const Long4& mask) {
    return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}

} // namespace eikonal::mesh
