// The structure of VDB files, held against the bytes there are before OpenVDB, which trusts every
// length, reads them. File formats 222 to 224: OpenVDB 2 to 12. Knows nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/vdb_bytes.h"
#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::volume {

/// What stands behind the type of a grid whose numbers are stored in 16 bits.
constexpr const char* kHalfSuffix = "_HalfFloat";

/// A grid's descriptor, and where the grid lies in the file.
struct VdbRecord {
    std::string uniqueName; ///< with a suffix where a name is there more than once
    std::string type;       ///< "Tree_float_5_4_3"
    bool half = false;      ///< its numbers are stored in 16 bits
    std::string sharesWith; ///< unique name of the grid whose tree this one shares, or ""
    std::uint64_t begin = 0, end = 0;
    std::uint64_t buffers = 0; ///< where its leaves' values begin, as the file has it

    std::string name() const;
    std::string valueType() const; ///< "float"
};

/// What a file holds, by its header.
struct VdbIndex {
    std::uint32_t fileVersion = 0, libraryMajor = 0, libraryMinor = 0;
    bool hasOffsets = false;
    std::uint64_t metadataBegin = 0, metadataEnd = 0;
    std::vector<VdbRecord> grids;
};

/// Reads header and descriptors. Files without offsets are walked through, which only the types of
/// grids allow whose trees are known. Throws VdbDamage.
VdbIndex indexOf(const ByteSource& file);

/// A span of bytes in a file.
struct VdbSpan {
    std::uint64_t begin = 0, end = 0;
};

/// The parts of a grid: compression flags, metadata, transform, tree.
struct VdbParts {
    std::uint32_t compression = 0;
    VdbSpan metadata, transform;
    /// Items of metadata that OpenVDB reads by lengths within, unchecked: never handed to it.
    std::vector<VdbSpan> unsafe;
    bool linear = true; ///< the transform's map is
    VdbSpan tree;       ///< empty where the grid shares another's
};

/// Checks what stands before the tree, and tells where each part is. Throws VdbDamage.
VdbParts partsOf(const ByteSource& file, const VdbRecord& grid);

/// Checks a map of metadata at the reader's place; gives the items unsafe to hand on.
std::vector<VdbSpan> checkMetadata(ByteReader& in);

/// Checks every count and length of the tree, and tells the box of active voxels. The tree ends
/// where its span ends. Throws VdbDamage, also for types whose trees are not known.
IndexBox checkTree(const ByteSource& file, const VdbRecord& grid, const VdbParts& parts);

} // namespace eikonal::volume
