// Fans of faces round a point, between edges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fans.h"

#include "mesh/fit_normals.h"
#include "mesh/groups.h"
#include "mesh/shells.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eikonal::mesh {

namespace {

using glm::dvec3;

// Files have normals to three decimals and more: so far apart two may be that are meant to be one.
const double kSameNormal = std::cos(glm::radians(0.1));

dvec3 unit(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : dvec3(0);
}

dvec3 areaOf(const TriangleMesh& mesh, size_t face) {
    const glm::uvec3& f = mesh.triangles[face];
    return glm::cross(mesh.points[f.y] - mesh.points[f.x], mesh.points[f.z] - mesh.points[f.x]);
}

/// The normals of faces; 0 of one of no area, whose normal rounding made.
std::vector<dvec3> faceNormals(const TriangleMesh& mesh) {
    std::vector<dvec3> normals;
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const glm::uvec3& face = mesh.triangles[f];
        const dvec3 area = areaOf(mesh, f);
        const double longest = std::max({glm::distance(mesh.points[face.x], mesh.points[face.y]),
                                         glm::distance(mesh.points[face.y], mesh.points[face.z]),
                                         glm::distance(mesh.points[face.z], mesh.points[face.x])});
        normals.push_back(glm::length(area) > 1e-9 * longest * longest ? unit(area) : dvec3(0));
    }
    return normals;
}

/// Finds the fans: corners are numbered 3 · face + k, and joined.
class Finder {
public:
    Finder(const TriangleMesh& mesh, double degrees)
        : mMesh(mesh), mNormals(faceNormals(mesh)), mCosine(std::cos(glm::radians(degrees))),
          mGroups(3 * mesh.triangles.size()) {}

    Fans run() {
        const std::vector<FaceEdge> edges = sortedEdges(mMesh);
        for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            end = endOfEdge(edges, begin);
            if (end - begin == 2) joinAcross(edges[begin], edges[begin + 1]);
        }
        Fans fans = number();
        weigh(fans);
        const std::vector<char> own = useOwn(fans);
        fitNormals(mMesh, own, fans);
        partTips(fans);
        return fans;
    }

private:
    std::uint32_t cornerAt(std::uint32_t face, std::uint32_t point) const {
        const glm::uvec3& f = mMesh.triangles[face];
        return 3 * face + (f.x == point ? 0 : f.y == point ? 1 : 2);
    }

    /// The mesh's own normal at a corner, on the face's side whatever way it looks; 0: none.
    dvec3 ownAt(std::uint32_t corner) const {
        if (mMesh.normals.empty()) return dvec3(0);
        const dvec3 own = unit(mMesh.normals[corner / 3][corner % 3]);
        return glm::dot(own, mNormals[corner / 3]) < 0 ? -own : own;
    }

    bool sameOwn(std::uint32_t a, std::uint32_t b) const {
        const dvec3 p = ownAt(a), q = ownAt(b);
        return (p == dvec3(0) && q == dvec3(0)) || glm::dot(p, q) > kSameNormal;
    }

    void joinAcross(const FaceEdge& a, const FaceEdge& b) {
        const dvec3 &p = mNormals[a.face], &q = mNormals[b.face];
        const std::uint32_t lowA = cornerAt(a.face, a.low), lowB = cornerAt(b.face, b.low),
                            highA = cornerAt(a.face, a.high), highB = cornerAt(b.face, b.high);
        if (a.rising == b.rising || p == dvec3(0) || q == dvec3(0) || glm::dot(p, q) < mCosine) {
            mParted.insert(mParted.end(), {{lowA, lowB}, {highA, highB}});
            return;
        }
        if (!sameOwn(lowA, lowB) || !sameOwn(highA, highB)) return;
        mGroups.join(lowA, lowB);
        mGroups.join(highA, highB);
    }

    Fans number() {
        Fans fans;
        fans.of.resize(mMesh.triangles.size());
        const std::vector<std::uint32_t> roots = mGroups.roots();
        std::vector<std::uint32_t> numbers(roots.size());
        std::uint32_t count = 0;
        for (std::uint32_t corner = 0; corner < roots.size(); ++corner) {
            const std::uint32_t root = roots[corner];
            if (root == corner) numbers[corner] = count++;
            fans.of[corner / 3][static_cast<int>(corner % 3)] = numbers[root];
        }
        fans.normals.assign(count, dvec3(0));
        fans.angles.assign(count, 0);
        return fans;
    }

    static std::uint32_t fanOf(const Fans& fans, std::uint32_t corner) {
        return fans.of[corner / 3][static_cast<int>(corner % 3)];
    }

    template<typename Act> void eachCorner(const Fans& fans, const Act& act) const {
        for (std::uint32_t corner = 0; corner < 3 * mNormals.size(); ++corner)
            if (mNormals[corner / 3] != dvec3(0)) act(corner, fanOf(fans, corner));
    }

    void weigh(Fans& fans) const {
        eachCorner(fans, [&](std::uint32_t corner, std::uint32_t fan) {
            const glm::uvec3& f = mMesh.triangles[corner / 3];
            const int k = static_cast<int>(corner % 3);
            const dvec3 &x = mMesh.points[f[k]], a = mMesh.points[f[(k + 1) % 3]] - x,
                        b = mMesh.points[f[(k + 2) % 3]] - x;
            fans.normals[fan] += glm::cross(a / glm::dot(a, a), b / glm::dot(b, b));
            fans.angles[fan] += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        });
        for (dvec3& normal : fans.normals) normal = unit(normal);
    }

    /// Takes the mesh's own normals where all corners of a fan have one that fits their face. Those
    /// that are the faces' but for a file's rounding are known better; those that are the same
    /// beyond an edge that is kept would round it. Gives which fans have taken.
    std::vector<char> useOwn(Fans& fans) const {
        std::vector<char> taken(fans.normals.size(), 0), rounds(fans.normals.size(), 0);
        if (mMesh.normals.empty()) return taken;
        for (const auto& [a, b] : mParted) {
            const std::uint32_t fanA = fanOf(fans, a), fanB = fanOf(fans, b);
            if (fanA != fanB && sameOwn(a, b)) rounds[fanA] = rounds[fanB] = 1;
        }
        std::vector<dvec3> sums(fans.normals.size(), dvec3(0));
        std::vector<double> least(fans.normals.size(), 1); // cosine between own and a face's
        eachCorner(fans, [&](std::uint32_t corner, std::uint32_t fan) {
            const dvec3 own = ownAt(corner);
            sums[fan] += own;
            least[fan] = std::min(least[fan], glm::dot(own, mNormals[corner / 3]));
        });
        for (size_t fan = 0; fan < sums.size(); ++fan)
            if (!rounds[fan] && least[fan] >= mCosine && least[fan] < kSameNormal) {
                fans.normals[fan] = unit(sums[fan]);
                taken[fan] = 1;
            }
        return taken;
    }

    void partTips(Fans& fans) const {
        std::vector<char> isTip(fans.normals.size(), 0);
        eachCorner(fans, [&](std::uint32_t corner, std::uint32_t fan) {
            if (glm::dot(fans.normals[fan], mNormals[corner / 3]) < mCosine) isTip[fan] = 1;
        });
        eachCorner(fans, [&](std::uint32_t corner, std::uint32_t fan) {
            if (!isTip[fan]) return;
            fans.of[corner / 3][static_cast<int>(corner % 3)] =
                static_cast<std::uint32_t>(fans.normals.size());
            fans.normals.push_back(mNormals[corner / 3]);
            fans.angles.push_back(0);
        });
    }

    const TriangleMesh& mMesh;
    std::vector<dvec3> mNormals;
    double mCosine;
    Groups mGroups;                                               ///< of corners
    std::vector<std::pair<std::uint32_t, std::uint32_t>> mParted; ///< corners beside kept edges
};

/// A face of one of several meshes by where its corners are.
struct Placed {
    std::array<dvec3, 3> corners; ///< in an order that depends on where they are alone
    std::array<std::uint32_t, 3> fans;
    std::uint32_t mesh;
};

bool isBefore(const dvec3& a, const dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

Placed placed(const TriangleMesh& mesh, const Fans& fans, size_t face, size_t number) {
    std::array<int, 3> order = {0, 1, 2};
    const auto at = [&](int k) { return mesh.points[mesh.triangles[face][k]]; };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return isBefore(at(a), at(b)); });
    Placed result{{}, {}, static_cast<std::uint32_t>(number)};
    for (size_t k = 0; k < 3; ++k) {
        result.corners[k] = at(order[k]);
        result.fans[k] = fans.of[face][order[k]];
    }
    return result;
}

bool isBefore(const Placed& a, const Placed& b) {
    for (size_t k = 0; k < 3; ++k)
        if (a.corners[k] != b.corners[k]) return isBefore(a.corners[k], b.corners[k]);
    return a.mesh < b.mesh;
}

} // namespace

Fans findFans(const TriangleMesh& mesh, double degrees) {
    return Finder(mesh, degrees).run();
}

void joinFans(const std::vector<const TriangleMesh*>& meshes, std::vector<Fans>& fans,
              double degrees) {
    std::vector<Placed> faces;
    for (size_t m = 0; m < meshes.size(); ++m)
        for (size_t f = 0; f < meshes[m]->triangles.size(); ++f)
            faces.push_back(placed(*meshes[m], fans[m], f, m));
    std::sort(faces.begin(), faces.end(),
              [](const Placed& a, const Placed& b) { return isBefore(a, b); });
    // By how far each fan's faces are off it at the most a new normal is judged.
    struct Wish {
        std::uint32_t mesh, fan;
        dvec3 normal;
        double angle;
    };
    std::vector<Wish> wishes;
    for (size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].corners != faces[i - 1].corners) continue;
        for (size_t k = 0; k < 3; ++k) {
            Placed *giver = &faces[i - 1], *taker = &faces[i];
            const auto angleOf = [&](const Placed* p) { return fans[p->mesh].angles[p->fans[k]]; };
            // The first of equals but for rounding.
            if (angleOf(taker) > angleOf(giver) + 1e-9) std::swap(giver, taker);
            wishes.push_back({taker->mesh, taker->fans[k],
                              fans[giver->mesh].normals[giver->fans[k]], angleOf(giver)});
        }
    }
    if (wishes.empty()) return;
    std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
        if (a.mesh != b.mesh) return a.mesh < b.mesh;
        return a.fan != b.fan ? a.fan < b.fan : a.angle > b.angle;
    });
    const double cosine = std::cos(glm::radians(degrees));
    for (size_t i = 0; i < wishes.size(); ++i) {
        const Wish& wish = wishes[i];
        if (i > 0 && wishes[i - 1].mesh == wish.mesh && wishes[i - 1].fan == wish.fan) continue;
        dvec3& normal = fans[wish.mesh].normals[wish.fan];
        const dvec3 wanted = glm::dot(normal, wish.normal) < 0 ? -wish.normal : wish.normal;
        if (glm::dot(normal, wanted) >= cosine) normal = wanted;
    }
}

std::vector<CornerNormals> cornerNormals(const Fans& fans) {
    std::vector<CornerNormals> normals;
    normals.reserve(fans.of.size());
    for (const glm::uvec3& of : fans.of)
        normals.push_back({glm::vec3(fans.normals[of.x]), glm::vec3(fans.normals[of.y]),
                           glm::vec3(fans.normals[of.z])});
    return normals;
}

} // namespace eikonal::mesh
