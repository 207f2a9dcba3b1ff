// What stands for a light: parallel rays, or those of a point.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/lights.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace eikonal::lightsim {

using scene::Light;

/// Where rays start, in voxel space.
struct Source {
    /// Parallel rays; or from a point, the same all round, by Lambert's cosine about the axis, or
    /// in a cone about it.
    enum class Spread { parallel, even, cosine, cone } spread = Spread::parallel;
    glm::dvec3 vector{0, -1, 0}; ///< direction of travel, or position [voxel]
    glm::dvec3 rgb{1};           ///< irradiance [W/m²], or radiant intensity on the axis [W/sr]
    glm::dvec3 axis{0, 0, 1};
    double inner = 0, outer = 0; ///< cone: the angles between which it fades [rad]
    glm::dvec3 polarizer{0};     ///< as scene::Light's, voxel space

    bool isPoint() const { return spread != Spread::parallel; }
};

/// The share of its intensity that a source sends in a direction; 1 of parallel rays.
double shareTowards(const Source& source, const glm::dvec3& direction);

/// What a photon, or a cell of beams, of weight 1 has: `power` [m² or sr] of a light's RGB. A
/// band's may be negative: see optics::whiteDensity().
struct Unit {
    glm::dvec3 rgb{1};
    double power = 0;
    bool isPoint = false;       ///< of a light that has a place
    glm::dvec3 colour{1.0 / 3}; ///< of what is traced, RGB over their sum: rgb may be a part of it
};

/// What stays right where one direction stands for many.
enum class Keep { irradiance, fluence };

/// `count` sources that stand for a light that is extended, or the one that a light is. They are
/// the same at every call, and their projections on any line lie apart, so that the edge of a
/// shadow fades in as many steps as there are. An environment may have fewer.
std::vector<Source> sourcesOf(const Light& light, int count, Keep keep,
                              const glm::dmat4& voxelFromWorld);

} // namespace eikonal::lightsim
