// The taps of a Gaussian, in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/kernel.h"

#include <cmath>
#include <numeric>

namespace eikonal::smooth {

std::vector<double> gaussianWeights(double sigma, int width) {
    std::vector<double> weights{1.0};
    for (int k = 1; k <= width / 2; ++k)
        weights.push_back(sigma > 0 ? std::exp(-0.5 * (k / sigma) * (k / sigma)) : 0.0);
    // Smallest first, so that the sum of many is as exact as that of few.
    const double tails = std::accumulate(weights.rbegin(), weights.rend() - 1, 0.0);
    for (double& weight : weights) weight /= 1 + 2 * tails;
    return weights;
}

std::vector<double> foldedWeights(const std::vector<double>& weights, int voxels) {
    const auto count = static_cast<size_t>(voxels);
    if (weights.size() <= count) return weights;
    std::vector<double> folded(weights.begin(), weights.begin() + voxels);
    folded.back() += std::accumulate(weights.begin() + voxels, weights.end(), 0.0);
    return folded;
}

} // namespace eikonal::smooth
