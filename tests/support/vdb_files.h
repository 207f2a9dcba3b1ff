// VDB files made with OpenVDB itself, to be read through the volume room; OpenVDB's headers, the
// longest of all, are parsed in vdb_files.cpp alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/scratch.h"
#include "volume/volume.h"

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace eikonal::volume {

const History kHistory{"tester", "1.2", "tester in.vdb -o out.vdb"};

/// What OpenVDB holds beside the voxels, with its type.
using VdbMeta = std::variant<std::string, float, double, std::int32_t, std::int64_t>;

/// OpenVDB's pointer to a grid of any type: copies are the same grid.
class VdbGrid {
public:
    struct Impl;
    enum class Type { float32, float64, int32, boolean, vector };

    /// No active voxel.
    VdbGrid(const std::string& name, Type type, const glm::dvec3& background);
    explicit VdbGrid(std::shared_ptr<Impl> impl);
    /// A grid of its own on this one's tree, which files hold once.
    VdbGrid sharing(const std::string& name) const;

    // ---- voxels; grids of one component take x, and give their value in all three
    void set(const glm::ivec3& voxel, const glm::dvec3& value); ///< active
    void set(const glm::ivec3& voxel, double value) { set(voxel, glm::dvec3(value)); }
    void fill(const IndexBox& box, const glm::dvec3& value, bool active = true);
    glm::dvec3 at(const glm::ivec3& voxel) const;
    double valueAt(const glm::ivec3& voxel) const { return at(voxel).x; }
    bool isActive(const glm::ivec3& voxel) const;
    std::uint64_t activeVoxels() const;
    double background() const;
    bool hasTopologyOf(const VdbGrid& other) const;
    /// Whether OpenVDB takes the voxel of this level set for one inside.
    bool isInside(const glm::ivec3& voxel) const;

    // ---- what it says of itself
    std::string name() const;
    std::string type() const; ///< OpenVDB's name of its values
    void setLevelSet();
    bool isLevelSet() const;
    void setFogVolume();
    std::string gridClass() const; ///< OpenVDB's name of it
    void setHalf();                ///< stored in 16 bits
    bool isHalf() const;
    void setCovariant();
    bool isCovariant() const;
    void setCreator(const std::string& creator);
    std::string creator() const;
    void setMeta(const std::string& key, const VdbMeta& value);
    VdbMeta meta(const std::string& key) const;

    // ---- its place in the world
    void setVoxelSize(double size);
    void translate(const glm::dvec3& by); ///< after what it has
    void preScale(const glm::dvec3& by);  ///< before what it has
    void setWorldFromIndex(const glm::dmat4& matrix);
    void setFrustum(); ///< of 8³ voxels
    glm::dvec3 worldFromIndex(const glm::dvec3& voxel) const;

    const Impl& impl() const { return *mImpl; }

private:
    std::shared_ptr<Impl> mImpl;
};

class VolumeTest : public ScratchTest {
protected:
    /// An 8³ box of one value, all active.
    static VdbGrid block(const std::string& name, VdbGrid::Type type, const glm::dvec3& value,
                         const glm::dvec3& background);
    static VdbGrid floats(const std::string& name, float value = 1.5f, float background = 1);
    static VdbGrid vectors(const std::string& name, const glm::dvec3& value);
    static VdbGrid emptyFloats(const std::string& name, float background);

    /// Writes the grids as OpenVDB does, and gives the path.
    std::string vdb(const std::string& name, const std::vector<VdbGrid>& grids,
                    const std::map<std::string, VdbMeta>& metadata = {},
                    bool statistics = true) const;

    std::string write(const Volume& volume, const std::string& name,
                      const History& history = kHistory) const;

    /// A grid of the file, as OpenVDB reads it; and what the file says of itself.
    VdbGrid gridIn(const std::string& name, const std::string& grid) const;
    VdbMeta metaIn(const std::string& name, const std::string& key) const;
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
