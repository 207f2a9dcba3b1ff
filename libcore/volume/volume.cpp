// A scene volume: the named grids of one .vdb file, where they lie in the world, and dense copies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/volume.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/level_set.h"
#include "volume/objects.h"
#include "volume/vdb_frame.h"
#include "volume/vdb_stream.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/matrix.hpp>
#include <iostream>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>

namespace eikonal::volume {

namespace {

using openvdb::FloatGrid;
using openvdb::GridBase;
using openvdb::Vec3SGrid;

constexpr double kLongestEdge = 1 << 20; // of a domain [voxel]

void initializeOnce() {
    static const bool done = (openvdb::initialize(), true);
    (void)done;
}

glm::ivec3 fromCoord(const openvdb::Coord& c) {
    return {c.x(), c.y(), c.z()};
}

openvdb::Coord toCoord(const glm::ivec3& c) {
    return {c.x, c.y, c.z};
}

openvdb::CoordBBox toBox(const IndexBox& box) {
    return {toCoord(box.min), toCoord(box.max)};
}

GridType typeOf(const GridBase& grid) {
    if (grid.isType<FloatGrid>()) return GridType::scalar;
    if (grid.isType<Vec3SGrid>()) return GridType::vector;
    return GridType::other;
}

/// Copies a tree's values in the box, active or not, into a dense array.
template<typename GridT> void copyOut(const GridT& grid, const IndexBox& box, DenseGrid& out) {
    using Value = typename GridT::ValueType;
    openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
        toBox(box), reinterpret_cast<Value*>(out.values.data()));
    openvdb::tools::copyToDense(grid, dense);
}

/// The reverse: a sparse tree of a dense array.
template<typename GridT>
typename GridT::Ptr copyIn(const IndexBox& box, const DenseGrid& in,
                           const typename GridT::ValueType& background, bool allActive) {
    using Value = typename GridT::ValueType;
    // Values that equal the background become inactive; one that occurs nowhere keeps all active.
    const Value none = openvdb::zeroVal<Value>() + std::numeric_limits<float>::lowest();
    auto grid = GridT::create(allActive ? none : background);
    const openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
        toBox(box), const_cast<Value*>(reinterpret_cast<const Value*>(in.values.data())));
    openvdb::tools::copyFromDense(dense, *grid, openvdb::zeroVal<Value>());
    if (allActive) openvdb::tools::changeBackground(grid->tree(), background);
    openvdb::tools::prune(grid->tree());
    return grid;
}

/// Hands on what the grid that `made` replaces says of itself, and its active voxels if asked to.
template<typename GridT> void inherit(GridT& made, const GridBase& old, bool keepActive) {
    // Items of the same name may differ in type, which insertMeta() refuses to replace.
    for (auto item = old.beginMeta(); item != old.endMeta(); ++item) {
        made.removeMeta(item->first);
        made.insertMeta(item->first, *item->second);
    }
    if (!keepActive) return;
    made.topologyUnion(static_cast<const GridT&>(old));
    openvdb::tools::prune(made.tree());
}

/// The box of active voxels: from the file's statistics where they are, else from the tree.
IndexBox activeBox(const GridBase& grid, bool treeIsRead) {
    IndexBox box;
    if (treeIsRead) {
        const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
        if (!active.empty()) box = {fromCoord(active.min()), fromCoord(active.max())};
        return box;
    }
    const auto low = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MIN);
    const auto high = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MAX);
    const auto& a = low->value();
    const auto& b = high->value();
    return {{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}};
}

bool hasStatistics(const GridBase& grid) {
    return grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MIN) &&
           grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MAX);
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

struct Volume::Impl {
    struct Entry {
        GridBase::Ptr grid;
        IndexBox active;
        bool read = false; // its tree, not only its metadata
    };

    std::string path;
    Frame frame;
    IndexBox domain;
    GridNames names;
    openvdb::MetaMap metadata;
    std::unique_ptr<openvdb::io::File> file; // open while entries may still have to be read
    std::vector<Entry> entries;

    std::string nameInFile(const std::string& grid) const {
        const auto mapped = names.find(grid);
        return mapped == names.end() ? grid : mapped->second;
    }

    Entry* find(const std::string& grid) {
        const std::string name = nameInFile(grid);
        for (Entry& entry : entries)
            if (entry.grid->getName() == name) return &entry;
        return nullptr;
    }

    /// The contract name of a grid of the file, or "" if the contract has another for it.
    std::string contractName(const std::string& nameInTheFile) const {
        for (const auto& [contract, mapped] : names)
            if (mapped == nameInTheFile) return contract;
        return names.count(nameInTheFile) > 0 ? "" : nameInTheFile;
    }

    std::string foundNames() const {
        std::vector<std::string> found;
        for (const Entry& entry : entries) found.push_back(entry.grid->getName());
        return join(found, ", ");
    }

    std::string where(const std::string& grid) const {
        return path + ": grid '" + nameInFile(grid) + "'";
    }

    void readEntry(Entry& entry) {
        if (entry.read) return;
        const std::string name = entry.grid->getName();
        try {
            entry.grid = file->readGrid(name);
        } catch (const std::exception& error) {
            throw DataError(path + ": grid '" + name + "' can't be read: " + error.what());
        }
        entry.read = true;
    }

    void add(const GridBase::Ptr& grid, bool read) {
        Entry entry{grid, {}, read};
        if (!read && !hasStatistics(*grid)) readEntry(entry);
        entry.active = activeBox(*entry.grid, entry.read);
        entries.push_back(entry);
    }

    void openFile() {
        std::error_code ignored;
        if (std::filesystem::is_directory(path, ignored))
            throw DataError(path + ": is a directory, expected a VDB file");
        std::ifstream in(path, std::ios_base::binary);
        if (!in) throw MissingError(path + ": can't open for reading");
        in.exceptions(std::ios_base::failbit | std::ios_base::badbit);
        const VdbHeader header = readVdbHeader(in);
        if (header.truncated) throw DataError(path + ": is cut short");
        if (!header.hasOffsets) {
            in.seekg(0);
            readStream(in);
            return;
        }
        file = std::make_unique<openvdb::io::File>(path);
        file->open(false);
        metadata = *file->getMetadata();
        const openvdb::GridPtrVecPtr grids = file->readAllGridMetadata();
        for (const auto& grid : *grids) add(grid, false);
    }

    void readStream(std::istream& in) {
        in.exceptions(std::ios_base::failbit | std::ios_base::badbit);
        openvdb::io::Stream stream(in, false);
        metadata = *stream.getMetadata();
        const openvdb::GridPtrVecPtr grids = stream.getGrids();
        for (const auto& grid : *grids) add(grid, true);
    }

    void settle() {
        if (entries.empty()) throw DataError(path + ": holds no grids");
        frame = toFrame(entries[0].grid->transform(),
                        path + ": grid '" + entries[0].grid->getName() + "'");
        for (const Entry& entry : entries) {
            const std::string name = path + ": grid '" + entry.grid->getName() + "'";
            if (!nearlyEqual(frame, toFrame(entry.grid->transform(), name)))
                throw DataError(name + " is on another transform than grid '" +
                                entries[0].grid->getName() + "', expected one for all");
            domain.include(entry.active);
            for (const Entry& other : entries)
                if (&other != &entry && ruleFor(entry.grid->getName()) &&
                    other.grid->getName() == entry.grid->getName())
                    throw DataError(name + " is there twice, expected one");
        }
        for (const auto& [contractName, fileName] : names)
            if (!find(contractName))
                throw DataError(path + ": no grid '" + fileName + "' (found: " + foundNames() +
                                "), asked for as '" + contractName + "'");
        if (domain.empty()) throw DataError(path + ": has no active voxel");
        // Of statistics gone wrong. The bound keeps the number of voxels within 64 bits.
        const glm::dvec3 size = glm::dvec3(domain.max) - glm::dvec3(domain.min) + 1.0;
        if (std::max({size.x, size.y, size.z}) > kLongestEdge)
            throw DataError(path + ": its active voxels span " + toText(size.x) + " x " +
                            toText(size.y) + " x " + toText(size.z) + " voxels, expected at most " +
                            toText(kLongestEdge) + " along an axis");
    }

    /// Takes in a grid made under its contract name, in place of one of that name.
    void place(const GridBase::Ptr& grid) {
        grid->setTransform(toTransform(frame));
        const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
        const IndexBox active =
            box.empty() ? IndexBox{} : IndexBox{fromCoord(box.min()), fromCoord(box.max())};
        Entry* old = find(grid->getName());
        grid->setName(nameInFile(grid->getName()));
        if (old)
            *old = {grid, active, true};
        else
            entries.push_back({grid, active, true});
        domain.include(active);
    }
};

Volume::Volume(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
Volume::~Volume() = default;
Volume::Volume(Volume&&) noexcept = default;
Volume& Volume::operator=(Volume&&) noexcept = default;

Volume::Volume(const Frame& frame) : mImpl(new Impl) {
    initializeOnce();
    mImpl->frame = frame;
}

Volume Volume::open(const std::string& path, const GridNames& names) {
    initializeOnce();
    auto impl = std::make_unique<Impl>();
    impl->path = path == "-" ? "standard input" : path;
    impl->names = names;
    try {
        if (path == "-")
            impl->readStream(std::cin);
        else
            impl->openFile();
        impl->settle();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw DataError(impl->path + ": is no valid VDB file (asks for more memory than there is)");
    } catch (const std::ios_base::failure&) {
        throw DataError(impl->path + ": is cut short, or no VDB file");
    } catch (const std::exception& error) {
        throw DataError(impl->path + ": is no valid VDB file (" +
                        split(error.what(), '\n').front() + ")");
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
    for (const Impl::Entry& entry : mImpl->entries)
        facts.push_back({entry.grid->getName(), entry.grid->valueType(), entry.active});
    return facts;
}

std::vector<ObjectFacts> Volume::objects() const {
    std::map<std::string, const GridBase*> levelSets; // by contract name
    for (const Impl::Entry& entry : mImpl->entries) {
        const std::string name = mImpl->contractName(entry.grid->getName());
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
    const Impl::Entry* entry = mImpl->find(grid);
    if (!entry) return false;
    const GridRule* rule = ruleFor(grid);
    if (rule && typeOf(*entry->grid) != rule->type)
        throw DataError(mImpl->where(grid) + " holds " + entry->grid->valueType() + ", expected " +
                        (rule->type == GridType::scalar ? "float" : "vec3s"));
    return true;
}

void Volume::require(const std::string& grid) const {
    if (has(grid)) return;
    throw DataError(mImpl->path + ": no grid '" + mImpl->nameInFile(grid) +
                    "' (found: " + mImpl->foundNames() + ")");
}

glm::vec3 Volume::background(const std::string& grid, const glm::vec3& absent) const {
    if (!has(grid)) return absent;
    Impl::Entry& entry = *mImpl->find(grid);
    mImpl->readEntry(entry);
    glm::vec3 value;
    if (typeOf(*entry.grid) == GridType::vector) {
        const auto& v = openvdb::gridConstPtrCast<Vec3SGrid>(entry.grid)->background();
        value = {v.x(), v.y(), v.z()};
    } else {
        value = glm::vec3(openvdb::gridConstPtrCast<FloatGrid>(entry.grid)->background());
    }
    for (int i = 0; i < 3; ++i)
        if (const auto wrong = fault(ruleFor(grid), value[i]))
            throw DataError(mImpl->where(grid) + ": the background " + *wrong);
    return value;
}

std::optional<glm::vec3> Volume::constant(const std::string& grid) const {
    require(grid);
    if (!mImpl->find(grid)->active.empty()) return std::nullopt;
    return background(grid, glm::vec3(0));
}

DenseGrid Volume::dense(const std::string& grid, const IndexBox& box) const {
    require(grid);
    Impl::Entry& entry = *mImpl->find(grid);
    mImpl->readEntry(entry);
    DenseGrid out;
    out.size = box.size();
    const bool vector = typeOf(*entry.grid) == GridType::vector;
    if (typeOf(*entry.grid) == GridType::other)
        throw DataError(mImpl->where(grid) + " holds " + entry.grid->valueType() +
                        ", expected float or vec3s");
    out.components = vector ? 3 : 1;
    try {
        out.values.resize(static_cast<size_t>(box.voxels()) * out.components);
    } catch (const std::exception&) { // bad_alloc, or length_error for sizes beyond all memory
        throw MemoryError(mImpl->where(grid) + " needs " +
                          bytesText(4.0 * static_cast<double>(box.voxels()) * out.components) +
                          " of memory");
    }
    if (vector)
        copyOut(*openvdb::gridConstPtrCast<Vec3SGrid>(entry.grid), box, out);
    else
        copyOut(*openvdb::gridConstPtrCast<FloatGrid>(entry.grid), box, out);
    if (const auto wrong = findFault(ruleFor(grid), out, box.min))
        throw DataError(mImpl->where(grid) + ": " + *wrong);
    return out;
}

void Volume::put(const std::string& grid, const IndexBox& box, const DenseGrid& values,
                 const PutOptions& options) {
    if (const auto wrong = findFault(nullptr, values, box.min))
        throw InternalError("grid '" + grid + "': " + *wrong);
    Impl::Entry* old = mImpl->find(grid);
    const GridType type = values.components == 3 ? GridType::vector : GridType::scalar;
    if (old && typeOf(*old->grid) != type) old = nullptr;
    if (old && options.keepActive) mImpl->readEntry(*old);
    GridBase::Ptr made;
    const glm::vec3 b = options.background;
    if (type == GridType::vector) {
        const auto vectors =
            copyIn<Vec3SGrid>(box, values, openvdb::Vec3s(b.x, b.y, b.z), options.allActive);
        if (old) inherit(*vectors, *old->grid, options.keepActive);
        if (!options.vectorType.empty()) {
            const bool isVector = options.vectorType == "vector";
            vectors->setVectorType(isVector ? openvdb::VEC_CONTRAVARIANT_RELATIVE
                                            : openvdb::VEC_INVARIANT);
        }
        made = vectors;
    } else {
        const auto scalars = copyIn<FloatGrid>(box, values, b.x, options.allActive);
        scalars->setGridClass(openvdb::GRID_FOG_VOLUME);
        if (old) inherit(*scalars, *old->grid, options.keepActive);
        made = scalars;
    }
    made->setName(grid);
    if (!old) made->setCreator("eikonal");
    mImpl->place(made);
}

void Volume::putConstant(const std::string& grid, const glm::vec3& value) {
    const GridRule* rule = ruleFor(grid);
    if (!rule) throw InternalError("grid '" + grid + "': not of the contract, it has no type");
    GridBase::Ptr made;
    if (rule->type == GridType::vector) {
        const auto vectors = Vec3SGrid::create(openvdb::Vec3s(value.x, value.y, value.z));
        vectors->setVectorType(openvdb::VEC_INVARIANT);
        made = vectors;
    } else {
        made = FloatGrid::create(value.x);
        made->setGridClass(openvdb::GRID_FOG_VOLUME);
    }
    made->setName(grid);
    made->setCreator("eikonal");
    mImpl->place(made);
}

void Volume::putLevelSet(const ObjectFacts& object, const IndexBox& box, const DenseGrid& values,
                         double halfWidth) {
    if (const auto wrong = findFault(nullptr, values, box.min))
        throw InternalError("grid '" + object.sdf + "': " + *wrong);
    const auto made =
        makeLevelSet(box, values, static_cast<float>(halfWidth * mImpl->frame.voxelSize));
    made->setCreator("eikonal");
    const Impl::Entry* old = mImpl->find(object.sdf);
    if (old && typeOf(*old->grid) == GridType::scalar) inherit(*made, *old->grid, false);
    made->setGridClass(openvdb::GRID_LEVEL_SET);
    describe(*made, object);
    made->setName(object.sdf);
    mImpl->place(made);
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
    openvdb::GridCPtrVec grids;
    for (Impl::Entry& entry : mImpl->entries) {
        mImpl->readEntry(entry);
        grids.push_back(entry.grid);
    }
    try {
        writeVdb(out.stream(), out.seekable(), grids, metadata, command);
    } catch (const std::exception& error) {
        throw IoError(out.path() + ": write failed: " + error.what());
    }
}

} // namespace eikonal::volume
