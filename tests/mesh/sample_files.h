// One box in every format, and a folder to write it to.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace eikonal::mesh {

/// Writes mesh files, reads them, and keeps what is said of bad ones.
class MeshFileTest : public ScratchTest {
protected:
    std::string write(const std::string& name, const std::string& bytes) {
        putBytes(name, bytes);
        return at(name);
    }

    /// The message of the DataError that reading the file throws.
    std::string refusal(const std::string& name, const std::string& bytes) {
        const std::string path = write(name, bytes);
        ::testing::internal::CaptureStderr();
        ::testing::internal::CaptureStdout();
        std::string message = "(read without complaint)";
        try {
            readMesh(path);
        } catch (const DataError& error) {
            message = error.what();
            EXPECT_EQ(message.rfind(path, 0), 0u) << message;
            EXPECT_NE(message.find("expected"), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
        EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
        return message;
    }
};

template<typename Number> std::string rawBytes(Number number, bool swapped = false) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// Not a cube, so that swapped axes show; coordinates that a float holds.
inline TriangleMesh sample() {
    return boxShape({0, 0.5, -1}, {1, 2.5, 3});
}

inline void expectSample(const TriangleMesh& mesh) {
    const MeshReport report = checkMesh(mesh);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.points, 8u);
    EXPECT_EQ(report.triangles, 12u);
    EXPECT_DOUBLE_EQ(report.volume, 8);
    EXPECT_EQ(boundingBox(mesh).min, glm::dvec3(0, 0.5, -1));
    EXPECT_EQ(boundingBox(mesh).max, glm::dvec3(1, 2.5, 3));
}

inline std::string coordinates(const TriangleMesh& mesh, const std::string& before) {
    std::ostringstream out;
    for (const glm::dvec3& p : mesh.points)
        out << before << p.x << ' ' << p.y << ' ' << p.z << '\n';
    return out.str();
}

inline std::string indices(const TriangleMesh& mesh, const std::string& before, unsigned base) {
    std::ostringstream out;
    for (const glm::uvec3& face : mesh.triangles)
        out << before << face.x + base << ' ' << face.y + base << ' ' << face.z + base << '\n';
    return out.str();
}

inline std::string asciiPly() {
    return "ply\nformat ascii 1.0\ncomment a box\nelement vertex 8\nproperty float x\n"
           "property double y\nproperty int8 z\nelement face 12\n"
           "property list uchar int vertex_indices\nend_header\n";
}

inline std::string binaryPly(bool big) {
    const TriangleMesh mesh = sample();
    std::string bytes = "ply\nformat binary_" + std::string(big ? "big" : "little") +
                        "_endian 1.0\nelement extra 2\nproperty list uint8 int16 junk\n"
                        "element vertex 8\nproperty double x\nproperty uchar red\n"
                        "property float y\nproperty int z\nelement face 12\n"
                        "property list uchar uint vertex_index\nproperty float quality\n"
                        "end_header\n";
    for (int i = 0; i < 2; ++i)
        bytes += rawBytes(std::uint8_t(1)) + rawBytes(std::int16_t(-3), big);
    for (const glm::dvec3& p : mesh.points)
        bytes += rawBytes(p.x, big) + rawBytes(std::uint8_t(255)) + rawBytes(float(p.y), big) +
                 rawBytes(std::int32_t(p.z), big);
    for (const glm::uvec3& face : mesh.triangles) {
        bytes += rawBytes(std::uint8_t(3));
        for (int k = 0; k < 3; ++k) bytes += rawBytes(face[k], big);
        bytes += rawBytes(1.5f, big);
    }
    return bytes;
}

inline std::string binaryStl(const std::string& title) {
    const TriangleMesh mesh = sample();
    std::string bytes = title + std::string(80 - title.size(), ' ') + rawBytes(std::uint32_t(12));
    for (const glm::uvec3& face : mesh.triangles) {
        bytes += std::string(12, '\0');
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                bytes += rawBytes(static_cast<float>(mesh.points[face[k]][axis]));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

inline std::string asciiStl() {
    const TriangleMesh mesh = sample();
    std::ostringstream out;
    out << "solid a vertex in the name\n";
    for (const glm::uvec3& face : mesh.triangles) {
        out << " facet normal 0 0 0\n  outer loop\n";
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.points[face[k]];
            out << "   vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        }
        out << "  endloop\n endfacet\n";
    }
    out << "endsolid\n";
    return out.str();
}

} // namespace eikonal::mesh
