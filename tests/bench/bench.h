// The benchmark's parts: kernels beside bare ones in one process, stages as whole processes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/device.h"
#include "mesh/triangle_mesh.h"
#include "volume/volume.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bench {

using Json = nlohmann::ordered_json;

struct Settings {
    std::string bin;    ///< folder of the tools
    std::string work;   ///< folder for files made on the way
    std::string device; ///< --device
    std::string bunny;  ///< mesh file, or ""
    std::string meshes; ///< folder of pipelines/models.mk, or ""
    int repeats = 5;    ///< of each measurement; the median counts
};

double median(std::vector<double> values);

/// A blurred glass ball of radius ½ in a box of edge 2, index 1.5, with `voxels` along an edge;
/// grey haze outside it if `haze` (σ_s 0.3).
eikonal::volume::Volume ballVolume(int voxels, bool haze);

/// A closed bumpy sphere of about so many triangles, radius at most ½.
eikonal::mesh::TriangleMesh bumpySphere(int triangles);

void writeObj(const eikonal::mesh::TriangleMesh& mesh, const std::string& path);

/// View and photon passes against the bare march and the bare atomic add, in this process.
Json measureKernels(const Settings& settings);
/// Glass at 128³ with sharp boundaries against the same blurred: view and photon passes.
Json measureSharp(const Settings& settings);
/// Fixed cost of every stage on 32³, and at 128³ the shares of reading and writing and of
/// distances; with blurred boundaries and with sharp ones.
Json measureStages(const Settings& settings);
/// Steps and error of the fluence under the octree's options, at 64³.
Json measureSteps(const Settings& settings);
/// Irradiance on a floor under a ball of glass and under waves, by beams and by photons, against
/// the exact one.
Json measureSurfaces(const Settings& settings);
/// Fluence by wavefronts and by photons, through a lens and balls, against that of 2^24 photons.
Json measureFronts(const Settings& settings);
/// Beams under waves with and without their hierarchy: Barczak and Olano's tables 1 and 2.
Json measureHierarchy(const Settings& settings);
/// Methods in image space on six meshes at 512²: Oliveira and Brauwers 2007, table 1.
Json measureImageSpace(const Settings& settings);
/// Look-ups in dense, paged and NanoVDB's distances; not built without NanoVDB's headers.
Json measureSparse(const Settings& settings);
/// Sun et al. 2008, tables 1 and 2: same columns, same sweeps.
Json measureTables(const Settings& settings);

} // namespace bench
