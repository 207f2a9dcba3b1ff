// Voxels that receive light: fixed-point sums that become fluence and mean direction.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "lightsim/plan.h"
#include "lightsim/result.h"
#include "lightsim/shared.h"
#include "lightsim/sources.h"

namespace eikonal::lightsim {

/// The largest fixed-point unit, a power of two, with which every photon of a batch may cross one
/// voxel from corner to corner and still leave an eighth of the range free (kNearFull in
/// shaders/lightsim/deposit.glsl). Not above 2^24, the digits of a float: a deposit then fits an
/// int, too.
double unitFor(double photons);

/// How bricks that receive light lie in an atlas of so many planes: a brick's planes one behind the
/// other along z, or where all receive, as they lie in the domain, plane behind plane.
struct AtlasLayout {
    glm::ivec3 bricks{1}; ///< along each axis, of one plane
    bool sparse = false;

    /// The texels of `planes`.
    glm::ivec3 texels(int planes) const {
        return bricks * volume::kBrick * glm::ivec3(1, 1, planes);
    }
    /// How many bricks apart those along z are.
    int apart(int planes) const { return sparse ? planes : 1; }
    /// How many texels apart planes are.
    int planesApart() const { return sparse ? volume::kBrick : bricks.z * volume::kBrick; }
};
AtlasLayout atlasOf(const Plan& plan);

class VoxelReceiver {
public:
    VoxelReceiver(gpu::Device& device, const Plan& plan, const Params& params);

    /// What deposits go to, and the table of bricks.
    void bind() const;
    void clearPlanes();
    /// Adds what the planes hold to the totals, and clears them. A photon of weight 1
    /// has that power, `unit` stands for a voxel's length at weight 1.
    void resolve(gpu::Device& device, const Unit& of, double unit);
    /// Adds light that meets nothing on its way, as Emission::bindPlain() tells, of a source of
    /// that irradiance, or intensity.
    void addPlain(gpu::Device& device, const Plan& plan, const glm::dvec3& rgb, bool isPoint);
    /// Rounds of 3×3×3 smoothing, after which nothing more is received.
    void smooth(gpu::Device& device, int rounds);
    Result download(const Plan& plan) const;

private:
    void dispatch(const gpu::Program& program) const;

    gpu::Program mResolve, mSmooth, mPlain;
    gpu::Buffer mBlock, mTable, mList;
    gpu::Texture mPlanes, mTotals, mOpaque;
    AtlasLayout mAtlas;
    ResolveParams mParams{};
    double mVoxelSize;
};

/// What they take on the device.
std::vector<gpu::Need> voxelNeeds(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
