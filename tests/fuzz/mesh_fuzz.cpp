// Mesh files of every format, and what is made of them: the first byte chooses the format.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "mesh/repair.h"
#include "mesh/smooth_surface.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace eikonal;

/// A folder for each process, since libFuzzer may run several side by side.
struct Folder {
    Folder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "mesh_fuzz.XXXXXX").string();
        path = ::mkdtemp(pattern.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

/// What is closed stays so however it is curved.
void curve(const mesh::TriangleMesh& flat) {
    const mesh::Box box = mesh::boundingBox(flat);
    const double sagitta = 1e-3 * glm::distance(box.min, box.max);
    mesh::SmoothCounts counts;
    const mesh::TriangleMesh curved = mesh::curved(flat, mesh::findFans(flat, 60), sagitta, counts);
    const mesh::MeshReport report = mesh::checkTopology(curved);
    if (!report.closed || !report.oriented) std::abort();
    for (const glm::dvec3& point : curved.points)
        if (glm::any(glm::isnan(point))) std::abort();
}

std::string fileWith(const std::string& ending, const std::uint8_t* bytes, std::size_t size) {
    static const Folder folder;
    const std::filesystem::path path = folder.path / ("a" + ending);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    return path.string();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr std::array<const char*, 5> kEndings = {".obj", ".off", ".ply", ".stl", ""};
    if (size == 0) return 0;
    const std::string path = fileWith(kEndings[bytes[0] % kEndings.size()], bytes + 1, size - 1);
    try {
        for (const mesh::Part& part : mesh::readParts(path)) {
            // Searches in what is large take long, and find nothing that the small does not hold.
            if (part.mesh.triangles.size() > 200) continue;
            const mesh::MeshReport report = mesh::checkMesh(part.mesh);
            const mesh::RepairResult repaired = mesh::repairMesh(part.mesh);
            if (report.boundsVolume() && report.duplicateFaces + report.degenerateFaces == 0 &&
                !repaired.actions.empty())
                std::abort(); // what is sound stays as it is
            if (mesh::checkMesh(repaired.mesh).boundsVolume()) curve(repaired.mesh);
        }
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
