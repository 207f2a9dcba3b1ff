// Which voxels' middles lie inside a mesh, decided by columns along z.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/insides.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

namespace {

using glm::dvec3;

/// Where a column meets the surface.
struct Crossing {
    int column;
    double z; ///< [voxel]
    int step; ///< 1: into the solid, along +z
};

/// The voxels along an axis from `low` to `high`, both cut to [0, size).
struct Span {
    int first, last;

    Span(double low, double high, int size)
        : first(static_cast<int>(std::ceil(std::clamp(low, 0.0, size * 1.0)))),
          last(static_cast<int>(std::floor(std::clamp(high, -1.0, size - 1.0)))) {}
};

/// The faces that each plane of voxels may cut.
class FacesOfRows {
public:
    FacesOfRows(const mesh::TriangleMesh& mesh, int rows) : mMesh(mesh), mEnds(rows + 1, 0) {
        eachRow([&](size_t row, std::uint32_t) { ++mEnds[row + 1]; });
        for (size_t row = 1; row < mEnds.size(); ++row) mEnds[row] += mEnds[row - 1];
        mFaces.resize(mEnds.back());
        std::vector<size_t> next(mEnds.begin(), mEnds.end() - 1);
        eachRow([&](size_t row, std::uint32_t face) { mFaces[next[row]++] = face; });
    }
    const std::uint32_t* begin(int row) const { return mFaces.data() + mEnds[row]; }
    const std::uint32_t* end(int row) const { return mFaces.data() + mEnds[row + 1]; }

private:
    template<typename Act> void eachRow(const Act& act) const {
        const int rows = static_cast<int>(mEnds.size()) - 1;
        for (std::uint32_t f = 0; f < mMesh.triangles.size(); ++f) {
            const glm::uvec3& face = mMesh.triangles[f];
            const double a = mMesh.points[face.x].y, b = mMesh.points[face.y].y,
                         c = mMesh.points[face.z].y;
            const Span span(std::min({a, b, c}), std::max({a, b, c}), rows);
            for (int row = span.first; row <= span.last; ++row) act(static_cast<size_t>(row), f);
        }
    }

    const mesh::TriangleMesh& mMesh;
    std::vector<size_t> mEnds;
    std::vector<std::uint32_t> mFaces;
};

/// Where an edge that passes from below y to y or above does so: the same point for both its faces.
dvec3 cutAt(const dvec3& below, const dvec3& above, double y) {
    return below + (above - below) * ((y - below.y) / (above.y - below.y));
}

/// The crossings of one face with the columns of row y.
void cross(const dvec3* corners, double y, int columns, std::vector<Crossing>& crossings) {
    std::optional<dvec3> up, down; // where the face's rim passes the row, upward and downward
    for (int k = 0; k < 3; ++k) {
        const dvec3 &a = corners[k], &b = corners[(k + 1) % 3];
        if (a.y < y && b.y >= y) up = cutAt(a, b, y);
        if (b.y < y && a.y >= y) down = cutAt(b, a, y);
    }
    if (!up || !down || up->x == down->x) return;
    const dvec3 &left = up->x < down->x ? *up : *down, &right = up->x < down->x ? *down : *up;
    // Seen along +z the rim of a face that looks back runs up on the left: there the column enters.
    const int step = up->x < down->x ? 1 : -1;
    const Span span(left.x, right.x, columns);
    for (int x = span.first; x <= span.last && x < right.x; ++x) {
        const double share = (x - left.x) / (right.x - left.x);
        crossings.push_back({x, left.z + (right.z - left.z) * share, step});
    }
}

} // namespace

Sides::Sides(const mesh::TriangleMesh& mesh, const glm::ivec3& size)
    : mRows(static_cast<size_t>(size.y)) {
    const FacesOfRows faces(mesh, size.y);
    std::atomic<bool> overlaps = false;
    tbb::parallel_for(0, size.y, [&](int y) {
        std::vector<Crossing> crossings;
        for (const std::uint32_t* f = faces.begin(y); f != faces.end(y); ++f) {
            const glm::uvec3& face = mesh.triangles[*f];
            const dvec3 corners[3] = {mesh.points[face.x], mesh.points[face.y],
                                      mesh.points[face.z]};
            cross(corners, y, size.x, crossings);
        }
        // Entering before leaving where both are at one place, so that abutting shells are one.
        std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
            if (a.column != b.column) return a.column < b.column;
            return a.z != b.z ? a.z < b.z : a.step > b.step;
        });
        Row& row = mRows[static_cast<size_t>(y)];
        size_t next = 0;
        for (int x = 0; x < size.x; ++x) {
            int winding = 0;
            const size_t begin = row.changes.size();
            for (; next < crossings.size() && crossings[next].column == x; ++next) {
                const bool was = winding > 0;
                winding += crossings[next].step;
                if (winding < 0 || winding > 1) overlaps = true;
                if (was == (winding > 0)) continue;
                const auto voxel = static_cast<int>(
                    std::ceil(std::clamp(crossings[next].z, -1.0, static_cast<double>(size.z))));
                // Two within one voxel cancel each other.
                if (row.changes.size() > begin && row.changes.back() == voxel)
                    row.changes.pop_back();
                else
                    row.changes.push_back(voxel);
            }
            row.ends.push_back(static_cast<std::uint32_t>(row.changes.size()));
        }
    });
    mOverlaps = overlaps;
}

bool Sides::inside(const glm::ivec3& voxel) const {
    const Row& row = mRows[static_cast<size_t>(voxel.y)];
    const auto x = static_cast<size_t>(voxel.x);
    std::uint32_t i = x == 0 ? 0 : row.ends[x - 1];
    bool inside = false;
    for (; i < row.ends[x] && row.changes[i] <= voxel.z; ++i) inside = !inside;
    return inside;
}

void Sides::signsOf(const glm::ivec3& low, const glm::ivec3& size, float* signs) const {
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Row& row = mRows[static_cast<size_t>(low.y + y)];
            const auto column = static_cast<size_t>(low.x + x);
            std::uint32_t i = column == 0 ? 0 : row.ends[column - 1];
            float sign = 1;
            for (int z = 0; z < size.z; ++z) {
                for (; i < row.ends[column] && row.changes[i] <= low.z + z; ++i) sign = -sign;
                signs[(z * size.y + y) * size.x + x] = sign;
            }
        }
}

} // namespace eikonal::voxelize
