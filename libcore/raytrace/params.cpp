// What is traced, and how a picture is made of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/params.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace eikonal::raytrace {

void Params::check() const {
    camera.check();
    camera::Background::check();
    requireOption(maxDepth >= 1 && maxDepth <= 10000, "--max-depth", std::to_string(maxDepth),
                  "1 to 10000 boundaries");
    requireOption(cutoff >= 0 && cutoff < 1, "--cutoff", toText(cutoff), "0 or more and below 1");
    requireOption(samples >= 1 && samples <= 4096, "--samples", std::to_string(samples),
                  "1 to 4096 rays of a pixel");
    for (const std::string& name : aovs)
        requireOption(std::find(allAovs().begin(), allAovs().end(), name) != allAovs().end(),
                      "--aov", "'" + name + "'", "one of " + join(allAovs(), ", "));
}

} // namespace eikonal::raytrace
