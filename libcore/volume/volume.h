// A scene volume: the named grids of one .vdb file, where they lie in the world, and dense copies.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "base/history.h"
#include "volume/bricks.h"
#include "volume/fine_grid.h"

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::volume {

/// A box of voxels by integer index coordinates, both ends inside.
struct IndexBox {
    glm::ivec3 min{0}, max{-1};

    bool empty() const { return max.x < min.x || max.y < min.y || max.z < min.z; }
    glm::ivec3 size() const { return empty() ? glm::ivec3(0) : max - min + 1; }
    std::int64_t voxels() const { return std::int64_t{size().x} * size().y * size().z; }
    /// Where the first brick of its voxels begins, from `min` on: BrickGrid::first.
    glm::ivec3 firstBrick() const { return -(min & (kBrick - 1)); }
    void include(const IndexBox& other);
    bool operator==(const IndexBox&) const = default;
};

/// OpenVDB holds no smaller voxels [unit].
constexpr double kLeastVoxelSize = 1.5e-5;

/// Where voxel indices lie in the world: uniform voxels, any rotation and translation.
struct Frame {
    glm::dmat4 worldFromIndex{1.0};
    double voxelSize = 1.0; ///< [unit]

    glm::dmat4 indexFromWorld() const;
};

enum class GridType { scalar, vector, other }; ///< float or double, vec3s or vec3d, anything else

/// Values of a box of voxels: x fastest, then y, z; components interleaved.
struct DenseGrid {
    glm::ivec3 size{0};
    int components = 1;
    std::vector<float> values;

    size_t voxels() const { return values.size() / static_cast<size_t>(components); }
};

/// What is known of a grid without reading its values.
struct GridFacts {
    std::string name, type;
    IndexBox active;
};

/// A conductor's complex index n + i k, by linear Rec. 709's channels.
struct Metal {
    glm::vec3 index{1}, extinction{0};
};

/// A uniaxial crystal, whose n_o, Cauchy B and absorption of light polarised across the axis are
/// the plain ones.
struct Crystal {
    float index = 1;         ///< n_e, for light polarised along the axis, at 587.6 nm [1]
    float dispersion = 0;    ///< its Cauchy B [µm²]
    glm::vec3 axis{0};       ///< world space, of length 1
    glm::vec3 absorption{0}; ///< of light polarised along the axis [1/unit]
};

/// An object of a scene: the space where its level set is negative.
struct ObjectFacts {
    std::string name;             ///< its own values are the grids ownGrid(GRID, name)
    std::string sdf;              ///< contract name of its level set: `sdf` or `sdf.NAME`
    int priority = 0;             ///< where objects overlap the higher wins, among equals the later
    int order = 0;                ///< its place on the command line that made it, 0 first
    float roughness = 0;          ///< GGX's α of its boundary [1]
    std::optional<Metal> metal{}; ///< it mirrors all that it does not absorb
    std::optional<Crystal> crystal{};
};

/// Whether a crystal's axis has the length 1, to a thousandth.
bool isAxis(const glm::dvec3& axis);

/// What surrounds all objects, where its values vary: `ior.medium` and its like. No object's name.
constexpr const char* kMedium = "medium";

/// The grid of an object's own, one-sided values: ownGrid("ior", "glass") is "ior.glass".
std::string ownGrid(const std::string& grid, const std::string& object);

/// Contract names mapped to the names in the file, from `--grid-ior NAME` and its like.
using GridNames = std::map<std::string, std::string>;

/// Which grids of a file an option means, by the names of those that the file holds.
using ChooseNames = std::function<GridNames(const std::vector<std::string>& found)>;

/// How derive() makes one number of another.
struct Law {
    /// Of a value and the component that it makes, in double.
    std::function<double(double value, int component)> value;
    bool vector = false; ///< three components are made of one number; of vectors, always
    /// What a value must be above, and in words.
    double above = -std::numeric_limits<double>::infinity();
    std::string wanted{};
    /// Stands for the background and every voxel that is not active.
    std::optional<double> outside{};
    bool inDouble = false; ///< scalars are stored so
};

/// What derive() cut to the range that the contract allows [active voxel].
struct Cut {
    std::int64_t below = 0, above = 0;
};

/// How put() shall describe a grid.
struct PutOptions {
    glm::vec3 background{0.0f};
    bool allActive = false;   ///< every voxel of the box is active; else only those off background
    bool keepActive = false;  ///< so are those that were active in the grid replaced
    std::string vectorType{}; ///< VDB's name: "color", "vector"...; vectors only
};

/// One scene volume. Grids are read from the file when first asked for; those that no stage
/// replaces are copied as they lie in the file when the volume is written again, whatever they
/// hold.
class Volume {
public:
    /// An empty volume to put grids into.
    explicit Volume(const Frame& frame);

    /// Opens `path`, a file or a stream ("-": standard input). The scene is the grids of the
    /// contract or of `names`, where `ior` or else their first one lies; where there is none, all
    /// grids of numbers. Throws MissingError, or DataError if it is no VDB file, is cut short or
    /// damaged, or has no active voxel, no grids, or a scene on an unsuitable transform.
    static Volume open(const std::string& path, const GridNames& names = {});
    /// The same, where the names depend on what there is.
    static Volume open(const std::string& path, const ChooseNames& choose);

    ~Volume();
    Volume(Volume&&) noexcept;
    Volume& operator=(Volume&&) noexcept;

    const std::string& path() const;
    const Frame& frame() const;
    /// The box of active voxels over the scene's grids; the domain is this box padded by half a
    /// voxel.
    const IndexBox& domain() const;
    std::vector<GridFacts> grids() const;
    /// Whether any grid is of the contract, under its name or another by option.
    bool holdsScene() const;
    /// The objects that level sets `sdf`, `sdf.NAME` bound, the one that wins where objects overlap
    /// first. Where metadata are missing the name is the suffix ("" of plain `sdf`), the priority
    /// 0, the order the level set's place among all by name. Throws DataError if two have one name.
    std::vector<ObjectFacts> objects() const;

    /// Whether the grid of this contract name is there. Throws DataError if it lies elsewhere than
    /// the scene, or its type is not the contract's; one number a voxel is grey.
    bool has(const std::string& grid) const;
    /// The background, or `absent` if the grid is not there. Checked like values.
    glm::vec3 background(const std::string& grid, const glm::vec3& absent) const;
    /// The value of a grid that has no active voxel, which is its background; nothing if it has
    /// one. A scalar stands in all three components. Checked like values.
    std::optional<glm::vec3> constant(const std::string& grid) const;
    /// The values within `box`, checked against the contract's range for the name: finite, index
    /// above 0, coefficients not negative, |g| < 1. Throws DataError naming grid and voxel. A level
    /// set gives its band's half width beyond its band, negative inside.
    DenseGrid dense(const std::string& grid, const IndexBox& box) const;
    /// The same by bricks: what is even takes no memory. Numbers where the contract wants vectors
    /// stay one component.
    BrickGrid bricks(const std::string& grid, const IndexBox& box) const;
    /// Of a grid of doubles what bricks() rounds off: by the same bricks the values less their
    /// floats, themselves as floats. Empty where the floats are all there is to it.
    BrickGrid remainders(const std::string& grid, const IndexBox& box) const;
    /// The active voxels of a grid of vectors that is finer than the scene, from the low corner of
    /// `box` on; empty if it is not there. Throws DataError if it does not subdivide the scene's
    /// voxels, or a value is against the contract.
    FineGrid fine(const std::string& grid, const IndexBox& box) const;
    /// Whether the file holds the grid's numbers in 16 bits.
    bool isStoredInHalf(const std::string& grid) const;
    /// For a grid that must be there: throws DataError "no grid 'ior' (found: density)".
    void require(const std::string& grid) const;

    /// Adds or replaces a grid; `values` covers `box`. A grid replaced by one of its type hands on
    /// its metadata (class, creator, the user's own). Throws InternalError on a NaN or infinity.
    void put(const std::string& grid, const IndexBox& box, const DenseGrid& values,
             const PutOptions& options);
    void put(const std::string& grid, const IndexBox& box, const BrickGrid& values,
             const PutOptions& options);
    /// The same of a grid finer than the scene, its voxels counted from the low corner of `box` on.
    void putFine(const std::string& grid, const IndexBox& box, const FineGrid& values);
    /// Adds or replaces a grid of the contract that is `value` everywhere: no active voxel, so that
    /// it costs nothing. Scalars take the first component.
    void putConstant(const std::string& grid, const glm::vec3& value);
    /// Adds or replaces grid `to` of the contract by the values of grid `from`, each by itself,
    /// with its active voxels. Values beyond a range whose end is valid are cut to it. Throws
    /// DataError naming grid and voxel where a value is not finite or not above what the law asks
    /// for, or its result is none of the contract's.
    Cut derive(const std::string& from, const std::string& to, const Law& law);
    /// Adds or replaces the level set of an object. `values` over `box` are distances [unit],
    /// negative inside; they are cut to `halfWidth` [voxel] either side, and active below that. A
    /// level set replaced hands on its metadata.
    void putLevelSet(const ObjectFacts& object, const IndexBox& box, const DenseGrid& values,
                     double halfWidth);
    void putLevelSet(const ObjectFacts& object, const IndexBox& box, const BrickGrid& values,
                     double halfWidth);

    /// A file's string metadata, or "".
    std::string metadata(const std::string& key) const;
    void setMetadata(const std::string& key, const std::string& value);

    /// Writes every grid, with `history` appended to the file's own; the same content gives the
    /// same bytes. Failures to write show in AtomicFile::finish().
    void write(AtomicFile& out, const History& history) const;

private:
    struct Impl;
    explicit Volume(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> mImpl;
};

} // namespace eikonal::volume
