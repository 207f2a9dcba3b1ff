// What a level set's metadata say of the object it bounds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/objects.h"

#include "base/error.h"

#include <algorithm>
#include <set>

namespace eikonal::volume {

namespace {

constexpr const char* kName = "eikonal:object";
constexpr const char* kPriority = "eikonal:priority";
constexpr const char* kOrder = "eikonal:order";

int integerOf(const openvdb::GridBase& grid, const char* key, int absent,
              const std::string& where) {
    const auto item = grid[key];
    if (!item) return absent;
    if (item->typeName() == openvdb::Int32Metadata::staticTypeName())
        return static_cast<const openvdb::Int32Metadata&>(*item).value();
    throw DataError(where + ": its " + key + " is " + item->typeName() + " " + item->str() +
                    ", expected an int32");
}

} // namespace

bool isLevelSet(const std::string& grid) {
    return grid == "sdf" || grid.rfind("sdf.", 0) == 0;
}

ObjectFacts objectOf(const openvdb::GridBase& grid, const std::string& sdf, int position,
                     const std::string& where) {
    ObjectFacts object;
    object.sdf = sdf;
    object.name = sdf == "sdf" ? "" : sdf.substr(4);
    if (const auto item = grid[kName]) {
        if (item->typeName() != openvdb::StringMetadata::staticTypeName())
            throw DataError(where + ": its " + kName + " is " + item->typeName() +
                            ", expected a string");
        object.name = static_cast<const openvdb::StringMetadata&>(*item).value();
    }
    object.priority = integerOf(grid, kPriority, 0, where);
    object.order = integerOf(grid, kOrder, position, where);
    return object;
}

void describe(openvdb::GridBase& grid, const ObjectFacts& object) {
    for (const char* key : {kName, kPriority, kOrder}) grid.removeMeta(key);
    grid.insertMeta(kName, openvdb::StringMetadata(object.name));
    grid.insertMeta(kPriority, openvdb::Int32Metadata(object.priority));
    grid.insertMeta(kOrder, openvdb::Int32Metadata(object.order));
}

void settlePrecedence(std::vector<ObjectFacts>& objects, const std::string& path) {
    std::set<std::string> names;
    for (const ObjectFacts& object : objects) {
        const std::string where = path + ": grid '" + object.sdf + "' bounds '" + object.name;
        if (object.name == kMedium)
            throw DataError(where + "', expected another name: that is what surrounds all objects");
        if (!names.insert(object.name).second)
            throw DataError(where + "', as another grid does, expected one level set an object");
    }
    std::stable_sort(
        objects.begin(), objects.end(), [](const ObjectFacts& a, const ObjectFacts& b) {
            return a.priority != b.priority ? a.priority > b.priority : a.order > b.order;
        });
}

} // namespace eikonal::volume
