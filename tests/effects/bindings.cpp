// What each effect binds: shaders/README.md has the list of bindings.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

namespace effects {

namespace {

Bindings of(const std::vector<int>& blocks, const std::vector<int>& buffers,
            const std::vector<int>& textures) {
    Bindings bindings;
    for (const int number : blocks) bindings.insert({Binding::Kind::block, number});
    for (const int number : buffers) bindings.insert({Binding::Kind::buffer, number});
    for (const int number : textures) bindings.insert({Binding::Kind::texture, number});
    return bindings;
}

std::vector<Owned> viewBindings() {
    return {{"", of({0, 3}, {0, 2}, {})},
            {"refraction", of({}, {}, {8})},
            {"medium", of({}, {}, {1})},
            {"lobes", of({}, {}, {3})},
            {"emission beside lobes", of({}, {}, {4})},
            {"environment map", of({}, {}, {7})},
            // What light falls on a surface, and where it comes from, is looked up there.
            {"opaque surface", of({}, {}, {3, 5, 6})},
            {"paths", of({}, {1}, {})}};
}

std::vector<Owned> sharpViewBindings() {
    return {{"", of({0, 4}, {0, 2}, {9, 10})},
            {"index that varies", of({3}, {}, {8})},
            {"scattering", of({}, {}, {6})},
            {"lobes", of({}, {}, {3})},
            {"absorption that varies", of({}, {}, {12, 13})},
            {"environment map", of({}, {}, {7})},
            {"several objects", of({}, {}, {11})},
            {"opaque object", of({}, {}, {3, 6})},
            {"paths", of({}, {1}, {})}};
}

std::vector<Owned> photonBindings() {
    return {{"", of({0, 3}, {0, 1, 2, 3, 4}, {2})},
            {"refraction", of({}, {}, {8})},
            {"medium", of({}, {}, {3})},
            // Sums of green and blue, or of the direction's components, are buffers of their own.
            {"colour", of({}, {5, 6}, {4})},
            {"direction", of({}, {5, 6, 7}, {})},
            {"opaque surface", of({}, {}, {5})}};
}

std::vector<Owned> sharpPhotonBindings() {
    return {{"", of({0, 4}, {0, 1, 2, 3, 4, 10}, {9, 10})},
            {"index that varies", of({3}, {}, {2, 8})},
            {"colour", of({}, {5, 6}, {})},
            {"direction", of({}, {5, 6, 7}, {})},
            {"absorption that varies", of({}, {}, {12, 13})},
            {"several objects", of({}, {}, {11})}};
}

} // namespace

std::vector<Owned> bindingsOf(Family family) {
    switch (family) {
    case Family::view:
        return viewBindings();
    case Family::sharpView:
        return sharpViewBindings();
    case Family::photons:
        return photonBindings();
    default:
        return sharpPhotonBindings();
    }
}

} // namespace effects
