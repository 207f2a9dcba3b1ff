// The surface of a function as a mesh, by OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/polygonize.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

Polygons polygonize(const std::function<double(const glm::dvec3&)>& function, const glm::dvec3& low,
                    const glm::dvec3& high, double cell) {
    openvdb::initialize();
    const glm::ivec3 cells(glm::ceil((high - low) / cell));
    const openvdb::CoordBBox box(openvdb::Coord(-1),
                                 openvdb::Coord(cells.x + 1, cells.y + 1, cells.z + 1));
    openvdb::tools::Dense<float> values(box);
    tbb::parallel_for(box.min().x(), box.max().x() + 1, [&](int i) {
        for (int j = box.min().y(); j <= box.max().y(); ++j)
            for (int k = box.min().z(); k <= box.max().z(); ++k)
                values.setValue(openvdb::Coord(i, j, k),
                                static_cast<float>(function(low + cell * glm::dvec3(i, j, k))));
    });
    const openvdb::FloatGrid::Ptr grid =
        openvdb::FloatGrid::create(std::numeric_limits<float>::max());
    openvdb::tools::copyFromDense(values, *grid, 0.0f);

    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, points, quads);
    Polygons made;
    for (const openvdb::Vec3s& p : points)
        made.points.push_back(low + cell * glm::dvec3(p.x(), p.y(), p.z()));
    for (const openvdb::Vec4I& q : quads) made.quads.emplace_back(q[0], q[1], q[2], q[3]);
    return made;
}

} // namespace eikonal::volume
