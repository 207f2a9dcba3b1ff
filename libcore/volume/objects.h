// What a level set's metadata say of the object it bounds; includes OpenVDB, for this room only.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <openvdb/openvdb.h>

namespace eikonal::volume {

/// Whether a grid of this contract name is the level set of an object: `sdf` or `sdf.NAME`.
bool isLevelSet(const std::string& grid);

/// The object that the level set of contract name `sdf` bounds; the suffix where the metadata have
/// no name, `position` where they have no order. Throws DataError, led by `where`, on metadata of
/// another type.
ObjectFacts objectOf(const openvdb::GridBase& grid, const std::string& sdf, int position,
                     const std::string& where);

/// Writes the facts into the level set's metadata, in place of what they said before.
void describe(openvdb::GridBase& grid, const ObjectFacts& object);

/// Sorts those that win where objects overlap to the front. Throws DataError, led by `path`, if two
/// have one name or one is called after the medium.
void settlePrecedence(std::vector<ObjectFacts>& objects, const std::string& path);

} // namespace eikonal::volume
