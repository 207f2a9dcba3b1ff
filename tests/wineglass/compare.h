// Rays through a wine glass, as render traced them and as Snell's law has them on the exact
// surface. SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/camera.h"
#include "image/image.h"
#include "judge/revolved.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace wineglass {

using glm::dvec3;

struct Setting {
    judge::Revolved glass;        ///< [mm]
    eikonal::camera::Camera camera; ///< of the picture
    double voxel = 1;             ///< of the volume that was rendered [mm]
    double bowl = 60;             ///< above this y the glass is a wall of 1 mm [mm]
    /// The domain, where it is but a part of the glass: rays count that meet the glass within it
    /// alone, three voxels from its faces.
    dvec3 low{-std::numeric_limits<double>::infinity()};
    dvec3 high{std::numeric_limits<double>::infinity()};
    int mostMet = 32; ///< boundaries, as render's --max-depth
};

/// What a ray does: it meets the rim or the foot's edge, which are rounder than a ball of ten
/// voxels, or the four voxels beside one, as far as a spline feels where the curvature jumps; it
/// goes through the bowl's wall alone; it is refracted elsewhere, too; it is totally reflected at
/// least once.
enum class Course { wall, thick, total, edge };
constexpr std::array<const char*, 4> kCourses = {"wall", "stem and foot", "total reflection",
                                                 "rim and edge"};

/// How far rays are from where they should be.
struct Errors {
    int rays = 0;
    int leftOut = 0;             ///< rays that a thousandth of a voxel changes much
    std::vector<double> degrees; ///< between the directions they leave in, in order [degree]
    std::vector<double> apart;   ///< across the exact ray, where they leave [voxel]
    int close = 0;               ///< of those, by kCloseDegrees and kCloseVoxels
    double set = 0;              ///< the most that the glass sets a ray aside by [mm]
    int reflections = 0;         ///< the most total reflections of a ray
};

/// What counts as the same ray: a pixel of a telephoto lens, and a twentieth of a voxel.
constexpr double kCloseDegrees = 0.02, kCloseVoxels = 0.05;

/// By course. A ray is left out where one a thousandth of a voxel aside meets another number of
/// boundaries, or leaves in a direction that differs by more than 0.011°: what a ball of glass of
/// 26 voxels does at 0.95 of its radius. `aovs` has exit_position and exit_direction of a picture
/// with one sample a pixel. Throws std::invalid_argument where it is of another size.
std::array<Errors, 4> compare(const Setting& setting, const eikonal::image::Image& aovs);

/// The value that such a share of the sorted values does not exceed; 0 of none.
double quantile(const std::vector<double>& sorted, double share);

} // namespace wineglass
