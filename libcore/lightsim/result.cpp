// What a light simulation gives.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/result.h"

namespace eikonal::lightsim {

namespace {

/// R + G + B of the fluence of the i-th value; 1 where there is no fluence.
float brightness(const volume::BrickGrid& fluence, size_t i) {
    const float* rgb = fluence.values.data() + 3 * i;
    return fluence.values.empty() ? 1 : rgb[0] + rgb[1] + rgb[2];
}

/// Mean directions of both, weighed by fluence that is not added yet.
void addDirection(Result& sum, const Result& light) {
    for (size_t i = 0; 3 * i < sum.direction.values.size(); ++i) {
        const float before = brightness(sum.fluence, i), its = brightness(light.fluence, i);
        if (!(before + its > 0)) continue;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c)
            sum.direction.values[c] =
                (before * sum.direction.values[c] + its * light.direction.values[c]) /
                (before + its);
    }
}

} // namespace

void add(Result& sum, const Result& light) {
    if (sum.fluence.page.empty() && sum.direction.page.empty() && sum.irradiance.empty()) {
        sum = light;
        return;
    }
    addDirection(sum, light);
    for (size_t i = 0; i < sum.fluence.values.size(); ++i)
        sum.fluence.values[i] += light.fluence.values[i];
    for (size_t i = 0; i < sum.irradiance.values.size(); ++i)
        sum.irradiance.values[i] += light.irradiance.values[i];
}

} // namespace eikonal::lightsim
