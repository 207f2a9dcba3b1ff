// The view stage: curved viewing rays through a lit scene volume (Sun et al. 2008, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "base/stats.h"
#include "gpu/device.h"
#include "image/exr.h"
#include "image/image.h"
#include "scene/ground.h"
#include "scene/scene.h"
#include "view/params.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::view {

/// The scene as viewing rays meet it, and which effects are worth simulating.
struct Plan {
    scene::Scene scene;
    bool bends = false;       ///< index or boundaries turn rays
    bool dims = false;        ///< something absorbs or scatters
    bool colour = false;      ///< coefficients or light differ by wavelength
    bool scatters = false;    ///< there is light, and something scatters it
    bool anisotropic = false; ///< scattering prefers a direction
    bool emits = false;
    bool opaque = false;
    bool map = false;                    ///< an environment map surrounds the scene
    std::optional<scene::Ground> ground; ///< which goes on beyond the domain
    bool several = false;                ///< there are other domains
    bool paths = false;                  ///< some other domain calls for rays' paths
    std::vector<Effect> effects;
    std::vector<std::string> warnings;

    bool lit() const { return !scene.light.fluence.isZero(); }
    bool gathers() const { return dims || emits; }
};

Plan makePlan(const scene::Files& files, const Params& params, bool hasMap);

/// Of volumes in places of their own. Where nothing but objects is in one, its domain is cut to
/// them, so that empty space costs nothing. Those whose domains overlap are made one, see
/// scene::merge(). Throws DataError where that can't be, or where they do not lie in one medium.
std::vector<Plan> makePlans(std::vector<scene::Files>& files, const Params& params, bool hasMap);

/// Fills in what the scene's data turn on: all flags but those of several domains.
void tellEffects(Plan& plan, const Params& params);

/// Adds the effects and warnings of all of them to the first: an effect is on where it is on in
/// one.
void joinEffects(std::vector<Plan>& plans);

/// What the run will hold on the device.
std::vector<gpu::Need> needsOf(const std::vector<Plan>& plans, const Params& params);

/// Renders radiance [W/(m² sr)], premultiplied R G B A, AR AG AB where the medium is coloured, and
/// the AOVs asked for. `map` is the environment, R G B. Fills passes and counters of `stats`.
/// Throws MemoryError before the work if the device can't hold it.
image::Image render(gpu::Device& device, const std::vector<Plan>& plans, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats, const Progress& progress);
image::Image render(gpu::Device& device, const Plan& plan, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats, const Progress& progress);

} // namespace eikonal::view
