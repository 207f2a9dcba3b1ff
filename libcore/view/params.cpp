// What the view stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/params.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::view {

namespace {

void require(bool holds, const std::string& option, const std::string& found,
             const std::string& wanted) {
    if (!holds) throw UsageError(option + ": found " + found + ", expected " + wanted);
}

} // namespace

const std::vector<std::string>& allAovs() {
    static const std::vector<std::string> kNames{"exit_position",
                                                 "exit_direction",
                                                 "transmittance",
                                                 "optical_path_length",
                                                 "path_length",
                                                 "steps",
                                                 "Z",
                                                 "error"};
    return kNames;
}

void Params::check() const {
    const int kMostPixels = 1 << 17; // EXR readers stop well before this
    require(camera.width >= 1 && camera.rows >= 1 && camera.width <= kMostPixels &&
                camera.rows <= kMostPixels,
            "--size", std::to_string(camera.width) + "x" + std::to_string(camera.rows),
            "1 to 131072 pixels each way");
    const double kFar = 1e18; // [unit]; squares stay finite
    for (const glm::dvec3& point : {camera.eye, camera.target, camera.up})
        require(std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <= kFar,
                "--eye, --target, --up", "a coordinate beyond 1e18", "numbers of less size");
    const glm::dvec3 along = camera.target - camera.eye;
    require(glm::length(along) > 0, "--target", "the eye itself", "another point");
    require(glm::length(camera.up) > 0, "--up", "no direction", "a vector that is not 0");
    const double slant = glm::length(glm::cross(glm::normalize(along), glm::normalize(camera.up)));
    require(slant > 1e-9, "--up", "the viewing direction", "a vector across it");
    if (camera.parallel)
        require(camera.height > 0 && std::isfinite(camera.height), "--ortho", toText(camera.height),
                "a height above 0");
    else
        require(camera.fov > 0 && camera.fov < 180, "--fov", toText(camera.fov),
                "above 0 and below 180 degrees");
    Tracing::check("--tolerance");
    require(maxDepth >= 0 && maxDepth <= 64, "--max-depth", std::to_string(maxDepth), "0 to 64");
    require(samples >= 1 && samples <= 4096, "--samples", std::to_string(samples), "1 to 4096");
    require(maxSteps >= 0, "--max-steps", std::to_string(maxSteps), "0 or more");
    require(background.x >= 0 && background.y >= 0 && background.z >= 0, "--background",
            "a radiance below 0", "0 or more");
    require(std::isfinite(environmentTurn), "--env-rotate", toText(environmentTurn),
            "a number of degrees");
    for (const std::string& name : aovs)
        require(std::count(allAovs().begin(), allAovs().end(), name) == 1, "--aov",
                "'" + name + "'", "one of " + join(allAovs(), ", "));
    for (const std::string& name : aovs)
        require(std::count(aovs.begin(), aovs.end(), name) == 1, "--aov", "'" + name + "' twice",
                "each name once");
}

} // namespace eikonal::view
