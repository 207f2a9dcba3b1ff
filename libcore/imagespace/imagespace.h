// Refraction in image space: pictures of meshes by rasterising them, without a volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "base/stats.h"
#include "gpu/device.h"
#include "image/image.h"
#include "imagespace/params.h"

#include <memory>
#include <optional>

namespace eikonal::imagespace {

/// Throws DataError, naming the mesh by its title, where it is not closed or its faces do not all
/// look outward.
void requireClosed(const mesh::TriangleMesh& mesh, const std::string& title);

/// Whether the eye is within a body, from where no front face is seen. Linear in the triangles
/// where the eye is in their box.
bool isWithin(const mesh::TriangleMesh& mesh, const glm::dvec3& eye);

/// What of the method a run does, for --explain and --stats.
std::vector<Effect> effectsOf(const Params& params, bool hasMap);

/// Holds what stays from frame to frame: shaders, layers, the environment map.
class Renderer {
public:
    /// `map` is the environment, R G B. Throws MemoryError if the device can't hold the picture's
    /// layers.
    Renderer(gpu::Device& device, const Params& params, const std::optional<image::Image>& map,
             Stats& stats);
    ~Renderer();

    /// Takes these triangles in place of those before. isr takes Body::distances, one for each
    /// point; plates are seen with layers alone.
    void setScene(const Body& body, const std::vector<Plate>& plates);

    /// Radiance [W/(m² sr)], premultiplied R G B A, AR AG AB where the body is coloured, and the
    /// AOVs asked for. Adds passes and counters to the statistics.
    image::Image render(const Progress& progress);

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

} // namespace eikonal::imagespace
