// Media within media from meshes to the picture: every stage in its turn, as the executables do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/params.h"
#include "support/look.h"
#include "voxelize/params.h"

#include <functional>

namespace eikonal::embedded {

using glm::dvec3;
using optics::Boundary;

constexpr double kPi = 3.14159265358979323846;
constexpr double kVoxel = 1.0 / 16;        // [unit]
constexpr double kSoftness = 1.5 * kVoxel; // standard deviation of volsmooth's Gaussian [unit]

/// An axis-aligned box of a material.
voxelize::Object boxOf(const std::string& name, const dvec3& low, const dvec3& high,
                       const voxelize::Material& material, int priority = 0);
voxelize::Object ballOf(const std::string& name, const dvec3& centre, double radius,
                        const voxelize::Material& material, int priority = 0);

/// What is opaque and has no coat in a medium of that index.
voxelize::Material mattOf(const dvec3& albedo, double ior = 1);

/// A sun, by the irradiance across its direction [W/m²].
lightsim::Light sunAlong(const dvec3& direction, const dvec3& rgb);

struct Stage {
    std::vector<voxelize::Object> objects;
    voxelize::Material medium{};
    mesh::Box bounds{dvec3(0), dvec3(2, 1.5, 2)}; ///< [unit]

    /// mesh2vol, for blurred boundaries volsmooth as well, and if there are lights lightsim, each
    /// with its defaults but for the voxels' size.
    volume::Volume make(Boundary boundary, const std::vector<lightsim::Light>& lights = {}) const;
};

/// lightsim with its defaults: puts the light that a picture needs into the volume.
void light(volume::Volume& volume, Boundary boundary, const std::vector<lightsim::Light>& lights);

/// A parallel view along `direction` with `target` in its middle.
view::Params viewAlong(Boundary boundary, const dvec3& direction, const dvec3& target,
                       double height, const glm::ivec2& size);

void forEachPixel(const view::Params& params, const std::function<void(int x, int y)>& visit);

/// Where the ray of a pixel begins, on the eye's plane [unit].
dvec3 originOf(const view::Params& params, int x, int y);

/// Every channel of a colour, relative to what is wanted; the pixel is told.
void expectColour(const view::Look& look, int x, int y, const dvec3& wanted, const dvec3& share);

/// In both modes.
class Embedded : public testing::TestWithParam<Boundary> {};
std::string nameOf(const testing::TestParamInfo<Boundary>& info);

} // namespace eikonal::embedded
