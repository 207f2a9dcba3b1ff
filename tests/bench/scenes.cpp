// What the benchmark runs on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

namespace bench {

using namespace eikonal;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

volume::Volume ballVolume(int voxels, bool haze) {
    volume::Frame frame;
    frame.voxelSize = 2.0 / voxels;
    for (int i = 0; i < 3; ++i) {
        frame.worldFromIndex[i][i] = frame.voxelSize;
        frame.worldFromIndex[3][i] = -1 + 0.5 * frame.voxelSize;
    }
    volume::Volume volume(frame);
    const volume::IndexBox box{glm::ivec3(0), glm::ivec3(voxels - 1)};
    const auto count = static_cast<size_t>(box.voxels());
    volume::DenseGrid index{box.size(), 1, std::vector<float>(count)};
    volume::DenseGrid scattering{box.size(), 3, std::vector<float>(3 * count)};
    size_t i = 0;
    for (int z = 0; z < voxels; ++z)
        for (int y = 0; y < voxels; ++y)
            for (int x = 0; x < voxels; ++x, ++i) {
                const glm::dvec3 p = (glm::dvec3(x, y, z) + 0.5) * frame.voxelSize - 1.0;
                // A step blurred by 1.5 voxels, which nine taps reach as in volsmooth's default.
                const double t = (glm::length(p) - 0.5) / (1.5 * frame.voxelSize);
                const double inside = t > 3 ? 0 : t < -3 ? 1 : 0.5 * std::erfc(t / std::sqrt(2.0));
                index.values[i] = static_cast<float>(1 + 0.5 * inside);
                for (size_t c = 0; c < 3; ++c)
                    scattering.values[3 * i + c] = static_cast<float>(0.3 * (1 - inside));
            }
    volume::PutOptions options;
    options.allActive = true;
    options.background = glm::vec3(1);
    volume.put("ior", box, index, options);
    if (haze) volume.put("scattering", box, scattering, {});
    return volume;
}

mesh::TriangleMesh bumpySphere(int triangles) {
    mesh::TriangleMesh mesh = mesh::uvSphere(0.45, static_cast<size_t>(triangles));
    for (glm::dvec3& p : mesh.points)
        p *= 1 + 0.1 * std::sin(20 * p.x) * std::sin(23 * p.y) * std::sin(19 * p.z);
    return mesh;
}

void writeObj(const mesh::TriangleMesh& mesh, const std::string& path) {
    std::ofstream out(path);
    out.precision(17);
    for (const glm::dvec3& p : mesh.points) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (const glm::uvec3& t : mesh.triangles)
        out << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
}

} // namespace bench
