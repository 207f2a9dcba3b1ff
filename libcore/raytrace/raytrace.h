// Meshes traced exactly on the host: viewing rays to every order, as a method and as a reference.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "base/stats.h"
#include "image/image.h"
#include "raytrace/params.h"

#include <optional>
#include <vector>

namespace eikonal::raytrace {

/// Renders radiance [W/(m² sr)], premultiplied R G B A, AR AG AB where bodies are coloured, and the
/// AOVs asked for. `map` is the environment, R G B. Fills passes and counters of `stats`. Every
/// pixel is computed in double, apart from the others: the picture does not depend on the number of
/// threads.
///
/// At a face of a smooth surface Snell's and Fresnel's laws hold at the smooth normal, while the
/// flat face decides which side a path is on; where the two disagree see surface.h. A path that
/// leaves a clear body through no face, as through a hole, sees what is straight ahead; the share
/// of light is counted as light_lost_by_holes.
/// Throws UsageError for wrong params, MemoryError where the scene does not fit.
image::Image render(const Params& params, const std::vector<Body>& bodies,
                    const std::optional<image::Image>& map, Stats& stats, const Progress& progress);

} // namespace eikonal::raytrace
