// Numbers that are joined into groups (union-find).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace eikonal::mesh {

/// Labels that belong together; the lowest of them stands for all.
class Groups {
public:
    explicit Groups(size_t count) : mParents(count) {
        std::iota(mParents.begin(), mParents.end(), 0u);
    }
    std::uint32_t rootOf(std::uint32_t i) {
        while (mParents[i] != i) i = mParents[i] = mParents[mParents[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = rootOf(a);
        b = rootOf(b);
        mParents[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::uint32_t> roots() {
        std::vector<std::uint32_t> all(mParents.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = rootOf(i);
        return all;
    }

private:
    std::vector<std::uint32_t> mParents;
};

} // namespace eikonal::mesh
