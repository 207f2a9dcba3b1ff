// Whether a mesh may be voxelised: checked, repaired where asked for, else refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/accept.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/check.h"
#include "mesh/repair.h"

#include <cmath>

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

/// What was done to a sheet.
std::string closingOf(const mesh::ClosedSheet& closed, bool below) {
    return "open sheet, closed outside the domain from " + std::to_string(closed.rimEdges) +
           " edges with a single face: filled " + (below ? "below it" : "behind its faces") +
           (closed.turned ? ", all of which were turned over to look up" : "");
}

/// Closes an open mesh, or gives the reason why not.
std::string closeAsSheet(mesh::TriangleMesh& mesh, const mesh::SheetDomain& domain,
                         Acceptance& result) {
    const mesh::ClosedSheet closed = mesh::closeSheet(mesh, domain);
    if (!closed.fault.empty()) return closed.fault;
    const mesh::MeshReport after = mesh::checkTopology(mesh);
    if (!after.closed || !after.oriented) throw InternalError("a sheet was not closed");
    result.closing = closingOf(closed, domain.below);
    return "";
}

} // namespace

Acceptance acceptMesh(mesh::TriangleMesh& mesh, const std::string& path, bool repair,
                      const std::optional<mesh::SheetDomain>& sheet) {
    const mesh::MeshReport report = mesh::checkMesh(mesh);
    Acceptance result{report.sentences(), {}, {}, warningsOf(report)};
    const bool below = sheet && sheet->below;
    if (report.boundsVolume()) {
        if (below) result.warnings.push_back("is closed: --fill-below does nothing");
        return result;
    }
    std::string faults = faultsOf(report), help;
    if (report.boundaryEdges > 0) {
        help = sheet ? "or an open one that ends at the domain's faces or beyond, "
                       "filled behind its faces or by --fill-below"
                     : "or an open one with --bounds, the domain at whose faces it ends, filled "
                       "behind its faces or by --fill-below";
        const std::string fault = sheet ? closeAsSheet(mesh, *sheet, result) : "";
        if (sheet && fault.empty()) return result;
        faults += (fault.empty() ? "" : "; ") + fault;
        help = ", " + help;
    }
    if (!repair || below)
        throw DataError(path + ": bounds no volume: " + faults +
                        " (expected a closed surface whose faces all look outward" + help +
                        "; --repair " + (report.closed ? "turns" : "closes") + " it)");
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
    const double kMuch = 0.25;
    if (repaired.filled > kMuch)
        result.warnings.push_back(
            "what fills its holes is " + toText(std::round(100 * repaired.filled)) +
            " % of the surface that was there: is it the object that was meant?");
    result.repairs.push_back("repaired: " + after.sentences().front());
    return result;
}

} // namespace eikonal::voxelize
