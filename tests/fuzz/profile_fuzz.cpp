// Profiles, as tables and as SVG drawings, and what is turned of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "mesh/check.h"
#include "shapes/profile.h"
#include "shapes/revolve.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace eikonal;
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    try {
        const shapes::Profile profile = shapes::profileFrom(text, "profile", 0);
        if (profile.points.size() < 2 || profile.points.size() != profile.places.size())
            std::abort();
        for (const glm::dvec2& point : profile.points)
            if (!std::isfinite(point.x + point.y) || point.x < 0) std::abort();
        // What is drawn in many parts takes long, and finds nothing that few parts do not.
        if (profile.points.size() > 300) return 0;
        if (!mesh::checkTopology(shapes::revolve(profile, {8, 0})).closed) std::abort();
    } catch (const Error&) { // refused, which is fine
        return 0;
    }
    return 0;
}
