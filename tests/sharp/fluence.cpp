// Light under a ball of glass: what lightsim makes of it, what Snell and Fresnel do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluence.h"

#include "support/glass_volume.h"
#include "support/lit.h"

namespace eikonal::sharp {

namespace {

constexpr double kSide = 1.6, kRadius = 0.5; // [unit]
const dvec3 kCentre(0.71, 1.02, 0.76);       // [unit]
const dvec3 kSun(0.3, -1, 0.15);

judge::Glass ballOf(double voxelSize) {
    return {{judge::glassBall(kCentre / voxelSize, kRadius / voxelSize, 1.5)}};
}

/// The judge's fluence in the plane, smoothed along all three axes. Photons of plain light so many
/// to a voxel that their own error, smallest where light is dense, does not count.
std::vector<double> wantedIn(int voxels, int plane) {
    const judge::Glass glass = ballOf(kSide / voxels);
    const judge::Grid slab{{0, plane - 1, 0}, 1, {voxels, 3, voxels}};
    const double disc = 4.5 * voxels * voxels; // about what the scene's sphere has [voxel²]
    const judge::Beam beam{.direction = kSun, .photons = 200 * disc};
    const std::vector<double> fluence = judge::beamFluence(glass, beam, slab);
    std::vector<double> smooth;
    for (int z = 0; z < voxels; ++z)
        for (int x = 0; x < voxels; ++x) {
            double sum = 0;
            for (int i = 0; i < 27; ++i) {
                const ivec3 shift(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
                const ivec3 at(std::clamp(x + shift.x, 0, voxels - 1), 1 + shift.y,
                               std::clamp(z + shift.z, 0, voxels - 1));
                double weight = 1;
                for (int axis = 0; axis < 3; ++axis) weight *= shift[axis] == 0 ? 0.5 : 0.25;
                sum += weight * fluence[slab.cell(at)];
            }
            smooth.push_back(sum);
        }
    return smooth;
}

} // namespace

double fluenceError(int voxels, std::int64_t photons) {
    const double h = kSide / voxels;
    const int plane = static_cast<int>((kCentre.y - 0.75) / h);
    const volume::Volume volume = volumeOf(ballOf(h), {.size = ivec3(voxels), .voxelSize = h});
    lightsim::Params params = lightsim::paramsOf({lightsim::beam(kSun)}, photons);
    params.tracing.boundary = optics::Boundary::sharp;
    params.outputs = lightsim::Output::fluence;
    params.smoothing = 1;
    const lightsim::Lit lit(volume, params);
    const std::vector<double> wanted = wantedIn(voxels, plane);
    double off = 0, all = 0;
    for (int z = 0; z < voxels; ++z)
        for (int x = 0; x < voxels; ++x) {
            const double truth = wanted[static_cast<size_t>(z) * voxels + x];
            const double error = lit.fluence({x, plane, z}) - truth;
            off += error * error, all += truth * truth;
        }
    return std::sqrt(off / all);
}

} // namespace eikonal::sharp
