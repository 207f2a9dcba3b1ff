// A scene volume: the named grids of one .vdb file, where they lie in the world, and dense copies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/volume.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/entries.h"
#include "volume/objects.h"
#include "volume/vdb_write.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

namespace eikonal::volume {

namespace {

/// Copies a tree's values in the box, active or not, into a dense array.
template<typename GridT, typename Stored>
void copyOut(const openvdb::GridBase& grid, const IndexBox& box, DenseGrid& out) {
    openvdb::tools::Dense<Stored, openvdb::tools::LayoutXYZ> dense(
        toBox(box), reinterpret_cast<Stored*>(out.values.data()));
    openvdb::tools::copyToDense(static_cast<const GridT&>(grid), dense);
}

void copyValues(const openvdb::GridBase& grid, const IndexBox& box, DenseGrid& out) {
    using openvdb::Vec3s;
    if (grid.isType<openvdb::FloatGrid>())
        return copyOut<openvdb::FloatGrid, float>(grid, box, out);
    if (grid.isType<openvdb::DoubleGrid>())
        return copyOut<openvdb::DoubleGrid, float>(grid, box, out);
    if (grid.isType<openvdb::Vec3SGrid>())
        return copyOut<openvdb::Vec3SGrid, Vec3s>(grid, box, out);
    copyOut<openvdb::Vec3DGrid, Vec3s>(grid, box, out);
}

template<typename GridT> glm::vec3 backgroundAs(const openvdb::GridBase& grid) {
    const auto& value = static_cast<const GridT&>(grid).background();
    if constexpr (openvdb::VecTraits<typename GridT::ValueType>::IsVec)
        return {value.x(), value.y(), value.z()};
    else
        return glm::vec3(static_cast<float>(value));
}

glm::vec3 backgroundOf(const openvdb::GridBase& grid) {
    if (grid.isType<openvdb::FloatGrid>()) return backgroundAs<openvdb::FloatGrid>(grid);
    if (grid.isType<openvdb::DoubleGrid>()) return backgroundAs<openvdb::DoubleGrid>(grid);
    if (grid.isType<openvdb::Vec3SGrid>()) return backgroundAs<openvdb::Vec3SGrid>(grid);
    return backgroundAs<openvdb::Vec3DGrid>(grid);
}

/// One number a voxel is grey: the same for R, G and B.
void makeGrey(DenseGrid& grid) {
    std::vector<float> colours;
    colours.reserve(grid.values.size() * 3);
    for (float value : grid.values) colours.insert(colours.end(), 3, value);
    grid.values = std::move(colours);
    grid.components = 3;
}

} // namespace

void IndexBox::include(const IndexBox& other) {
    if (other.empty()) return;
    if (empty()) {
        *this = other;
        return;
    }
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
}

glm::dmat4 Frame::indexFromWorld() const {
    return glm::inverse(worldFromIndex);
}

Volume::Volume(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
Volume::~Volume() = default;
Volume::Volume(Volume&&) noexcept = default;
Volume& Volume::operator=(Volume&&) noexcept = default;

Volume::Volume(const Frame& frame) : mImpl(new Impl) {
    initializeOpenVdb();
    mImpl->frame = frame;
}

Volume Volume::open(const std::string& path, const GridNames& names) {
    return open(path, [&](const std::vector<std::string>&) { return names; });
}

Volume Volume::open(const std::string& path, const ChooseNames& choose) {
    initializeOpenVdb();
    auto impl = std::make_unique<Impl>();
    impl->path = path == "-" ? "standard input" : path;
    try {
        impl->open(choose);
    } catch (const VdbDamage& damage) {
        throw DataError(impl->path + ": is no valid VDB file (" + damage.what() + ")");
    } catch (const std::bad_alloc&) {
        throw MemoryError(impl->path + ": needs more memory than there is");
    }
    return Volume(std::move(impl));
}

const std::string& Volume::path() const {
    return mImpl->path;
}

const Frame& Volume::frame() const {
    return mImpl->frame;
}

const IndexBox& Volume::domain() const {
    return mImpl->domain;
}

std::vector<GridFacts> Volume::grids() const {
    std::vector<GridFacts> facts;
    for (const Entry& entry : mImpl->entries)
        facts.push_back({entry.name, entry.valueType, entry.active});
    return facts;
}

bool Volume::holdsScene() const {
    return std::any_of(mImpl->entries.begin(), mImpl->entries.end(),
                       [this](const Entry& entry) { return mImpl->isKnown(entry); });
}

std::vector<ObjectFacts> Volume::objects() const {
    std::map<std::string, const openvdb::GridBase*> levelSets; // by contract name
    for (const Entry& entry : mImpl->entries) {
        const std::string name = mImpl->contractName(entry.name);
        if (isLevelSet(name) && has(name)) levelSets.emplace(name, entry.grid.get());
    }
    std::vector<ObjectFacts> objects;
    for (const auto& [name, grid] : levelSets)
        objects.push_back(
            objectOf(*grid, name, static_cast<int>(objects.size()), mImpl->where(name)));
    settlePrecedence(objects, mImpl->path);
    return objects;
}

bool Volume::has(const std::string& grid) const {
    const Entry* entry = mImpl->find(grid);
    if (!entry) return false;
    const GridRule* rule = ruleFor(grid);
    const GridType type = entry->type;
    const bool grey = rule && rule->type == GridType::vector && type == GridType::scalar;
    if (rule && type != rule->type && !grey)
        throw DataError(mImpl->where(grid) + " holds " + entry->valueType + ", expected " +
                        (rule->type == GridType::scalar ? "float" : "vec3s"));
    if (!entry->elsewhere.empty()) throw DataError(entry->elsewhere);
    return true;
}

void Volume::require(const std::string& grid) const {
    if (has(grid)) return;
    throw DataError(mImpl->path + ": no grid '" + mImpl->nameInFile(grid) +
                    "' (found: " + mImpl->foundNames() + ")");
}

glm::vec3 Volume::background(const std::string& grid, const glm::vec3& absent) const {
    if (!has(grid)) return absent;
    Entry& entry = mImpl->numbers(grid);
    const glm::vec3 value = backgroundOf(*entry.grid);
    for (int i = 0; i < 3; ++i)
        if (const auto wrong = fault(ruleFor(grid), value[i]))
            throw DataError(mImpl->where(grid) + ": the background " + *wrong);
    return value;
}

std::optional<glm::vec3> Volume::constant(const std::string& grid) const {
    require(grid);
    if (!mImpl->numbers(grid).active.empty()) return std::nullopt;
    return background(grid, glm::vec3(0));
}

DenseGrid Volume::dense(const std::string& grid, const IndexBox& box) const {
    require(grid);
    Entry& entry = mImpl->numbers(grid);
    const GridRule* rule = ruleFor(grid);
    const bool vector = entry.type == GridType::vector;
    DenseGrid out;
    out.size = box.size();
    out.components = vector ? 3 : 1;
    const int wanted = rule && rule->type == GridType::vector ? 3 : out.components;
    try {
        out.values.resize(static_cast<size_t>(box.voxels()) * out.components);
        copyValues(*entry.grid, box, out);
        if (wanted > out.components) makeGrey(out);
    } catch (const std::exception&) { // bad_alloc, or length_error for sizes beyond all memory
        throw MemoryError(mImpl->where(grid) + " needs " +
                          bytesText(4.0 * static_cast<double>(box.voxels()) * wanted) +
                          " of memory");
    }
    if (const auto wrong = findFault(rule, out, box.min))
        throw DataError(mImpl->where(grid) + ": " + *wrong);
    return out;
}

bool Volume::isStoredInHalf(const std::string& grid) const {
    const Entry* entry = mImpl->find(grid);
    return entry && entry->half;
}

std::string Volume::metadata(const std::string& key) const {
    const auto item = mImpl->metadata.getMetadata<openvdb::StringMetadata>(key);
    return item ? item->value() : "";
}

void Volume::setMetadata(const std::string& key, const std::string& value) {
    mImpl->metadata.removeMeta(key);
    mImpl->metadata.insertMeta(key, openvdb::StringMetadata(value));
}

void Volume::write(AtomicFile& out, const History& history) const {
    openvdb::MetaMap metadata(mImpl->metadata);
    const std::string command = appendHistory(this->metadata("eikonal:command"), history.command);
    for (const auto& [key, value] :
         {std::pair<std::string, std::string>{"eikonal:tool", history.tool},
          {"eikonal:version", history.version},
          {"eikonal:command", command}}) {
        metadata.removeMeta(key);
        metadata.insertMeta(key, openvdb::StringMetadata(value));
    }
    try {
        VdbWriter writer(out.stream(), metadata, mImpl->entries.size(), command);
        for (const Entry& entry : mImpl->entries) writer.add(mImpl->bodyOf(entry));
    } catch (const std::bad_alloc&) {
        throw MemoryError(out.path() + ": not enough memory to write its grids");
    } catch (const std::ios_base::failure& error) {
        throw IoError(out.path() + ": write failed: " + error.what());
    }
}

} // namespace eikonal::volume
