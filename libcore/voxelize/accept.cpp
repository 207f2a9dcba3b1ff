// Whether a mesh may be voxelised: checked, repaired where asked for, else refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/accept.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/check.h"
#include "mesh/repair.h"

namespace eikonal::voxelize {

namespace {

/// The faults, without the size that leads the sentences.
std::string faultsOf(const mesh::MeshReport& report) {
    std::vector<std::string> sentences = report.sentences();
    sentences.erase(sentences.begin());
    return join(sentences, "; ");
}

/// Where the volume is read by a rule that its maker may not know.
std::vector<std::string> warningsOf(const mesh::MeshReport& report) {
    std::vector<std::string> warnings;
    if (report.selfIntersectingPairs > 0)
        warnings.push_back("triangles cross each other: what lies between them counts as inside "
                           "where the surface winds around it");
    if (report.buried > 0)
        warnings.push_back(std::to_string(report.buried) +
                           (report.buried == 1
                                ? " closed part looks outward within another and is"
                                : " closed parts look outward within others and are") +
                           " solid like it, volume " + toText(static_cast<float>(report.volume)) +
                           ": the faces of a cavity look inward");
    return warnings;
}

} // namespace

Acceptance acceptMesh(mesh::TriangleMesh& mesh, const std::string& path, bool repair) {
    const mesh::MeshReport report = mesh::checkMesh(mesh);
    Acceptance result{report.sentences(), {}, warningsOf(report)};
    if (report.boundsVolume()) return result;
    if (!repair)
        throw DataError(path + ": bounds no volume: " + faultsOf(report) +
                        " (expected a closed surface whose faces all look outward; --repair " +
                        (report.closed ? "turns" : "closes") + " it)");
    mesh::RepairResult repaired = mesh::repairMesh(mesh);
    const mesh::MeshReport after = mesh::checkMesh(repaired.mesh);
    if (!after.boundsVolume())
        throw DataError(path + ": bounds no volume, even repaired: " + faultsOf(after) +
                        " (expected a closed surface around some space)");
    if (!repaired.loss.empty())
        throw DataError(path + ": repaired, it would be another object: " + repaired.loss +
                        " (expected a surface that is whole but for holes and rounding)");
    mesh = std::move(repaired.mesh);
    result.repairs = std::move(repaired.actions);
    result.warnings = warningsOf(after);
    result.repairs.push_back("repaired: " + after.sentences().front());
    return result;
}

} // namespace eikonal::voxelize
