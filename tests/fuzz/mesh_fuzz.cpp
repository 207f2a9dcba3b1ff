// Mesh files of every format, and what is made of them: the first byte chooses the format.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "mesh/repair.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace {

using namespace eikonal;

/// A file of its own for each process; libFuzzer may run several side by side.
std::string fileWith(const char* ending, const std::uint8_t* bytes, std::size_t size) {
    static const std::string folder = [] {
        std::string pattern = "/tmp/mesh_fuzz.XXXXXX";
        return std::string(::mkdtemp(pattern.data()));
    }();
    const std::string path = folder + "/a" + ending;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) std::abort();
    if (size > 0) std::fwrite(bytes, 1, size, file);
    std::fclose(file);
    return path;
}

} // namespace

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
            static_cast<void>(mesh::checkMesh(repaired.mesh));
        }
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
