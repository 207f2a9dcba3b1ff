// All triangles of a scene, and which of them a ray meets next: exact tracing's one door to Embree.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace eikonal::raytrace {

/// A triangle of one of the meshes.
struct Face {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t mesh = kNone, triangle = kNone;

    bool operator==(const Face&) const = default;
};

/// A hierarchy of boxes over the triangles of some meshes, which must outlive it. Questions may be
/// asked by many threads.
///
/// Embree searches in single precision, on a copy of the scene that fits a ball of radius 1. What
/// it proposes is decided in double, on the triangles as they are: a ray meets a triangle's plane
/// ahead of its origin or not at all. So a ray that starts on a triangle, where double arithmetic
/// has put it, meets that one never again (it is named) and its neighbours only where they lie
/// ahead, and needs no offset from the surface. What is met within a millionth of the scene's
/// radius counts only if the ray passes it the other way than the triangle it starts on: what is
/// left would be a second crossing of one surface.
class Faces {
public:
    /// Throws MemoryError where Embree gets no memory, InternalError for other faults of it.
    explicit Faces(std::vector<const mesh::TriangleMesh*> meshes);
    ~Faces();
    Faces(Faces&&) noexcept;
    Faces& operator=(Faces&&) noexcept;

    struct Hit {
        Face face;
        double t; ///< distance along the direction [unit]
    };
    /// The nearest triangle that a ray meets; `direction` is of length 1, in world space. `from` is
    /// the triangle that it starts on, if any.
    std::optional<Hit> next(const glm::dvec3& origin, const glm::dvec3& direction,
                            const Face& from = {}) const;

    /// The same among the triangles that `counts` says yes to. It may be asked about others, too.
    using Counts = std::function<bool(const Face&)>;
    std::optional<Hit> next(const glm::dvec3& origin, const glm::dvec3& direction,
                            const Counts& counts) const;

    /// For each mesh, how often it winds around x, by the triangles ahead along one line. Right for
    /// closed meshes; a line through an edge may be off by one.
    std::vector<int> windings(const glm::dvec3& x) const;

    const mesh::TriangleMesh& mesh(const Face& face) const { return *mMeshes[face.mesh]; }

private:
    struct Embree;
    struct Question;
    std::optional<Hit> ask(Question& question) const;

    std::vector<const mesh::TriangleMesh*> mMeshes;
    std::unique_ptr<Embree> mEmbree;
    glm::dvec3 mMiddle{0}; ///< of the scene's box [unit]
    double mRadius = 1;    ///< of the ball about it that holds all triangles [unit]
};

} // namespace eikonal::raytrace
