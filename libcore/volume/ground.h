// The ground of a scene, an infinite plane, as a file's metadata tell of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace eikonal::volume {

/// The plane y = `y` of the world, which is opaque below. Within the domain it is an object like
/// any other, called kGround; beyond, nothing but these numbers.
struct Ground {
    double y = 0;           ///< [unit]
    glm::dvec3 albedo{0.5}; ///< of the squares about the origin of x and z, or all of it
    double square = 0;      ///< edge of a checker's squares [unit]; 0: none

    bool operator==(const Ground&) const = default;

    /// What its squares reflect in the mean.
    glm::dvec3 meanAlbedo() const { return square > 0 ? 0.5 * (1 + kDark) * albedo : albedo; }

    /// What every other square reflects, as a share of the albedo.
    static constexpr double kDark = 0.5;
};

/// How high it may lie, and how large its squares may be [unit].
constexpr double kFarthestGround = 1e12;

/// The name of the object within the domain, and of the metadata.
constexpr const char* kGround = "ground";
constexpr const char* kGroundKey = "eikonal:ground";

/// What is wrong with its numbers, or "".
std::string faultOf(const Ground& ground);

/// "Y R,G,B SIZE", as the metadata have it.
std::string textOf(const Ground& ground);

/// A file's ground. Throws DataError where its metadata are no such text.
std::optional<Ground> groundOf(const Volume& volume);

} // namespace eikonal::volume
