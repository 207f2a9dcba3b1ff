// The surface of water with waves on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/wave.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>

namespace eikonal::shapes {

double waveHeight(double x, double z, double time) {
    struct Wave {
        double amplitude, kx, kz, phase; // [unit], [1/unit], [1/unit], [radian]
    };
    constexpr Wave waves[] = {{0.02, 7, 2, 0}, {0.015, -4, 9, 1}, {0.008, 13, 11, 2}};
    constexpr double g = 9.81; // [m/s²]
    double sum = 0;
    for (const Wave& w : waves)
        sum += w.amplitude * std::sin(w.kx * x + w.kz * z + w.phase -
                                      std::sqrt(g * std::hypot(w.kx, w.kz)) * time);
    return sum;
}

void WaveParams::check() const {
    requireOption(half > 0 && std::isfinite(half), "--half", toText(half), "above 0");
    requireOption(squares >= 1 && squares <= 8192, "--squares", std::to_string(squares),
                  "1 to 8192");
    requireOption(std::isfinite(height), "--height", toText(height), "a number");
    requireOption(std::isfinite(time), "--time", toText(time), "a number");
    constexpr double most = 0.043; // the sum of the amplitudes
    if (bottom)
        requireOption(*bottom < -most * std::abs(height), "--bottom", toText(*bottom),
                      "below the waves, which reach down to " + toText(-most * std::abs(height)));
}

mesh::TriangleMesh makeWave(const WaveParams& params) {
    const auto n = static_cast<std::uint32_t>(params.squares);
    const auto along = [&](std::uint32_t i) { return params.half * (2.0 * i / n - 1); };
    const auto at = [n](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
    mesh::TriangleMesh water;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            water.points.emplace_back(
                along(i), params.height * waveHeight(along(i), along(j), params.time), along(j));
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            water.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
            water.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
    if (!params.bottom) return water;

    // The rim once more at the bottom, round it, and the floor's middle.
    const std::uint32_t count = 4 * n, first = (n + 1) * (n + 1);
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t side = i / n, k = i % n;
        const std::uint32_t u = side == 0 ? k : side == 1 ? n : side == 2 ? n - k : 0;
        const std::uint32_t v = side == 0 ? 0 : side == 1 ? k : side == 2 ? n : n - k;
        rim.push_back(at(u, v));
        water.points.emplace_back(along(u), *params.bottom, along(v));
    }
    water.points.emplace_back(0, *params.bottom, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t k = (i + 1) % count;
        water.triangles.emplace_back(rim[i], rim[k], first + k);
        water.triangles.emplace_back(rim[i], first + k, first + i);
        water.triangles.emplace_back(first + count, first + i, first + k);
    }
    return water;
}

} // namespace eikonal::shapes
