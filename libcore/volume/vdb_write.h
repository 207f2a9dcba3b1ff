// VDB files written: grids that were made go through OpenVDB, those copied as they lay; repeated
// runs repeat bytes. Only for the volume room's own .cpp files, since it includes OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/vdb_file.h"

#include <openvdb/Grid.h>
#include <openvdb/Metadata.h>
#include <ostream>
#include <set>
#include <string>

namespace eikonal::volume {

/// A grid as OpenVDB writes it, its structure checked: OpenVDB does not report every failure.
/// Throws VdbDamage.
VdbBody bodyOf(const openvdb::GridBase::ConstPtr& grid);

/// Writes a file with offsets in one go, without seeking.
class VdbWriter {
public:
    /// The archive's identifier, random in OpenVDB's own writers, is made from `identity`, so that
    /// the same content gives the same bytes.
    VdbWriter(std::ostream& out, const openvdb::MetaMap& metadata, size_t grids,
              const std::string& identity);
    /// The next grid.
    void add(const VdbBody& body);

private:
    void write(const std::string& bytes);

    std::ostream& mOut;
    std::uint64_t mPosition = 0;
    std::set<std::string> mNames;
};

} // namespace eikonal::volume
