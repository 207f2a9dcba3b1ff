// What a level set's metadata say of the object it bounds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/objects.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

namespace eikonal::volume {

namespace {

constexpr const char* kName = "eikonal:object";
constexpr const char* kPriority = "eikonal:priority";
constexpr const char* kOrder = "eikonal:order";
constexpr const char* kRoughness = "eikonal:roughness";
constexpr const char* kMetalIndex = "eikonal:metal_index";
constexpr const char* kMetalExtinction = "eikonal:metal_extinction";
constexpr const char* kAxis = "eikonal:axis";
constexpr const char* kIndexE = "eikonal:ior_extraordinary";
constexpr const char* kDispersionE = "eikonal:dispersion_extraordinary";
constexpr const char* kAbsorptionE = "eikonal:absorption_extraordinary";

/// An item of metadata of that type, or null where it is absent.
template<typename Meta>
const Meta* itemOf(const openvdb::GridBase& grid, const char* key, const char* wanted,
                   const std::string& where) {
    const auto item = grid[key];
    if (!item) return nullptr;
    if (item->typeName() == Meta::staticTypeName()) return static_cast<const Meta*>(item.get());
    throw DataError(where + ": its " + key + " is " + item->typeName() + " " + item->str() +
                    ", expected " + wanted);
}

int integerOf(const openvdb::GridBase& grid, const char* key, int absent,
              const std::string& where) {
    const auto* item = itemOf<openvdb::Int32Metadata>(grid, key, "an int32", where);
    return item ? item->value() : absent;
}

float roughnessOf(const openvdb::GridBase& grid, const std::string& where) {
    const auto* item = itemOf<openvdb::FloatMetadata>(grid, kRoughness, "a float", where);
    const float roughness = item ? item->value() : 0;
    if (!(roughness >= 0 && roughness <= 1))
        throw DataError(where + ": its " + kRoughness + " is " + toText(roughness) +
                        ", expected 0 to 1");
    return roughness;
}

std::optional<glm::vec3> vectorOf(const openvdb::GridBase& grid, const char* key,
                                  const std::string& where) {
    const auto* item = itemOf<openvdb::Vec3SMetadata>(grid, key, "a vec3s", where);
    return item ? std::optional(glm::vec3(item->value()[0], item->value()[1], item->value()[2]))
                : std::nullopt;
}

std::optional<float> numberOf(const openvdb::GridBase& grid, const char* key,
                              const std::string& where) {
    const auto* item = itemOf<openvdb::FloatMetadata>(grid, key, "a float", where);
    return item ? std::optional(item->value()) : std::nullopt;
}

std::optional<Metal> metalOf(const openvdb::GridBase& grid, const std::string& where) {
    const auto index = vectorOf(grid, kMetalIndex, where),
               extinction = vectorOf(grid, kMetalExtinction, where);
    if (!index && !extinction) return {};
    if (!index || !extinction)
        throw DataError(where + ": it has one of " + kMetalIndex + " and " + kMetalExtinction +
                        ", expected both");
    for (int c = 0; c < 3; ++c)
        if (!((*index)[c] > 0 && (*index)[c] < 1e3F && (*extinction)[c] >= 0 &&
              (*extinction)[c] < 1e3F))
            throw DataError(where + ": its metal has n " + toText((*index)[c]) + " and k " +
                            toText((*extinction)[c]) +
                            ", expected n above 0, k not below 0, both below 1000");
    return Metal{*index, *extinction};
}

/// An axis of length 0 says that there is none.
std::optional<Crystal> crystalOf(const openvdb::GridBase& grid, const std::string& where) {
    const auto axis = vectorOf(grid, kAxis, where);
    const auto index = numberOf(grid, kIndexE, where);
    const auto dispersion = numberOf(grid, kDispersionE, where);
    const auto absorption = vectorOf(grid, kAbsorptionE, where);
    if (!axis && !index && !dispersion && !absorption) return {};
    if (!axis || !index || !dispersion || !absorption)
        throw DataError(where + ": it has some of " + kAxis + ", " + kIndexE + ", " + kDispersionE +
                        " and " + kAbsorptionE + ", expected all or none");
    const float length = glm::length(*axis);
    if (length == 0) return {};
    if (!isAxis(*axis))
        throw DataError(where + ": its " + kAxis + " has the length " + toText(length) +
                        ", expected 1, or 0: none");
    if (!(*index >= 1 && std::isfinite(*index)))
        throw DataError(where + ": its " + kIndexE + " is " + toText(*index) +
                        ", expected 1 or more");
    if (!std::isfinite(*dispersion))
        throw DataError(where + ": its " + kDispersionE + " is " + toText(*dispersion) +
                        ", expected a finite number");
    for (int c = 0; c < 3; ++c)
        if (!((*absorption)[c] >= 0 && std::isfinite((*absorption)[c])))
            throw DataError(where + ": its " + kAbsorptionE + " is " + toText((*absorption)[c]) +
                            ", expected 0 or more");
    return Crystal{*index, *dispersion, *axis / length, *absorption};
}

} // namespace

bool isAxis(const glm::dvec3& axis) {
    return std::abs(glm::length(axis) - 1) < 1e-3; // as people write 0.7071
}

bool isLevelSet(const std::string& grid) {
    return grid == "sdf" || grid.rfind("sdf.", 0) == 0;
}

ObjectFacts objectOf(const openvdb::GridBase& grid, const std::string& sdf, int position,
                     const std::string& where) {
    ObjectFacts object;
    object.sdf = sdf;
    object.name = sdf == "sdf" ? "" : sdf.substr(4);
    if (const auto* item = itemOf<openvdb::StringMetadata>(grid, kName, "a string", where))
        object.name = item->value();
    object.priority = integerOf(grid, kPriority, 0, where);
    object.order = integerOf(grid, kOrder, position, where);
    object.roughness = roughnessOf(grid, where);
    object.metal = metalOf(grid, where);
    object.crystal = crystalOf(grid, where);
    return object;
}

void describe(openvdb::GridBase& grid, const ObjectFacts& object) {
    for (const char* key : {kName, kPriority, kOrder, kRoughness, kMetalIndex, kMetalExtinction,
                            kAxis, kIndexE, kDispersionE, kAbsorptionE})
        grid.removeMeta(key);
    grid.insertMeta(kName, openvdb::StringMetadata(object.name));
    grid.insertMeta(kPriority, openvdb::Int32Metadata(object.priority));
    grid.insertMeta(kOrder, openvdb::Int32Metadata(object.order));
    if (object.roughness > 0) grid.insertMeta(kRoughness, openvdb::FloatMetadata(object.roughness));
    const auto put = [&](const char* key, const glm::vec3& v) {
        grid.insertMeta(key, openvdb::Vec3SMetadata(openvdb::Vec3s(v.x, v.y, v.z)));
    };
    if (object.crystal) {
        put(kAxis, object.crystal->axis);
        grid.insertMeta(kIndexE, openvdb::FloatMetadata(object.crystal->index));
        grid.insertMeta(kDispersionE, openvdb::FloatMetadata(object.crystal->dispersion));
        put(kAbsorptionE, object.crystal->absorption);
    }
    if (!object.metal) return;
    put(kMetalIndex, object.metal->index);
    put(kMetalExtinction, object.metal->extinction);
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
