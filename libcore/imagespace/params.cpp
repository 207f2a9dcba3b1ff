// What the methods in image space are asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/params.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace eikonal::imagespace {

void Params::check() const {
    camera.check();
    Background::check();
    requireOption(std::isfinite(ior) && ior >= 0.1 && ior <= 10, "--ior", toText(ior), "0.1 to 10");
    requireOption(std::min({absorption.x, absorption.y, absorption.z}) >= 0, "--absorption",
                  "a coefficient below 0", "0 or more");
    requireOption(searchSteps >= 1 && searchSteps <= kMostSearchSteps, "--search-steps",
                  std::to_string(searchSteps), "1 to " + std::to_string(kMostSearchSteps));
    requireOption(layers >= 0 && layers <= kMostLayers, "--layers", std::to_string(layers),
                  "0 to " + std::to_string(kMostLayers));
    requireOption(maxDepth >= 1 && maxDepth <= 64, "--max-depth", std::to_string(maxDepth),
                  "1 to 64");
    requireOption(cutoff >= 0 && cutoff < 1, "--cutoff", toText(cutoff), "0 or more, below 1");
    requireOption(samples >= 1 && samples <= 4096, "--samples", std::to_string(samples),
                  "1 to 4096");
    for (const std::string& name : aovs) {
        requireOption(std::count(allAovs().begin(), allAovs().end(), name) == 1, "--aov",
                      "'" + name + "'", "of a mesh one of " + join(allAovs(), ", "));
        requireOption(std::count(aovs.begin(), aovs.end(), name) == 1, "--aov",
                      "'" + name + "' twice", "each name once");
    }
}

} // namespace eikonal::imagespace
