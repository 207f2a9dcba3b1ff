// Which objects are near the cubes of a domain, and which hold them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace eikonal::scene {

/// Of a cube of voxels: the objects whose boundary is near it and those that hold its centre, a bit
/// each.
struct ObjectSets {
    std::uint64_t near = 0, inside = 0;

    bool operator==(const ObjectSets&) const = default;
};

/// The sets of some cubes. Most have those of others: each pair of sets is listed once.
struct ListedSets {
    std::vector<ObjectSets> list;
    std::vector<std::uint32_t> places; ///< per cube, in the list
};

ListedSets listSets(const std::vector<ObjectSets>& cubes);

/// All cubes of one part after the other.
ListedSets joinLists(std::vector<ListedSets> parts);

} // namespace eikonal::scene
