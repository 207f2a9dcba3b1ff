// Meshes as OBJ: what the other tools and programs read.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/write_obj.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

namespace eikonal::mesh {

namespace {

void writeVector(std::ostream& out, std::string_view key, const glm::dvec3& vector) {
    std::array<char, 128> line{};
    char* end = std::copy(key.begin(), key.end(), line.data());
    for (int axis = 0; axis < 3; ++axis) {
        *end++ = ' ';
        // With 0, which turns -0 into 0.
        end = std::to_chars(end, line.data() + line.size(), vector[axis] + 0.0,
                            std::chars_format::general, 9)
                  .ptr;
    }
    *end++ = '\n';
    out.write(line.data(), end - line.data());
}

} // namespace

void writeObj(std::ostream& out, const TriangleMesh& mesh, const std::string& comment) {
    out << "# " << comment << "\n";
    for (const glm::dvec3& point : mesh.points) writeVector(out, "v", point);
    if (!mesh.normals.empty()) {
        // A normal that several corners have is written once.
        std::map<std::array<float, 3>, size_t> numbers;
        std::vector<std::array<size_t, 3>> corners;
        for (const CornerNormals& normals : mesh.normals) {
            corners.emplace_back();
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3& n = normals[k];
                const auto [known, added] =
                    numbers.try_emplace({n.x, n.y, n.z}, numbers.size() + 1);
                if (added) writeVector(out, "vn", n);
                corners.back()[k] = known->second;
            }
        }
        for (size_t f = 0; f < mesh.triangles.size(); ++f) {
            out << 'f';
            for (int k = 0; k < 3; ++k)
                out << ' ' << mesh.triangles[f][k] + 1 << "//"
                    << corners[f][static_cast<size_t>(k)];
            out << '\n';
        }
        return;
    }
    for (const glm::uvec3& face : mesh.triangles)
        out << "f " << face.x + 1 << ' ' << face.y + 1 << ' ' << face.z + 1 << '\n';
}

} // namespace eikonal::mesh
