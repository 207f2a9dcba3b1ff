// What the view stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/params.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace eikonal::view {

void Params::check() const {
    camera.check();
    Tracing::check("--tolerance");
    requireOption(maxDepth >= 0 && maxDepth <= 64, "--max-depth", std::to_string(maxDepth),
                  "0 to 64");
    requireOption(cutoff >= 0 && cutoff < 1, "--cutoff", toText(cutoff), "0 or more, below 1");
    requireOption(samples >= 1 && samples <= 4096, "--samples", std::to_string(samples),
                  "1 to 4096");
    requireOption(maxSteps >= 0, "--max-steps", std::to_string(maxSteps), "0 or more");
    Background::check();
    if (plate) {
        requireOption(plate->distance > 0 && plate->distance <= 1e18, "--plate-distance",
                      toText(plate->distance), "a distance above 0");
        requireOption(plate->height >= 0 && plate->height <= 1e18, "--plate-height",
                      toText(plate->height), "a height above 0");
    }
    requireOption(unit == 0 || (unit >= 1e-9 && unit <= 1e9), "--unit", toText(unit),
                  "1e-9 to 1e9 metres");
    for (const auto& [option, angle] :
         {std::pair("--polarizer", polarizer), std::pair("--back-polarizer", backPolarizer)})
        requireOption(!angle || std::isfinite(*angle), option, toText(angle.value_or(0)),
                      "an angle in degrees");
    for (const std::string& name : aovs)
        requireOption(std::count(allAovs().begin(), allAovs().end(), name) == 1, "--aov",
                      "'" + name + "'", "one of " + join(allAovs(), ", "));
    for (const std::string& name : aovs)
        requireOption(std::count(aovs.begin(), aovs.end(), name) == 1, "--aov",
                      "'" + name + "' twice", "each name once");
}

} // namespace eikonal::view
