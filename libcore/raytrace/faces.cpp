// All triangles of a scene, and which of them a ray meets next.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/faces.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>
#include <utility>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

/// A ray and a triangle's plane.
struct Intersection {
    double t;         ///< where they meet [unit]; not finite where the ray runs along the plane
    bool fromOutside; ///< the ray comes from the triangle's outer side
};
Intersection intersect(const mesh::TriangleMesh& mesh, std::uint32_t triangle, const dvec3& origin,
                       const dvec3& direction) {
    const glm::uvec3& face = mesh.triangles[triangle];
    const dvec3 a = mesh.points[face.x];
    const dvec3 area = glm::cross(mesh.points[face.y] - a, mesh.points[face.z] - a);
    const double across = glm::dot(direction, area);
    return {glm::dot(a - origin, area) / across, across < 0};
}

// What is as near to a ray's start as single precision tells apart, and as double does, both as
// shares of the scene's radius.
constexpr double kNear = 1e-6, kSame = 1e-10;

} // namespace

struct Faces::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Embree() = default;
    Embree(const Embree&) = delete;
    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void check(RTCError error) const {
        if (error == RTC_ERROR_NONE) return;
        if (error == RTC_ERROR_OUT_OF_MEMORY)
            throw MemoryError("not enough memory for the tree of boxes over the triangles");
        throw InternalError("Embree: error " + std::to_string(error));
    }
    void check() const { check(rtcGetDeviceError(device)); }
};

/// A ray, and what is asked of it. Embree hands it back with each triangle that it proposes.
struct Faces::Question {
    RTCIntersectContext context; ///< first: the callback gets its address
    const Faces* faces;
    dvec3 origin, direction;
    Face from{};
    const Counts* counts = nullptr;
    std::vector<int>* windings = nullptr; ///< to count all in, and stop at none

    /// Whether the ray meets a triangle that single precision says it does.
    bool accepts(const Face& face) {
        if (face == from) return false;
        const Intersection met = intersect(faces->mesh(face), face.triangle, origin, direction);
        if (!std::isfinite(met.t) || !isAhead(face, met)) return false;
        if (windings) {
            (*windings)[face.mesh] += met.fromOutside ? -1 : 1;
            return false;
        }
        return !counts || (*counts)(face);
    }

    /// Close to a ray's start lie the neighbours of the triangle that it starts on. One that it
    /// passes the same way was passed along with that: both are the surface's one crossing. One
    /// that it passes the other way, as at a corner, may be at the very start.
    bool isAhead(const Face& face, const Intersection& met) const {
        if (from.triangle == Face::kNone || from.mesh != face.mesh ||
            met.t > kNear * faces->mRadius)
            return met.t > 0;
        const Intersection start = intersect(faces->mesh(from), from.triangle, origin, direction);
        return met.fromOutside != start.fromOutside && met.t > -kSame * faces->mRadius;
    }

    static void filter(const RTCFilterFunctionNArguments* arguments) {
        auto* question = reinterpret_cast<Question*>(arguments->context);
        for (unsigned i = 0; i < arguments->N; ++i) {
            if (arguments->valid[i] != -1) continue;
            const Face face{RTCHitN_geomID(arguments->hit, arguments->N, i),
                            RTCHitN_primID(arguments->hit, arguments->N, i)};
            if (!question->accepts(face)) arguments->valid[i] = 0;
        }
    }
};

Faces::Faces(std::vector<const mesh::TriangleMesh*> meshes)
    : mMeshes(std::move(meshes)), mEmbree(std::make_unique<Embree>()) {
    mesh::Box box;
    for (const mesh::TriangleMesh* mesh : mMeshes) box.include(mesh::boundingBox(*mesh));
    if (!box.empty()) {
        mMiddle = 0.5 * (box.min + box.max);
        mRadius = std::max(0.5 * glm::length(box.max - box.min), 1e-300);
    }
    mEmbree->device = rtcNewDevice(nullptr);
    if (!mEmbree->device) mEmbree->check(rtcGetDeviceError(nullptr));
    mEmbree->scene = rtcNewScene(mEmbree->device);
    rtcSetSceneFlags(
        mEmbree->scene,
        static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    for (std::uint32_t m = 0; m < mMeshes.size(); ++m) {
        const mesh::TriangleMesh& mesh = *mMeshes[m];
        RTCGeometry geometry = rtcNewGeometry(mEmbree->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* points = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.points.size()));
        auto* corners = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), mesh.triangles.size()));
        mEmbree->check();
        for (const dvec3& point : mesh.points) {
            const dvec3 place = (point - mMiddle) / mRadius;
            for (int c = 0; c < 3; ++c) *points++ = static_cast<float>(place[c]);
        }
        for (const glm::uvec3& triangle : mesh.triangles)
            for (int c = 0; c < 3; ++c) *corners++ = triangle[c];
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(mEmbree->scene, geometry, m);
        rtcReleaseGeometry(geometry);
    }
    // By one thread: which of two triangles at an edge is found first depends on the tree, which
    // several threads need not make alike.
    tbb::task_arena alone(1);
    alone.execute([&] { rtcJoinCommitScene(mEmbree->scene); });
    mEmbree->check();
}

Faces::~Faces() = default;
Faces::Faces(Faces&&) noexcept = default;
Faces& Faces::operator=(Faces&&) noexcept = default;

std::optional<Faces::Hit> Faces::ask(Question& question) const {
    rtcInitIntersectContext(&question.context);
    question.context.filter = &Question::filter;
    question.faces = this;
    // From where the ray enters the ball: numbers of single precision are coarse far off.
    const dvec3 from = (question.origin - mMiddle) / mRadius;
    const double nearest = -glm::dot(from, question.direction);
    const double half = 1.02 * 1.02 - glm::dot(from + nearest * question.direction,
                                               from + nearest * question.direction);
    if (half <= 0 || nearest + std::sqrt(half) < 0) return std::nullopt;
    // A little before the origin, since what lies just ahead must not round to behind.
    const double kBefore = 2e-6;
    const double skipped = std::max(nearest - std::sqrt(half), 0.0) - kBefore;
    const dvec3 start = from + skipped * question.direction;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x);
    ray.ray.org_y = static_cast<float>(start.y);
    ray.ray.org_z = static_cast<float>(start.z);
    ray.ray.dir_x = static_cast<float>(question.direction.x);
    ray.ray.dir_y = static_cast<float>(question.direction.y);
    ray.ray.dir_z = static_cast<float>(question.direction.z);
    ray.ray.tnear = 0;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(mEmbree->scene, &question.context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Face face{ray.hit.geomID, ray.hit.primID};
    return Hit{face, intersect(mesh(face), face.triangle, question.origin, question.direction).t};
}

std::optional<Faces::Hit> Faces::next(const dvec3& origin, const dvec3& direction,
                                      const Face& from) const {
    Question question{{}, this, origin, direction, from};
    return ask(question);
}

std::optional<Faces::Hit> Faces::next(const dvec3& origin, const dvec3& direction,
                                      const Counts& counts) const {
    Question question{{}, this, origin, direction, {}, &counts};
    return ask(question);
}

std::vector<int> Faces::windings(const dvec3& x) const {
    std::vector<int> found(mMeshes.size(), 0);
    // Along no axis and no diagonal, where edges of boxes and of regular grids lie.
    const dvec3 direction = glm::normalize(dvec3(0.5773, 0.7071, 0.4142));
    Question question{{}, this, x, direction, {}, nullptr, &found};
    ask(question);
    return found;
}

} // namespace eikonal::raytrace
