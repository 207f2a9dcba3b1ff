// meshgen: closed meshes by recipe, for scenes and tests.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/placement.h"
#include "common/session.h"
#include "kinds.h"
#include "mesh/check.h"
#include "mesh/write_obj.h"

#include <algorithm>

using namespace eikonal;

namespace {

void requireObj(const std::vector<std::string>& paths) {
    if (paths.size() > 1)
        throw UsageError("-o: found " + std::to_string(paths.size()) + " files, expected one");
    for (const std::string& path : paths) {
        const std::string name = baseName(path);
        const size_t point = name.rfind('.');
        std::string ending = point == std::string::npos ? "" : name.substr(point);
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (!ending.empty() && ending != ".obj" && !writtenInPlace(path))
            throw UsageError(path + ": found '" + ending + "', expected .obj, the format written");
    }
}

void makeMesh(tool::Session& session, const std::vector<meshgen::Kind>& kinds,
              const std::string& place) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [](const meshgen::Kind& k) { return k.command->parsed(); });
    requireObj(session.outputPaths());
    session.guardInputs(kind->inputs());
    const glm::dmat4 worldFromOwn =
        place.empty() ? glm::dmat4(1) : tool::parsePlacement(place, false).worldFromOwn;
    mesh::TriangleMesh made;
    session.pass("make", [&] { made = kind->make(session.seed()); });
    for (glm::dvec3& point : made.points) point = worldFromOwn * glm::dvec4(point, 1);
    for (mesh::CornerNormals& normals : made.normals) // the scale is the same along all axes
        for (glm::vec3& normal : normals) normal = glm::normalize(glm::mat3(worldFromOwn) * normal);
    mesh::MeshReport report;
    session.pass("check", [&] { report = mesh::checkTopology(made); });
    if (!kind->isOpen() && !report.boundsVolume())
        throw InternalError("the mesh does not bound a volume: " + join(report.sentences(), "; "));

    const mesh::Box box = mesh::boundingBox(made);
    const auto text = [](const glm::dvec3& v) {
        return toText(static_cast<float>(v.x)) + "," + toText(static_cast<float>(v.y)) + "," +
               toText(static_cast<float>(v.z));
    };
    if (session.explains()) {
        std::vector<std::pair<std::string, std::string>> facts = {
            {"points", std::to_string(report.points)},
            {"triangles", std::to_string(report.triangles)},
            {"components", std::to_string(report.components)},
            {"closed", report.closed ? "yes" : "no"},
            {"from", text(box.min)},
            {"to", text(box.max)},
            {"area", toText(mesh::surfaceArea(made))}};
        if (report.closed) facts.emplace_back("volume", toText(report.volume));
        session.explain({}, {}, facts);
        return;
    }
    AtomicFile& out = *session.outputs().at(0);
    Stats& stats = session.stats();
    stats.count("points", static_cast<double>(report.points));
    stats.count("triangles", static_cast<double>(report.triangles));
    stats.count("components", static_cast<double>(report.components));
    stats.count("area", mesh::surfaceArea(made));
    if (report.closed) stats.count("volume", report.volume);
    session.pass("write", [&] { mesh::writeObj(out.stream(), made, session.history().command); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("meshgen", "Makes a mesh by recipe, as OBJ: closed and oriented, so that "
                                     "mesh2vol takes it as it is.");
    std::string place;
    const std::vector<meshgen::Kind> kinds = meshgen::addKinds(session.app());
    session.app()
        .add_option("--place", place,
                    "scaled by S, turned about X, then Y, then Z [degree], and shifted [unit]")
        ->type_name("TX,TY,TZ[:RX,RY,RZ[:S]]");
    session.app().set_help_all_flag("--help-all", "print the help of every KIND, too, and stop");
    session.app().footer("meshgen KIND --help has the options of a kind. Options of both may stand "
                         "in any order behind KIND.");
    return session.run(argc, argv, [&](tool::Session&) { makeMesh(session, kinds, place); });
}
