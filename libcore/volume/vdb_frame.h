// OpenVDB's transforms and our frames. Only for the volume room's own .cpp files.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <openvdb/math/Transform.h>
#include <string>

namespace eikonal::volume {

openvdb::math::Transform::Ptr toTransform(const Frame& frame);

/// Throws DataError, starting with `where`, if the voxels are not cubes of a size above 0.
Frame toFrame(const openvdb::math::Transform& transform, const std::string& where);

/// Equal but for what writers lose that go through float.
bool nearlyEqual(const Frame& a, const Frame& b);

} // namespace eikonal::volume
