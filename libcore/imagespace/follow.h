// Rays followed among layers of surfaces, peeled off one behind the other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/raster.h"
#include "imagespace/params.h"
#include "imagespace/shared.h"

#include <functional>
#include <vector>

namespace eikonal::imagespace {

/// What is drawn, and how the device is told where it is.
struct Drawn {
    const gpu::Triangles* triangles;
    glm::mat4 cameraFromBody;
};

class Follower {
public:
    Follower() = default;
    Follower(gpu::Device& device, const Params& params, bool hasMap, bool hasPlates);

    /// What it takes on the device.
    static std::vector<gpu::Need> needs(const Params& params, bool hasPlates);

    /// One ray of each pixel. `upload` tells the device of `values`. What is drawn into layers
    /// ends with the first that stays empty.
    void draw(gpu::Canvas& canvas, const Drawn& body, const Drawn& plates, ImageSpaceParams& values,
              const std::function<void()>& upload, gpu::Profiler& profiler);

    /// Layers that something was drawn into, the last time.
    int layersUsed() const { return mUsed; }
    /// First branches so far that ended within the body, since layers or pixels were too few.
    double lost() const;

private:
    int peel(gpu::Canvas& canvas, const gpu::Program& program, const gpu::Layers& layers,
             const gpu::Layers* beside, const Drawn& drawn, ImageSpaceParams& values,
             const std::function<void()>& upload);

    int mMost = 0, mUsed = 0;
    glm::ivec2 mSize{0};
    gpu::Program mPeel, mPeelPlates, mFollow;
    gpu::Layers mSurfaces, mPlates, mAlbedos;
    gpu::Buffer mCounters;
};

} // namespace eikonal::imagespace
