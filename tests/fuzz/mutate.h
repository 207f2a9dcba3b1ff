// Damage as files suffer it, by a seed: bits, bytes, lengths, parts cut out or doubled.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

namespace eikonal {

/// One place of damage.
inline void damage(std::string& bytes, std::mt19937& random) {
    const auto below = [&](size_t n) { return random() % std::max<size_t>(n, 1); };
    // Many of the places lie in the first kilobytes, where most lengths stand.
    const size_t place =
        random() % 4 ? below(bytes.size()) : below(std::min<size_t>(bytes.size(), 4096));
    static const std::uint64_t kSpecial[] = {0,
                                             1,
                                             2,
                                             7,
                                             0x7f,
                                             0xff,
                                             0x7fff,
                                             0xffff,
                                             0x7fffffff,
                                             0x80000000,
                                             0xffffffff,
                                             0x100000000,
                                             0x7fffffffffffffff,
                                             0x8000000000000000,
                                             0xffffffffffffffff,
                                             0xfffffffffffffff0};
    switch (random() % 16) {
    case 0:
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
        break;
    case 1:
        bytes[place] = static_cast<char>(random());
        break;
    case 2:
    case 3: { // a number
        const size_t width = size_t{1} << random() % 4;
        const std::uint64_t value = kSpecial[random() % std::size(kSpecial)];
        if (place + width <= bytes.size()) std::memcpy(&bytes[place], &value, width);
        break;
    }
    case 4:
        bytes.erase(place, 1 + below(64));
        break;
    case 5:
        bytes.insert(place, bytes.substr(below(bytes.size()), 1 + below(64)));
        break;
    default:
        bytes[place] = static_cast<char>(bytes[place] + 1 - 2 * static_cast<int>(below(2)));
    }
    if (bytes.empty()) bytes.push_back('\0');
}

inline void mutate(std::string& bytes, std::uint32_t seed) {
    std::mt19937 random(seed);
    const int places = random() % 2 ? 1 : 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < places; ++i) damage(bytes, random);
    if (random() % 32 == 0) bytes.resize(random() % bytes.size() + 1);
}

} // namespace eikonal
