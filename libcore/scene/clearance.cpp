// How far off any boundary is, all over the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/clearance.h"

#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;

// Cubes along an edge of the table at the most.
constexpr int kMostCubes = 256;

// Distances to far boundaries are found by groups of cubes of this edge [cube].
constexpr int kGroup = 2;

/// One axis of an exact squared distance transform: the lower envelope of parabolas (Felzenszwalb
/// and Huttenlocher 2012, Theory of Computing 8:415).
void transformLine(float* line, size_t stride, int count, std::vector<float>& f,
                   std::vector<int>& v, std::vector<float>& z) {
    for (int i = 0; i < count; ++i) f[static_cast<size_t>(i)] = line[i * stride];
    int k = 0;
    v[0] = 0;
    z[0] = -1e20f;
    z[1] = 1e20f;
    const auto at = [&](int i) { return f[static_cast<size_t>(i)]; };
    for (int q = 1; q < count; ++q) {
        const auto meets = [&](int p) {
            return ((at(q) + static_cast<float>(q * q)) - (at(p) + static_cast<float>(p * p))) /
                   static_cast<float>(2 * (q - p));
        };
        float s = meets(v[static_cast<size_t>(k)]);
        while (s <= z[static_cast<size_t>(k)]) s = meets(v[static_cast<size_t>(--k)]);
        v[static_cast<size_t>(++k)] = q;
        z[static_cast<size_t>(k)] = s;
        z[static_cast<size_t>(k) + 1] = 1e20f;
    }
    k = 0;
    for (int q = 0; q < count; ++q) {
        while (z[static_cast<size_t>(k) + 1] < static_cast<float>(q)) ++k;
        const int p = v[static_cast<size_t>(k)];
        line[q * stride] = static_cast<float>((q - p) * (q - p)) + at(p);
    }
}

void transform(std::vector<float>& squares, ivec3 size) {
    const std::array<size_t, 3> strides{1, static_cast<size_t>(size.x),
                                        static_cast<size_t>(size.x) * size.y};
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        tbb::parallel_for(0, size[b], [&](int j) {
            const auto count = static_cast<size_t>(size[axis]);
            std::vector<float> f(count), z(count + 1);
            std::vector<int> v(count);
            for (int i = 0; i < size[a]; ++i)
                transformLine(squares.data() + i * strides[static_cast<size_t>(a)] +
                                  j * strides[static_cast<size_t>(b)],
                              strides[static_cast<size_t>(axis)], size[axis], f, v, z);
        });
    }
}

/// How far a group's centre is from that of the nearest group that a boundary may pass [group].
struct Groups {
    ivec3 size;
    std::vector<float> distance;
};

/// `within`: clearances up to which a boundary may pass a cube [voxel].
Groups farGroups(const BoundaryTable& table, float within) {
    Groups groups{(table.size + kGroup - 1) / kGroup, {}};
    groups.distance.assign(placeOf(groups.size, 0, 0, groups.size.z), 1e12f);
    size_t i = 0;
    for (int z = 0; z < table.size.z; ++z)
        for (int y = 0; y < table.size.y; ++y)
            for (int x = 0; x < table.size.x; ++x, ++i)
                if (table.clearance[i] <= within)
                    groups.distance[placeOf(groups.size, x / kGroup, y / kGroup, z / kGroup)] = 0;
    transform(groups.distance, groups.size);
    for (float& d : groups.distance) d = std::sqrt(d);
    return groups;
}

/// An object's distance at the centres of cubes, and whether it is near them.
class Cubes {
public:
    Cubes(const Object& object, int edge) : mObject(object), mEdge(edge) {}

    /// At the centre [voxel], held back by how far the domain ends before it.
    float distanceAt(ivec3 cube) const {
        const volume::BrickGrid& grid = mObject.distance;
        if (mEdge == 1) return grid.at(cube);
        const ivec3 last = grid.size - 1;
        const ivec3 p = mEdge * cube + mEdge / 2 - 1;
        const bool within = p + 1 == glm::min(p + 1, last);
        const size_t brick = grid.brickOf(glm::min(p, last));
        if (within && grid.page[brick] < 0 && brick == grid.brickOf(p + 1)) return grid.even[brick];
        float sum = 0;
        for (int i = 0; i < 8; ++i)
            sum += grid.at(glm::min(p + ivec3(i & 1, i >> 1 & 1, i >> 2), last));
        return heldBack(sum / 8, p + 1 - last);
    }

    /// The same where all distances are the band's: no boundary is near.
    float farDistanceAt(ivec3 cube) const {
        const ivec3 last = mObject.distance.size - 1;
        const ivec3 p = mEdge * cube + mEdge / 2 - 1;
        const bool within = mEdge == 1 || p + 1 == glm::min(p + 1, last);
        return within ? mObject.band : heldBack(mObject.band, p + 1 - last);
    }

    /// Those that are not surely far outside.
    volume::IndexBox box() const {
        const volume::BrickGrid& grid = mObject.distance;
        volume::IndexBox voxels;
        for (size_t brick = 0; brick < grid.page.size(); ++brick) {
            const bool isFar =
                grid.page[brick] < 0 && grid.even[brick] == mObject.band && mObject.band >= kNearby;
            if (isFar) continue;
            const ivec3 low = grid.voxelOf(brick);
            voxels.include(
                {glm::max(low, ivec3(0)), glm::min(low + volume::kBrick, grid.size) - 1});
        }
        return voxels.empty() ? voxels : volume::IndexBox{voxels.min / mEdge, voxels.max / mEdge};
    }

    bool nearTo(ivec3 cube, float distance) const {
        if (mEdge == 1) return std::abs(distance) < kNearby;
        if (std::abs(distance) >= kNearby + kCornerWay * static_cast<float>(mEdge)) return false;
        const ivec3 low = mEdge * cube;
        const ivec3 high = glm::min(low + mEdge, mObject.distance.size) - 1;
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    if (std::abs(mObject.distance.at({x, y, z})) < kNearby) return true;
        return false;
    }

private:
    static float heldBack(float distance, ivec3 past) {
        const vec3 beyond(glm::max(past, ivec3(0)));
        return std::copysign(std::max(std::abs(distance) - glm::length(beyond), 0.0f), distance);
    }

    const Object& mObject;
    int mEdge;
};

/// A layer of cubes along z: how far off any boundary is, and the objects' sets. Of one alone none
/// needs to know whether it is near.
std::vector<ObjectSets> fillLayer(const std::vector<Object>& objects,
                                  const std::vector<volume::IndexBox>& boxes, int z,
                                  BoundaryTable& table) {
    const size_t first = placeOf(table.size, 0, 0, z);
    std::vector<ObjectSets> sets(placeOf(table.size, 0, 0, 1));
    const bool alone = objects.size() == 1;
    float* nearest = table.clearance.data() + first;
    // No object is further off than its band.
    const auto& least =
        *std::min_element(objects.begin(), objects.end(),
                          [](const Object& a, const Object& b) { return a.band < b.band; });
    const Cubes far(least, table.edge);
    for (int y = 0, i = 0; y < table.size.y; ++y)
        for (int x = 0; x < table.size.x; ++x, ++i) nearest[i] = far.farDistanceAt({x, y, z});
    for (size_t k = 0; k < objects.size(); ++k) {
        const volume::IndexBox& box = boxes[k];
        if (z < box.min.z || z > box.max.z) continue;
        const Cubes object(objects[k], table.edge);
        const std::uint64_t bit = std::uint64_t{1} << k;
        for (int y = box.min.y; y <= box.max.y; ++y)
            for (int x = box.min.x; x <= box.max.x; ++x) {
                const size_t i = placeOf(table.size, x, y, 0);
                const float d = object.distanceAt({x, y, z});
                nearest[i] = std::min(nearest[i], std::abs(d));
                if (d < 0) sets[i].inside |= bit;
                if (!alone && object.nearTo({x, y, z}, d)) sets[i].near |= bit;
            }
    }
    return sets;
}

/// Fills in how near boundaries are by their distances, and the objects' sets.
void fill(const std::vector<Object>& objects, BoundaryTable& table) {
    std::vector<volume::IndexBox> boxes(objects.size());
    tbb::parallel_for(size_t{0}, objects.size(),
                      [&](size_t k) { boxes[k] = Cubes(objects[k], table.edge).box(); });
    const bool many = areMany(objects);
    std::vector<ListedSets> layers(many ? static_cast<size_t>(table.size.z) : 0);
    table.objects.resize(many ? 0 : table.clearance.size());
    tbb::parallel_for(0, table.size.z, [&](int z) {
        const std::vector<ObjectSets> sets = fillLayer(objects, boxes, z, table);
        if (many)
            layers[static_cast<size_t>(z)] = listSets(sets);
        else
            std::transform(sets.begin(), sets.end(),
                           table.objects.begin() +
                               static_cast<std::ptrdiff_t>(placeOf(table.size, 0, 0, z)),
                           [](const ObjectSets& s) {
                               return static_cast<std::uint32_t>(s.near << 16 | s.inside);
                           });
    });
    if (!many) return;
    ListedSets all = joinLists(std::move(layers));
    table.objects = std::move(all.places);
    table.sets = std::move(all.list);
}

/// How far a cube's centre is from the farthest point for which it is the nearest one, less what a
/// filtered look-up makes good: the way across each of the domain's faces that it lies on [voxel].
float wayToFaces(ivec3 cube, ivec3 cubes, ivec3 voxels, int edge) {
    float way = 0;
    const float half = 0.5f * static_cast<float>(edge);
    for (int axis = 0; axis < 3; ++axis) {
        if (cube[axis] == 0) way += half;
        if (cube[axis] == cubes[axis] - 1)
            way += std::max(static_cast<float>(voxels[axis] - edge * cube[axis]) - half, 0.0f);
    }
    return way;
}

} // namespace

int tableEdge(const ivec3& size) {
    int edge = 1;
    while (std::max({size.x, size.y, size.z}) > kMostCubes * edge) edge *= 2;
    return edge;
}

BoundaryTable tabulate(const std::vector<Object>& objects, const ivec3& size) {
    const bool alone = objects.size() == 1;
    BoundaryTable table;
    const int edge = table.edge = tableEdge(size);
    const ivec3 cubes = table.size = (size + edge - 1) / edge;
    table.clearance.resize(placeOf(cubes, 0, 0, cubes.z));
    fill(objects, table);
    std::vector<float>& nearest = table.clearance;
    // From a cube to its group's centre, to that of a group with a boundary, to a cube of it whose
    // centre is within kCornerWay of the boundary.
    const auto h = static_cast<float>(edge);
    const Groups groups = farGroups(table, kCornerWay * h);
    const float slack = (2 * (kGroup - 1) + 1) * kCornerWay * h;
    tbb::parallel_for(0, cubes.z, [&](int z) {
        size_t i = placeOf(cubes, 0, 0, z);
        for (int y = 0; y < cubes.y; ++y)
            for (int x = 0; x < cubes.x; ++x, ++i) {
                const size_t group = placeOf(groups.size, x / kGroup, y / kGroup, z / kGroup);
                nearest[i] = std::max(nearest[i], kGroup * h * groups.distance[group] - slack);
                nearest[i] = std::max(nearest[i] - wayToFaces({x, y, z}, cubes, size, edge), 0.0f);
                if (alone && (table.objects[i] & 1u)) nearest[i] = -nearest[i];
            }
    });
    return table;
}

} // namespace eikonal::scene
