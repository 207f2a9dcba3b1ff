// What the voxelising stage is asked to do: objects, what they are made of, and the lattice.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/smooth_surface.h"
#include "mesh/triangle_mesh.h"
#include "volume/ground.h"
#include "volume/volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::voxelize {

/// What fills an object or surrounds it. The defaults are those of empty space.
struct Material {
    double ior = 1;            ///< refractive index at 587.6 nm [1]
    double dispersion = 0;     ///< Cauchy B [µm²]
    glm::dvec3 absorption{0};  ///< σ_a [1/unit]
    glm::dvec3 scattering{0};  ///< σ_s [1/unit]
    double anisotropy = 0;     ///< Henyey-Greenstein g [1]
    glm::dvec3 emission{0};    ///< [radiance/unit]
    double opacity = 0;        ///< 1: the viewing ray stops there [1]
    glm::dvec3 albedo{0};      ///< diffuse reflectance of what is opaque [1]
    glm::dvec3 reflectance{1}; ///< tint of the mirror reflection at the boundary [1]
    double roughness = 0;      ///< GGX's α of the boundary, with sharp boundaries alone [1]
    std::optional<volume::Metal> metal{};     ///< opaque, and a mirror; the same
    std::optional<volume::Crystal> crystal{}; ///< uniaxial, `ior` being n_o; the same
};

struct Object {
    std::string name; ///< in messages, and in sdf.NAME, ior.NAME and so on
    Material material;
    int priority = 0; ///< where objects overlap the higher wins, among equals the later
    mesh::TriangleMesh mesh{};
    bool fillBelow = false; ///< an open mesh is filled below (-Y), however its faces look
    bool isGround = false;  ///< it goes on beyond the domain, which is not laid around it
};

struct Params {
    std::vector<Object> objects;
    Material medium;                 ///< what surrounds the objects
    int resolution = 128;            ///< along the domain's longest edge, padding included [voxel]
    std::optional<double> voxelSize; ///< instead of `resolution` [unit]
    std::optional<int> padding;      ///< around the objects, on all sides; none: kUsualPadding, but
                                     ///< a quarter of `resolution` at most [voxel]
    bool cube = false;               ///< as long along every axis as along the longest
    std::optional<mesh::Box> bounds; ///< the domain, instead of objects and padding [unit]
    std::optional<volume::Ground> ground; ///< an infinite plane, see addGround()
    std::optional<double> groundMargin; ///< beside the objects, for shadows and caustics; none: as
                                        ///< much as they extend sideways [unit]
    int supersample = 4;                ///< samples along a voxel's edge: 1, 2, 4 or 8
    bool sharp = true;                  ///< each object's level set and own values are written, too
    double sdfBand = 6;                 ///< half width of the level sets [voxel]
    double smooth =
        mesh::kUsualSmooth; ///< facets that meet at no more are curved; 0: none [degree]

    /// Throws UsageError naming the option that is wrong.
    void check() const;
    /// The same of the ground alone.
    void checkGround() const;
};

/// Whether an object may be called so: names become parts of grids' names, which --grids lists by
/// commas and OpenVDB numbers by [0]. Dots are fine, since a grid's own name has none.
bool isObjectName(const std::string& name);

// Room for what blurs an object's boundary or bends light beside it. [voxel]
constexpr int kUsualPadding = 8;

// One texel either side is left of the 2048 that every OpenGL 4.5 device has along a 3-D texture.
constexpr int kLongestEdge = 2046;

// Voxel sizes [unit] that files can hold, and later stages square and cube in floats.
constexpr double kSmallestVoxel = volume::kLeastVoxelSize, kLargestVoxel = 1e12;

/// How many objects with sharp boundaries the later stages take.
int mostSharpObjects();

/// More objects of a file than these are made one where nothing tells them apart: light is the
/// same, and the fewer boundaries there are to look for the sooner it is traced.
constexpr size_t kMostAlike = 12;

/// Throws UsageError for more objects with sharp boundaries than the later stages take.
void requireSharpCount(size_t objects);

/// Which of the objects one is, and which of the files it comes from.
struct Place {
    size_t object, objects; ///< its number, and how many there are
    size_t file, files;
};

/// The message of forObject().
[[noreturn]] void refuseCount(const std::string& option, size_t given, const Place& place);

/// The value for an object of those `given`: once for all, once for each file, or once for each
/// object. Throws UsageError for any other number of them.
template<typename T>
const T& forObject(const std::string& option, const std::vector<T>& given, const Place& place) {
    if (given.size() == place.objects) return given[place.object];
    if (given.size() == place.files) return given[place.file];
    if (given.size() != 1) refuseCount(option, given.size(), place);
    return given.front();
}

} // namespace eikonal::voxelize
