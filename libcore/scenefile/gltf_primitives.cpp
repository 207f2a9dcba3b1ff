// The triangles of a glTF primitive.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/gltf_primitives.h"

#include "scenefile/gltf_accessors.h"

#include <cmath>
#include <numeric>

namespace eikonal::scenefile {

namespace {

// Of a whole scene: some 10 GB of memory.
constexpr size_t kMostTriangles = size_t{1} << 26;

int accessorOf(const tinygltf::Primitive& primitive, const std::string& attribute) {
    const auto found = primitive.attributes.find(attribute);
    return found == primitive.attributes.end() ? -1 : found->second;
}

std::vector<glm::uvec3> trianglesOf(int mode, const std::vector<std::uint32_t>& corners) {
    std::vector<glm::uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        return triangles;
    }
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.emplace_back(corners[i + 1], corners[i + 2], corners[0]);
        else // every other one of a strip the other way round
            triangles.emplace_back(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
    return triangles;
}

glm::vec3 unitOrZero(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    return length > 0 && std::isfinite(length) ? glm::vec3(direction / length) : glm::vec3(0);
}

} // namespace

bool isOfTriangles(const tinygltf::Primitive& primitive) {
    // Without a mode they are triangles.
    return primitive.mode == -1 || primitive.mode == TINYGLTF_MODE_TRIANGLES ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

void addTriangles(const Gltf& file, const tinygltf::Primitive& primitive,
                  const glm::dmat4& worldFromNode, const std::string& where, size_t& sofar,
                  Object& object) {
    const std::string what = "'" + where + "': ";
    if (!primitive.attributes.contains("POSITION")) return; // nothing to see, as glTF has it
    std::vector<glm::dvec3> points =
        readVectors(file, accessorOf(primitive, "POSITION"), what + "POSITION");
    std::vector<glm::dvec3> normals;
    if (primitive.attributes.contains("NORMAL")) {
        normals = readVectors(file, accessorOf(primitive, "NORMAL"), what + "NORMAL");
        if (normals.size() != points.size())
            file.fail(what + "found " + std::to_string(normals.size()) + " normals of " +
                      std::to_string(points.size()) + " points");
    }
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
        corners = readIndices(file, primitive.indices, points.size(), what + "indices");
    } else {
        corners.resize(points.size());
        std::iota(corners.begin(), corners.end(), 0u);
    }
    const int mode = primitive.mode == -1 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    std::vector<glm::uvec3> triangles = trianglesOf(mode, corners);
    sofar += triangles.size();
    if (sofar > kMostTriangles || object.points.size() + points.size() > UINT32_MAX)
        file.fail("its scene has more than " + std::to_string(kMostTriangles) + " triangles");

    const glm::dmat3 linear(worldFromNode);
    const double side = glm::determinant(linear);
    // What mirrors turns triangles inside out.
    if (side < 0)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);
    for (glm::dvec3& point : points) {
        point = glm::dvec3(worldFromNode * glm::dvec4(point, 1));
        for (int k = 0; k < 3; ++k) file.finite(point[k], what + "POSITION");
    }
    // The cofactors turn normals as the inverse's transpose does, up to a length and a sign.
    const glm::dmat3 turn(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                          glm::cross(linear[0], linear[1]));
    for (glm::dvec3& normal : normals) normal = (side < 0 ? -1.0 : 1.0) * (turn * normal);

    const auto first = static_cast<std::uint32_t>(object.points.size());
    if (!normals.empty() || !object.normals.empty())
        object.normals.resize(object.triangles.size(), {}); // of those before, none
    for (const glm::uvec3& t : triangles) {
        object.triangles.push_back(t + first);
        if (!normals.empty())
            object.normals.push_back(
                {unitOrZero(normals[t.x]), unitOrZero(normals[t.y]), unitOrZero(normals[t.z])});
    }
    if (!object.normals.empty()) object.normals.resize(object.triangles.size(), {});
    object.points.insert(object.points.end(), points.begin(), points.end());
}

} // namespace eikonal::scenefile
