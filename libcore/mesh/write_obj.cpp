// Meshes as OBJ: what the other tools and programs read.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/write_obj.h"

#include <charconv>

namespace eikonal::mesh {

void writeObj(std::ostream& out, const TriangleMesh& mesh, const std::string& comment) {
    out << "# " << comment << "\n";
    std::array<char, 128> line{};
    for (const glm::dvec3& point : mesh.points) {
        char* end = line.data();
        *end++ = 'v';
        for (int axis = 0; axis < 3; ++axis) {
            *end++ = ' ';
            // Without 0, which turns -0 into 0.
            end = std::to_chars(end, line.data() + line.size(), point[axis] + 0.0,
                                std::chars_format::general, 9)
                      .ptr;
        }
        *end++ = '\n';
        out.write(line.data(), end - line.data());
    }
    for (const glm::uvec3& face : mesh.triangles)
        out << "f " << face.x + 1 << ' ' << face.y + 1 << ' ' << face.z + 1 << '\n';
}

} // namespace eikonal::mesh
