// What render's command line says.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/tracing.h"
#include "image/picture.h"
#include "view/params.h"
#include "volume/volume.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eikonal {

struct Options {
    std::vector<std::string> inputs, placed;
    std::string sceneCamera, size, environment, aovs, light, tone = "clip";
    volume::GridNames names;
    view::Params params; ///< camera, surroundings and samples are every method's
    std::optional<tool::TracingOptions> tracing;
    image::ToneMap toneMap;
    // Of meshes:
    std::string method = "trace", frames;
    double ior = 0;
    glm::dvec3 absorption{0};
    int searchSteps = 5, layers = 0;
    std::vector<std::string> plates;           ///< of volumes one, a picture
    double plateDistance = 0, plateHeight = 0; ///< [unit]; height 0: not given

    /// What texts mean that every method has, the camera's file read. Throws UsageError, and as
    /// readers do of that file.
    void finish(tool::Session& session);
    /// The file of --camera; empty: none.
    std::string cameraFile() const;
    /// The same of those that volumes alone have.
    void finishTracing();
    /// Of volumes: the picture of --plate, none if its path is empty; the place of that goes into
    /// `params`. Throws UsageError.
    image::PictureName takePlate(const CLI::App& app);
    /// The names of --aov, where `all` are those that there are.
    std::vector<std::string> aovNames(const std::vector<std::string>& all) const;
};

void addOptions(tool::Session& session, Options& o);

/// Throws UsageError for an option that is given and is for meshes alone.
void refuseMeshOptions(const CLI::App& app);
/// The same of options for volumes, and of those that only other methods than `method` have.
void refuseOptionsFor(const CLI::App& app, const std::string& method);

} // namespace eikonal
