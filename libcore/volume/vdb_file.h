// A VDB file open for reading: its structure is checked by ours before OpenVDB reads any of it.
// Only for the volume room's own .cpp files, since it includes OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/vdb_check.h"

#include <memory>
#include <openvdb/Grid.h>
#include <string>

namespace eikonal::volume {

/// A grid as it lies in a file, to be copied.
struct VdbBody {
    std::string uniqueName, type; ///< as VdbRecord has them
    bool half = false;
    std::string bytes;         ///< compression flags, metadata, transform, tree
    std::uint64_t buffers = 0; ///< where among them its leaves' values begin
};

class VdbFile {
public:
    /// A regular file, or anything else that is read whole. Throws MissingError, or VdbDamage if it
    /// is no VDB file.
    static VdbFile open(const std::string& path);
    /// Of bytes in memory.
    explicit VdbFile(std::shared_ptr<const std::string> bytes);

    const VdbIndex& index() const { return mIndex; }
    openvdb::MetaMap metadata() const;

    /// A grid of a known type without its tree: name, metadata, transform. Throws VdbDamage, also
    /// if its transform is not linear.
    openvdb::GridBase::Ptr readHead(const VdbRecord& grid) const;
    /// The box of active voxels, by its tree. Throws VdbDamage.
    IndexBox checkedBox(const VdbRecord& grid) const;
    /// The whole grid; what is read is what was checked. Throws VdbDamage.
    openvdb::GridBase::Ptr read(const VdbRecord& grid) const;
    /// A grid of any type; one that shares another's tree gets it whole.
    VdbBody body(const VdbRecord& grid) const;

private:
    explicit VdbFile(std::unique_ptr<ByteSource> source);
    /// The grid whose tree it has: itself, or the one that it shares with.
    const VdbRecord& treeOwner(const VdbRecord& grid) const;

    std::unique_ptr<ByteSource> mSource;
    VdbIndex mIndex;
};

} // namespace eikonal::volume
