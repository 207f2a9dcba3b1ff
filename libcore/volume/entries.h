// The grids of an open scene volume: which are the contract's, where they lie, what is read.
// Only for the volume room's own .cpp files, since it includes OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/vdb_write.h"
#include "volume/volume.h"

#include <deque>
#include <openvdb/openvdb.h>
#include <optional>

namespace eikonal::volume {

void initializeOpenVdb();

glm::ivec3 fromCoord(const openvdb::Coord& c);
openvdb::CoordBBox toBox(const IndexBox& box);

/// Floats and doubles are scalars, their triples vectors; in a tree of OpenVDB's usual shape.
GridType typeOf(const std::string& treeType);

struct Entry {
    std::string name, valueType;
    GridType type = GridType::other;
    bool half = false;                 ///< stored in 16 bits
    IndexBox active;                   ///< of a grid of the scene
    openvdb::GridBase::Ptr grid;       ///< null where a grid is only copied
    bool read = false;                 ///< its tree, not only its metadata
    const VdbRecord* record = nullptr; ///< in the file; null if it was made
    std::string elsewhere;             ///< what is wrong with its transform, or ""
};

/// Hands on what stays true of the grid that `made` replaces.
void inherit(openvdb::GridBase& made, const openvdb::GridBase& old);

struct Volume::Impl {
    std::string path;
    Frame frame;
    IndexBox domain;
    GridNames names;
    openvdb::MetaMap metadata;
    std::optional<VdbFile> file;
    std::deque<Entry> entries; // they stay where they are

    std::string nameInFile(const std::string& grid) const;
    /// The contract name of a grid of the file, or "" if the contract has another for it.
    std::string contractName(const std::string& nameInTheFile) const;
    Entry* find(const std::string& grid);
    std::string foundNames() const;
    std::string where(const std::string& grid) const;

    /// Whether a stage may look at the grid: the contract has its name, or an option maps it.
    bool isKnown(const Entry& entry) const;

    void open(const ChooseNames& choose);
    /// A grid of numbers that is there, its tree read.
    Entry& numbers(const std::string& grid);
    /// Reads what a file says of a grid before its tree, and its tree.
    void requireHead(Entry& entry);
    void requireTree(Entry& entry) { readEntry(entry); }
    /// The grid that one of so many components would replace, its tree read, or null.
    const Entry* replaced(const std::string& grid, int components);
    /// What an entry is written as. Throws InternalError if OpenVDB wrote no whole grid.
    VdbBody bodyOf(const Entry& entry) const;
    /// Takes in a grid made under its contract name, in place of one of that name.
    void place(const openvdb::GridBase::Ptr& grid);
    /// The same of an object's level set, which hands on the metadata of the one it replaces.
    void placeLevelSet(const ObjectFacts& object, const openvdb::FloatGrid::Ptr& made);

private:
    void readEntry(Entry& entry);
    void readIndex();
    void readHeads(bool knownOnly);
    void readHead(Entry& entry);
    void findFrame();
    void checkNames();
    void checkDomain() const;
    std::string elsewhereOf(const Entry& entry) const;

    std::string mFrameOf; // the grid that the frame is from
};

} // namespace eikonal::volume
