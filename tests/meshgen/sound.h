// What every mesh of meshgen's is: closed, outward, nowhere crossing itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/check.h"
#include "mesh/shells.h"

#include <gtest/gtest.h>

namespace eikonal {

/// Checks it, and gives its report.
inline mesh::MeshReport sound(const mesh::TriangleMesh& made) {
    const mesh::MeshReport report = mesh::checkMesh(made);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.nonManifoldEdges, 0u);
    EXPECT_EQ(report.degenerateFaces, 0u);
    EXPECT_EQ(report.duplicateFaces, 0u);
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
    EXPECT_EQ(report.buried, 0u);
    EXPECT_GT(report.volume, 0);
    return report;
}

/// Points - edges + triangles: 2 - 2 g of one component of genus g.
inline long eulerCharacteristic(const mesh::TriangleMesh& made) {
    return static_cast<long>(made.points.size()) - static_cast<long>(made.triangles.size()) / 2;
}

} // namespace eikonal
