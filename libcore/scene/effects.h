// Which effects a scene calls for, and who asks for them, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "scene/scene.h"

namespace eikonal::scene {

/// Of a whole scene, in this order: sharp_boundaries, refraction, curved_rays (sharp boundaries
/// alone), absorption, scattering, anisotropy, emission, opaque, coat, metal, roughness,
/// crystals, dispersion. `tracing` is what was asked for.
std::vector<Effect> effectsOf(const Scene& scene, const optics::Tracing& tracing);

/// The one of that name; off where it is not listed.
Effect effectNamed(const std::vector<Effect>& effects, const std::string& name);

/// What of the scene will not be traced as people may expect.
std::vector<std::string> warningsOf(const Scene& scene);

/// Where none of the effects is on: what was found, and how to name grids. Else nothing.
std::vector<std::string> idleWarnings(const Files& files, const std::vector<Effect>& effects);

/// "160 x 92 x 109" [voxel].
std::string sizeText(const Scene& scene);

} // namespace eikonal::scene
