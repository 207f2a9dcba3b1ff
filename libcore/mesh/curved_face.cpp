// Faces bent to the normals at their corners.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/curved_face.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace eikonal::mesh {

namespace {

using glm::dvec2;
using glm::dvec3;

double squared(const dvec3& v) {
    return glm::dot(v, v);
}

/// The direction of v, or 0.
dvec3 unit(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : dvec3(0);
}

dvec3 without(const dvec3& v, const dvec3& direction) {
    return v - glm::dot(v, direction) * direction;
}

bool isNone(const EdgeNormals& normals) {
    return normals.first == dvec3(0) || normals.second == dvec3(0);
}

/// Where two surfaces with normals p and q meet, as nearly along the chord's direction as can be.
dvec3 tangentOf(const dvec3& p, const dvec3& q, const dvec3& chord) {
    // Surfaces that meet at less than this tell their line by rounding.
    const double kLeastSine = 0.05;
    const dvec3 line = glm::cross(p, q);
    if (glm::length(line) < kLeastSine) return unit(without(chord, unit(p + q)));
    return glm::dot(line, chord) < 0 ? -unit(line) : unit(line);
}

/// Weights u, v of b and c at the point of the triangle a, b, c nearest to x. (Ericson, Real-Time
/// Collision Detection, 5.1.5.)
dvec2 nearestWeights(const dvec3& x, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double d1 = glm::dot(ab, ax), d2 = glm::dot(ac, ax);
    if (d1 <= 0 && d2 <= 0) return {0, 0};
    const double d3 = glm::dot(ab, bx), d4 = glm::dot(ac, bx);
    if (d3 >= 0 && d4 <= d3) return {1, 0};
    const double d5 = glm::dot(ab, cx), d6 = glm::dot(ac, cx);
    if (d6 >= 0 && d5 <= d6) return {0, 1};
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 > d3 ? d1 / (d1 - d3) : 0, 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 > d6 ? d2 / (d2 - d6) : 0};
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double along = d4 - d3, back = d5 - d6;
        const double t = along + back > 0 ? along / (along + back) : 0;
        return {1 - t, t};
    }
    const double area = va + vb + vc;
    return area > 0 ? dvec2(vb, vc) / area : dvec2(0);
}

/// The edges of a mesh's faces with their sides' normals, low end first.
EdgeNormals normalsAt(const TriangleMesh& mesh, const FaceEdge& edge) {
    const glm::uvec3& face = mesh.triangles[edge.face];
    const CornerNormals& normals = mesh.normals[edge.face];
    EdgeNormals found{};
    for (size_t k = 0; k < 3; ++k) {
        const std::uint32_t point = face[static_cast<int>(k)];
        if (point == edge.low) found.first = normals[k];
        if (point == edge.high) found.second = normals[k];
    }
    return found;
}

} // namespace

double EdgeCurve::bulge() const {
    return glm::length(rise) + std::sqrt(3.0) / 18 * glm::length(skew);
}

EdgeCurve smoothCurve(const dvec3& a, const dvec3& b, const EdgeNormals& normals) {
    const dvec3 chord = b - a, sum = normals.first + normals.second;
    const double length = glm::length(sum); // twice the cosine of half the angle between them
    // Normals that are opposite say nothing of what lies between.
    if (isNone(normals) || !(length > 0.1)) return {};
    const dvec3 middle = sum / length, along = unit(chord);
    // Of the chord the part in which the normals turn, by an angle β: its arc rises by half of it
    // times tan(β/4), which for sines and cosines of β/2 needs no angle.
    const double rise = glm::dot(chord, normals.second - normals.first) / (4 + 2 * length);
    return {without(rise * middle, along), without(-glm::dot(middle, chord) * middle, along)};
}

EdgeCurve creaseCurve(const dvec3& a, const dvec3& b, const EdgeNormals& left,
                      const EdgeNormals& right) {
    if (isNone(left) || isNone(right)) return {};
    const dvec3 chord = b - a, along = unit(chord);
    const double length = glm::length(chord);
    const dvec3 first = tangentOf(left.first, right.first, along),
                second = tangentOf(left.second, right.second, along);
    const double c0 = glm::dot(first, along), c1 = glm::dot(second, along);
    const double kLeastCosine = 0.5; // a curve that turned by more would be another edge
    if (!(c0 > kLeastCosine && c1 > kLeastCosine)) return {};
    // Bézier's control points where those of a circle's arc are: length / (3 (1 + c) / 2) along.
    const dvec3 rise = length / (4 + 2 * (c0 + c1)) * (first - second);
    const dvec3 skew = length / 2 * (first / c0 + second / c1 - 2.0 * along);
    return {without(rise, along), without(skew, along)};
}

dvec3 middleNormal(const dvec3& a, const dvec3& b, const EdgeCurve& curve,
                   const EdgeNormals& normals) {
    if (isNone(normals)) return dvec3(0);
    const dvec3 tangent = unit(b - a - 0.5 * curve.skew);
    return unit(without(normals.first + normals.second, tangent));
}

namespace {

/// The curves of all faces' sides, while they are made.
class EdgeCurves {
public:
    EdgeCurves(const TriangleMesh& mesh, const std::vector<FaceEdge>& edges)
        : mMesh(mesh), mEdges(edges), mCurves(mesh.triangles.size()),
          mCreases(mesh.triangles.size()) {}

    std::vector<std::array<EdgeCurve, 3>> run() {
        eachShared([&](size_t begin, size_t end) { bend(begin, end); });
        follow();
        return std::move(mCurves);
    }

private:
    /// Those of one face or that two share.
    template<typename Act> void eachShared(const Act& act) const {
        eachEdge(mEdges, [&](size_t begin, size_t end) {
            if (end - begin <= 2) act(begin, end);
        });
    }

    size_t sideOf(const FaceEdge& edge) const {
        const glm::uvec3& face = mMesh.triangles[edge.face];
        const std::uint32_t start = edge.rising ? edge.low : edge.high;
        return face.x == start ? 0 : face.y == start ? 1 : 2;
    }

    void bend(size_t begin, size_t end) {
        const FaceEdge& edge = mEdges[begin];
        const dvec3 &a = mMesh.points[edge.low], &b = mMesh.points[edge.high];
        const EdgeNormals left = normalsAt(mMesh, edge), right = normalsAt(mMesh, mEdges[end - 1]);
        const bool isSmooth = left.first == right.first && left.second == right.second;
        const EdgeCurve curve = isSmooth ? smoothCurve(a, b, left) : creaseCurve(a, b, left, right);
        for (size_t i = begin; i < end; ++i) {
            const size_t k = sideOf(mEdges[i]);
            mCurves[mEdges[i].face][k] = {curve.rise, mEdges[i].rising ? curve.skew : -curve.skew};
            mCreases[mEdges[i].face][k] = !isSmooth;
        }
    }

    bool hasCreases(std::uint32_t face) const {
        const auto& [a, b, c] = mCreases[face];
        return a || b || c;
    }

    /// The mean rise of a face's kept edges; 0: it has none.
    dvec3 creasesRise(std::uint32_t face) const {
        dvec3 sum(0);
        int count = 0;
        for (size_t k = 0; k < 3; ++k)
            if (mCreases[face][k]) {
                sum += mCurves[face][k].rise;
                ++count;
            }
        return count > 0 ? sum / static_cast<double>(count) : dvec3(0);
    }

    /// Between two kept edges, as across the rim of a thin glass, a smooth edge goes along with
    /// both within the surface: else they would pass over it. By how much.
    dvec3 shiftOf(size_t begin, size_t end) const {
        const FaceEdge &left = mEdges[begin], &right = mEdges[end - 1];
        // Few faces have any.
        if (end - begin < 2 || !hasCreases(left.face) || !hasCreases(right.face) ||
            mCreases[left.face][sideOf(left)])
            return dvec3(0);
        const dvec3 p = creasesRise(left.face), q = creasesRise(right.face);
        if (p == dvec3(0) || q == dvec3(0)) return dvec3(0);
        const EdgeNormals normals = normalsAt(mMesh, left);
        if (isNone(normals)) return dvec3(0);
        const dvec3 along = unit(mMesh.points[left.high] - mMesh.points[left.low]),
                    normal = unit(without(normals.first + normals.second, along));
        return without(without(0.5 * (p + q), along), normal);
    }

    /// Few edges follow others: all are found before the first is moved.
    void follow() {
        std::mutex mutex;
        std::vector<std::pair<size_t, dvec3>> shifts;
        eachShared([&](size_t begin, size_t end) {
            const dvec3 shift = shiftOf(begin, end);
            if (shift == dvec3(0)) return;
            const std::lock_guard lock(mutex);
            shifts.emplace_back(begin, shift);
        });
        for (const auto& [begin, shift] : shifts)
            for (const FaceEdge& edge : {mEdges[begin], mEdges[begin + 1]})
                mCurves[edge.face][sideOf(edge)].rise += shift;
    }

    const TriangleMesh& mMesh;
    const std::vector<FaceEdge>& mEdges;
    std::vector<std::array<EdgeCurve, 3>> mCurves;
    std::vector<std::array<bool, 3>> mCreases; ///< which sides are kept edges
};

} // namespace

std::vector<std::array<EdgeCurve, 3>> edgeCurves(const TriangleMesh& mesh,
                                                 const std::vector<FaceEdge>& edges) {
    if (mesh.normals.empty()) return std::vector<std::array<EdgeCurve, 3>>(mesh.triangles.size());
    return EdgeCurves(mesh, edges).run();
}

CurvedFace::CurvedFace(const std::array<dvec3, 3>& corners, const std::array<EdgeCurve, 3>& sides)
    : mCorners(corners), mSides(sides) {
    // Weights' products: 4 of each two sum up to 4/3 at most, and two times their difference is
    // √3/18 at most.
    double rise = 0, skew = 0;
    for (const EdgeCurve& side : sides) {
        rise = std::max(rise, glm::length(side.rise));
        skew += glm::length(side.skew);
    }
    mBulge = 4.0 / 3 * rise + std::sqrt(3.0) / 18 * skew;
}

dvec3 CurvedFace::at(const dvec2& uv) const {
    return slopesAt(uv).x;
}

CurvedFace::Slopes CurvedFace::slopesAt(const dvec2& uv) const {
    const double w[3] = {1 - uv.x - uv.y, uv.x, uv.y};
    dvec3 x(0), first[3], twice[3], mixed[3]; // by weights; mixed[k] by those of k and the next
    for (int k = 0; k < 3; ++k) {
        first[k] = mCorners[static_cast<size_t>(k)];
        x += w[k] * first[k];
        twice[k] = dvec3(0);
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const auto& [rise, skew] = mSides[static_cast<size_t>(i)];
        x += w[i] * w[j] * (4.0 * rise + (w[i] - w[j]) * skew);
        first[i] += w[j] * (4.0 * rise + (2 * w[i] - w[j]) * skew);
        first[j] += w[i] * (4.0 * rise + (w[i] - 2 * w[j]) * skew);
        twice[i] += 2 * w[j] * skew;
        twice[j] -= 2 * w[i] * skew;
        mixed[i] = 4.0 * rise + 2 * (w[i] - w[j]) * skew;
    }
    return {x,
            first[1] - first[0],
            first[2] - first[0],
            twice[1] - 2.0 * mixed[0] + twice[0],
            mixed[1] - mixed[0] - mixed[2] + twice[0],
            twice[2] - 2.0 * mixed[2] + twice[0]};
}

CurvedFace::Start CurvedFace::flatNearest(const dvec3& x) const {
    const auto& [a, b, c] = mCorners;
    const dvec2 uv = nearestWeights(x, a, b, c);
    return {uv, squared(a + uv.x * (b - a) + uv.y * (c - a) - x)};
}

CurvedFace::Nearest CurvedFace::nearest(const dvec3& x, const Start& start) const {
    // Newton's step is the point of the parameters' triangle nearest to its goal, as the second
    // derivatives measure length: so sides and corners need no case of their own.
    constexpr int kSteps = 8;
    constexpr double kEnough = 1e-9;
    dvec2 uv = start.uv;
    Slopes here = slopesAt(uv);
    double best = squared(here.x - x);
    for (int step = 0; step < kSteps; ++step) {
        const dvec3 off = here.x - x;
        const dvec2 gradient(glm::dot(off, here.u), glm::dot(off, here.v));
        double uu = squared(here.u), u_v = glm::dot(here.u, here.v), vv = squared(here.v);
        const double flat = uu * vv - u_v * u_v;
        const double bentUU = uu + glm::dot(off, here.uu), bentVV = vv + glm::dot(off, here.vv),
                     bentUV = u_v + glm::dot(off, here.uv);
        // Where the surface is bent about x there is no valley to go down: Gauss and Newton's step.
        if (bentUU > 0 && bentUU * bentVV - bentUV * bentUV > 1e-3 * flat) {
            uu = bentUU;
            u_v = bentUV;
            vv = bentVV;
        }
        const double root = std::sqrt(uu), skew = u_v / root;
        const double rest = vv - skew * skew;
        if (!(rest > 1e-14 * vv)) break; // a face of no area
        const double height = std::sqrt(rest);
        const double y = (gradient.y - skew * gradient.x / root) / height;
        const dvec3 origin(0), b(root, 0, 0), c(skew, height, 0);
        const dvec3 from = uv.x * b + uv.y * c;
        dvec2 next = nearestWeights(from - dvec3(gradient.x / root, y, 0), origin, b, c);
        // What the step would save of the square, about.
        if (squared(next.x * b + next.y * c - from) < kEnough * best) break;
        const double before = best;
        for (int halving = 0; halving < 4; ++halving, next = 0.5 * (uv + next)) {
            const Slopes there = slopesAt(next);
            const double found = squared(there.x - x);
            if (found >= best) continue;
            best = found;
            uv = next;
            here = there;
            break;
        }
        if (best == before) break;
    }
    return {best, glm::dot(x - here.x, unit(glm::cross(here.u, here.v)))};
}

} // namespace eikonal::mesh
