// OpenVDB's archive on a stream of ours: cut-off files are noticed, repeated runs repeat bytes.
// Only for the volume room's own .cpp files, since it includes OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <istream>
#include <openvdb/Grid.h>
#include <openvdb/Metadata.h>
#include <ostream>
#include <string>

namespace eikonal::volume {

/// What a VDB file's header says.
struct VdbHeader {
    bool hasOffsets = false; ///< grids can be found without reading the ones before
    bool truncated = false;  ///< the last grid should end beyond the file's end
};

/// Reads the header and, where there are offsets, every grid's position. Throws openvdb::Exception
/// or std::ios_base::failure if it is no VDB file.
VdbHeader readVdbHeader(std::istream& in);

/// Writes grids and metadata. The archive's identifier, random in OpenVDB's own writers, is made
/// from `identity`, so that the same content gives the same bytes.
void writeVdb(std::ostream& out, bool seekable, const openvdb::GridCPtrVec& grids,
              const openvdb::MetaMap& metadata, const std::string& identity);

} // namespace eikonal::volume
