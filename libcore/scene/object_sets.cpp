// Which objects are near the cubes of a domain, and which hold them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/object_sets.h"

#include <algorithm>
#include <tbb/parallel_for.h>
#include <unordered_map>

namespace eikonal::scene {

namespace {

struct Hash {
    size_t operator()(const ObjectSets& sets) const {
        // Odd multipliers, so that neither word's high bits are lost: the golden ratio's digits.
        const std::uint64_t mixed =
            (sets.near ^ (sets.inside * 0x9E3779B97F4A7C15u)) * 0x9E3779B97F4A7C15u;
        return static_cast<size_t>(mixed ^ (mixed >> 32));
    }
};

/// Gives places to sets, in the order in which they are first seen.
class Lister {
public:
    explicit Lister(std::vector<ObjectSets>& list) : mList(list) {}

    std::uint32_t placeOf(const ObjectSets& sets) {
        const auto [found, isNew] =
            mPlaces.try_emplace(sets, static_cast<std::uint32_t>(mList.size()));
        if (isNew) mList.push_back(sets);
        return found->second;
    }

private:
    std::vector<ObjectSets>& mList;
    std::unordered_map<ObjectSets, std::uint32_t, Hash> mPlaces;
};

} // namespace

ListedSets listSets(const std::vector<ObjectSets>& cubes) {
    ListedSets result;
    result.places.reserve(cubes.size());
    Lister lister(result.list);
    for (size_t i = 0; i < cubes.size(); ++i) // a cube mostly has the sets of the one before
        result.places.push_back(i > 0 && cubes[i] == cubes[i - 1] ? result.places.back()
                                                                  : lister.placeOf(cubes[i]));
    return result;
}

ListedSets joinLists(std::vector<ListedSets> parts) {
    ListedSets result;
    Lister lister(result.list);
    std::vector<size_t> begins;
    std::vector<std::vector<std::uint32_t>> moved; // where each part's list has gone
    size_t cubes = 0;
    for (const ListedSets& part : parts) {
        std::vector<std::uint32_t> places;
        for (const ObjectSets& sets : part.list) places.push_back(lister.placeOf(sets));
        moved.push_back(std::move(places));
        begins.push_back(cubes);
        cubes += part.places.size();
    }
    result.places.resize(cubes);
    tbb::parallel_for(size_t{0}, parts.size(), [&](size_t p) {
        std::transform(parts[p].places.begin(), parts[p].places.end(),
                       result.places.begin() + static_cast<std::ptrdiff_t>(begins[p]),
                       [&](std::uint32_t place) { return moved[p][place]; });
    });
    return result;
}

} // namespace eikonal::scene
