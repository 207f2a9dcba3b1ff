// The grids of an open scene volume: which are the contract's, where they lie, what is read.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/entries.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/vdb_frame.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace eikonal::volume {

namespace {

constexpr double kLongestEdge = 1 << 20;   // of a domain [voxel]
constexpr double kFarthestIndex = 1 << 30; // of a domain's voxels; sums of two still are ints

} // namespace

void initializeOpenVdb() {
    static const bool done = (openvdb::initialize(), true);
    (void)done;
}

glm::ivec3 fromCoord(const openvdb::Coord& c) {
    return {c.x(), c.y(), c.z()};
}

openvdb::CoordBBox toBox(const IndexBox& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

GridType typeOf(const std::string& treeType) {
    if (treeType == "Tree_float_5_4_3" || treeType == "Tree_double_5_4_3") return GridType::scalar;
    if (treeType == "Tree_vec3s_5_4_3" || treeType == "Tree_vec3d_5_4_3") return GridType::vector;
    return GridType::other;
}

std::string Volume::Impl::nameInFile(const std::string& grid) const {
    const auto mapped = names.find(grid);
    return mapped == names.end() ? grid : mapped->second;
}

std::string Volume::Impl::contractName(const std::string& nameInTheFile) const {
    for (const auto& [contract, mapped] : names)
        if (mapped == nameInTheFile) return contract;
    return names.count(nameInTheFile) > 0 ? "" : nameInTheFile;
}

Entry* Volume::Impl::find(const std::string& grid) {
    const std::string name = nameInFile(grid);
    for (Entry& entry : entries)
        if (entry.name == name) return &entry;
    return nullptr;
}

std::string Volume::Impl::foundNames() const {
    std::vector<std::string> found;
    for (const Entry& entry : entries) found.push_back(entry.name);
    std::sort(found.begin(), found.end());
    constexpr size_t kMost = 20; // in a line
    if (found.size() > kMost) {
        const std::string more = "and " + std::to_string(found.size() - kMost) + " more";
        found.resize(kMost);
        found.push_back(more);
    }
    return join(found, ", ");
}

std::string Volume::Impl::where(const std::string& grid) const {
    return path + ": grid '" + nameInFile(grid) + "'";
}

void Volume::Impl::readEntry(Entry& entry) {
    if (entry.read) return;
    try {
        entry.grid = file->read(*entry.record);
    } catch (const VdbDamage& damage) {
        throw DataError(path + ": grid '" + entry.name + "' can't be read: " + damage.what());
    } catch (const std::bad_alloc&) {
        throw MemoryError(path + ": grid '" + entry.name + "' needs more memory than there is");
    }
    entry.read = true;
}

Entry& Volume::Impl::numbers(const std::string& grid) {
    Entry& entry = *find(grid);
    if (entry.type == GridType::other)
        throw DataError(where(grid) + " holds " + entry.valueType + ", expected float or vec3s");
    requireHead(entry);
    if (!entry.elsewhere.empty()) throw DataError(entry.elsewhere);
    readEntry(entry);
    return entry;
}

void Volume::Impl::requireHead(Entry& entry) {
    if (entry.grid) return;
    readHead(entry);
    entry.elsewhere = elsewhereOf(entry);
}

VdbBody Volume::Impl::bodyOf(const Entry& entry) const {
    const std::string name = path + ": grid '" + entry.name + "'";
    if (entry.record) {
        try {
            return file->body(*entry.record);
        } catch (const VdbDamage& damage) {
            throw DataError(name + " can't be copied: " + damage.what());
        }
    }
    try {
        return volume::bodyOf(entry.grid);
    } catch (const VdbDamage& damage) {
        throw InternalError(name + " was not written whole: " + damage.what());
    }
}

void Volume::Impl::readIndex() {
    file.emplace(VdbFile::open(path == "standard input" ? "-" : path));
    metadata = file->metadata();
    for (const VdbRecord& record : file->index().grids) {
        Entry& entry = entries.emplace_back();
        entry.name = record.name();
        entry.type = typeOf(record.type);
        entry.valueType = record.valueType();
        if (entry.type == GridType::other &&
            typeOf("Tree_" + entry.valueType + "_5_4_3") != GridType::other)
            entry.valueType = record.type; // it is the tree that is unusual
        entry.half = record.half;
        entry.record = &record;
    }
}

bool Volume::Impl::isKnown(const Entry& entry) const {
    const std::string contract = contractName(entry.name);
    return ruleFor(contract) != nullptr || names.count(contract) > 0;
}

void Volume::Impl::readHead(Entry& entry) {
    try {
        entry.grid = file->readHead(*entry.record);
        entry.active = file->checkedBox(*entry.record);
    } catch (const VdbDamage& damage) {
        throw DataError(path + ": grid '" + entry.name + "' can't be read: " + damage.what());
    }
}

/// Of what no stage can use for its type nothing is read.
void Volume::Impl::readHeads(bool knownOnly) {
    for (Entry& entry : entries)
        if (!entry.grid && entry.type != GridType::other && (!knownOnly || isKnown(entry)))
            readHead(entry);
}

/// Why a grid is not one of the scene, or "".
std::string Volume::Impl::elsewhereOf(const Entry& entry) const {
    const std::string name = path + ": grid '" + entry.name + "'";
    try {
        if (nearlyEqual(frame, toFrame(entry.grid->transform(), name))) return "";
    } catch (const DataError& error) {
        return error.what();
    }
    return name + " is on another transform than grid '" + mFrameOf + "', expected one for all";
}

/// The scene lies where its index lies, else where the first of its grids does. What lies elsewhere
/// matters only to the stage that asks for it.
void Volume::Impl::findFrame() {
    const Entry* first = find("ior");
    if (!first || !first->grid) {
        // Light on surfaces has finer voxels: it tells where the scene lies if nothing else does.
        const auto knownBut = [this](const char* name) {
            return std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
                return entry.grid != nullptr && contractName(entry.name) != name;
            });
        };
        auto known = knownBut("irradiance");
        if (known == entries.end()) known = knownBut("");
        if (known == entries.end())
            throw DataError(path + ": holds no grid of a scene (found: " + foundNames() + ")");
        first = &*known;
    }
    mFrameOf = first->name;
    frame = toFrame(first->grid->transform(), path + ": grid '" + first->name + "'");
    for (Entry& entry : entries) {
        if (!entry.grid) continue;
        entry.elsewhere = elsewhereOf(entry);
        if (entry.elsewhere.empty()) domain.include(entry.active);
    }
}

void Volume::Impl::checkNames() {
    for (const auto& [contract, inFile] : names)
        if (!find(contract))
            throw DataError(path + ": no grid '" + inFile + "' (found: " + foundNames() + ")" +
                            (contract == inFile ? "" : ", asked for as '" + contract + "'"));
    std::set<std::string> seen;
    for (const Entry& entry : entries)
        if (isKnown(entry) && !seen.insert(entry.name).second)
            throw DataError(path + ": grid '" + entry.name + "' is there twice, expected one");
}

void Volume::Impl::checkDomain() const {
    if (domain.empty()) throw DataError(path + ": has no active voxel");
    // The bound keeps the number of voxels within 64 bits.
    const glm::dvec3 least(domain.min), most(domain.max), size = most - least + 1.0;
    if (std::max({size.x, size.y, size.z}) > kLongestEdge)
        throw DataError(path + ": its active voxels span " + toText(size.x) + " x " +
                        toText(size.y) + " x " + toText(size.z) + " voxels, expected at most " +
                        toText(kLongestEdge) + " along an axis");
    if (std::max({-least.x, -least.y, -least.z, most.x, most.y, most.z}) > kFarthestIndex)
        throw DataError(path + ": its active voxels lie beyond the index " +
                        toText(kFarthestIndex));
}

void Volume::Impl::open(const ChooseNames& choose) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw DataError(path + ": is a directory, expected a VDB file");
    readIndex();
    if (entries.empty()) throw DataError(path + ": holds no grids");
    std::vector<std::string> found;
    for (const Entry& entry : entries) found.push_back(entry.name);
    names = choose(found);
    checkNames();
    readHeads(true);
    const bool anyKnown = std::any_of(entries.begin(), entries.end(),
                                      [](const Entry& entry) { return entry.grid != nullptr; });
    if (!anyKnown) readHeads(false); // what there is tells at least where it lies
    findFrame();
    checkDomain();
}

void Volume::Impl::place(const openvdb::GridBase::Ptr& grid) {
    grid->setTransform(toTransform(frame));
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    Entry* entry = find(grid->getName());
    if (!entry) {
        entry = &entries.emplace_back();
        entry->name = nameInFile(grid->getName());
    }
    grid->setName(entry->name);
    const IndexBox active =
        box.empty() ? IndexBox{} : IndexBox{fromCoord(box.min()), fromCoord(box.max())};
    *entry = {
        entry->name, grid->valueType(), typeOf(grid->type()), false, active, grid, true, nullptr,
        ""};
    domain.include(active);
}

} // namespace eikonal::volume
