// The light that was stored in scenes that are made one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/merge.h"
#include "scene/resample.h"

namespace eikonal::scene {

/// Light of each object from the part that it comes from, `origins` its number: on surfaces by fine
/// voxels no larger than any part's (kMostDetail of a voxel at most), weighed between the part's
/// fine voxels; in media linearly.
StoredLight mergedLight(const Scene& scene, const std::vector<Part>& parts,
                        const std::vector<Resampler>& resamplers,
                        const std::vector<size_t>& origins);

} // namespace eikonal::scene
