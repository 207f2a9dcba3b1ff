// VDB files made with OpenVDB itself, to be read through the volume room.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scratch.h"
#include "volume/volume.h"

#include <openvdb/openvdb.h>

namespace eikonal::volume {

const History kHistory{"tester", "1.2", "tester in.vdb -o out.vdb"};

class VolumeTest : public ScratchTest {
protected:
    void SetUp() override {
        ScratchTest::SetUp();
        openvdb::initialize();
    }

    /// An 8³ box of one value, all active.
    template<typename GridT>
    static typename GridT::Ptr block(const std::string& name,
                                     const typename GridT::ValueType& value,
                                     const typename GridT::ValueType& background) {
        auto grid = GridT::create(background);
        grid->setName(name);
        grid->fill({{0, 0, 0}, {7, 7, 7}}, value);
        return grid;
    }
    static openvdb::FloatGrid::Ptr floats(const std::string& name, float value = 1.5f,
                                          float background = 1) {
        return block<openvdb::FloatGrid>(name, value, background);
    }
    static openvdb::Vec3SGrid::Ptr vectors(const std::string& name, openvdb::Vec3s value) {
        return block<openvdb::Vec3SGrid>(name, value, openvdb::Vec3s(0));
    }

    /// Writes the grids as OpenVDB does, and gives the path.
    std::string vdb(const std::string& name, const openvdb::GridPtrVec& grids,
                    const openvdb::MetaMap& metadata = {}, bool statistics = true) const {
        openvdb::io::File file(at(name));
        file.setGridStatsMetadataEnabled(statistics);
        file.write(grids, metadata);
        file.close();
        return at(name);
    }

    std::string write(const Volume& volume, const std::string& name,
                      const History& history = kHistory) const {
        AtomicFile out(at(name));
        volume.write(out, history);
        out.commit();
        return at(name);
    }

    /// A grid of the file, as OpenVDB reads it.
    openvdb::GridBase::Ptr gridIn(const std::string& name, const std::string& grid) const {
        openvdb::io::File file(at(name));
        file.open(false);
        return file.readGrid(grid);
    }
};

/// A dense grid whose every value tells its place: start + i / 1024, exact in float.
inline DenseGrid numbered(const IndexBox& box, int components, float start = 1) {
    DenseGrid grid;
    grid.size = box.size();
    grid.components = components;
    for (std::int64_t i = 0; i < box.voxels() * components; ++i)
        grid.values.push_back(start + static_cast<float>(i) / 1024);
    return grid;
}

} // namespace eikonal::volume
