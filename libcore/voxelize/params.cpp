// What the voxelising stage is asked to do: objects, what they are made of, and the lattice.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/params.h"

#include "base/error.h"
#include "base/text.h"
#include "voxelize/shared.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace eikonal::voxelize {

namespace {

void require(bool holds, const std::string& option, const std::string& found,
             const std::string& wanted) {
    if (!holds) throw UsageError(option + ": found " + found + ", expected " + wanted);
}

/// Checks values as the floats they will be in the file.
class ValueCheck {
public:
    /// `prefix` leads the option's name, `of` says whose value it is.
    ValueCheck(const std::string& prefix, const std::string& of) : mPrefix(prefix), mOf(of) {}

    template<typename Holds>
    void one(const std::string& option, double value, const std::string& wanted,
             const Holds& holds) const {
        const auto stored = static_cast<float>(value);
        const bool wasFloat = static_cast<double>(stored) == value;
        require(std::isfinite(stored) && holds(stored), mPrefix + option,
                (wasFloat ? toText(stored) : toText(value)) + mOf, wanted);
    }
    template<typename Holds>
    void rgb(const std::string& option, const glm::dvec3& value, const std::string& wanted,
             const Holds& holds) const {
        for (int i = 0; i < 3; ++i) one(option, value[i], wanted, holds);
    }

private:
    std::string mPrefix, mOf;
};

void checkMaterial(const Material& m, const ValueCheck& check) {
    const auto notNegative = [](float x) { return x >= 0; };
    const auto share = [](float x) { return x >= 0 && x <= 1; };
    check.one("ior", m.ior, "above 0", [](float x) { return x > 0; });
    check.one("dispersion", m.dispersion, "a number within a float's range",
              [](float) { return true; });
    check.rgb("absorption", m.absorption, "0 or more", notNegative);
    check.rgb("scattering", m.scattering, "0 or more", notNegative);
    check.one("anisotropy", m.anisotropy, "between -1 and 1",
              [](float x) { return x > -1 && x < 1; });
    check.rgb("emission", m.emission, "0 or more", notNegative);
    check.one("opacity", m.opacity, "0 to 1", share);
    check.rgb("albedo", m.albedo, "0 to 1", share);
    check.rgb("reflectance", m.reflectance, "0 or more", notNegative);
    check.one("roughness", m.roughness, "0 to 1", share);
    if (!m.crystal) return;
    check.one("ior-extraordinary", m.crystal->index, "1 or more", [](float x) { return x >= 1; });
    check.one("dispersion-extraordinary", m.crystal->dispersion, "a number within a float's range",
              [](float) { return true; });
    check.rgb("absorption-extraordinary", m.crystal->absorption, "0 or more", notNegative);
}

void checkBounds(const mesh::Box& box) {
    const glm::dvec3 edges = box.max - box.min;
    for (int i = 0; i < 3; ++i)
        require(edges[i] > 0 && std::isfinite(edges[i]), "--bounds",
                toText(box.min[i]) + " to " + toText(box.max[i]),
                "X0,Y0,Z0,X1,Y1,Z1 with X0 < X1, Y0 < Y1 and Z0 < Z1");
}

void checkNames(const std::vector<Object>& objects, bool ground) {
    std::set<std::string> names;
    if (ground) names.insert(volume::kGround);
    for (const Object& object : objects) {
        const std::string quoted = "'" + object.name + "'";
        require(isObjectName(object.name), "--name", quoted,
                "a name without commas, brackets and control characters");
        require(object.name != volume::kMedium, "--name", quoted,
                "another name: that is what surrounds all objects");
        require(names.insert(object.name).second, "--name", quoted + " for two objects",
                "a name for each, which its grids have");
    }
}

} // namespace

bool isObjectName(const std::string& name) {
    return !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
               std::string_view(",[]").find(c) != std::string_view::npos;
    });
}

int mostSharpObjects() {
    return kMostObjects;
}

void requireSharpCount(size_t objects) {
    const auto most = static_cast<size_t>(mostSharpObjects());
    if (objects > most)
        throw UsageError("MESH: found " + std::to_string(objects) + " objects, expected at most " +
                         std::to_string(most) +
                         " with sharp boundaries (--boundary blurred takes any number)");
}

void refuseCount(const std::string& option, size_t given, const Place& place) {
    std::string wanted = "once";
    if (place.files > 1)
        wanted += " or once for each of the " + std::to_string(place.files) + " meshes";
    if (place.objects > place.files)
        wanted += " or once for each of the " + std::to_string(place.objects) + " objects in " +
                  (place.files > 1 ? "them" : "it");
    else if (place.files == 1)
        wanted += ", as there is one mesh";
    throw UsageError(option + ": given " + std::to_string(given) + " times, expected " + wanted);
}

void Params::checkGround() const {
    if (!ground) {
        if (groundMargin)
            throw UsageError("--ground-margin: given without --ground, expected both");
        return;
    }
    const std::string fault = volume::faultOf(*ground);
    require(fault.empty(), "--ground", fault, "Y[:R,G,B[:checker SIZE]]");
    if (!sharp)
        throw UsageError("--ground: given with --boundary blurred, expected sharp boundaries");
    if (!groundMargin) return;
    require(*groundMargin >= 0 && *groundMargin <= volume::kFarthestGround, "--ground-margin",
            toText(*groundMargin), "0 to 1e12 units");
    if (bounds)
        throw UsageError("--ground-margin: given with --bounds, which is the domain; expected one "
                         "of the two");
}

void Params::check() const {
    if (objects.empty()) throw UsageError("MESH: none given, expected at least one");
    for (const Object& object : objects)
        checkMaterial(object.material,
                      {"--", objects.size() > 1 ? " for '" + object.name + "'" : ""});
    checkMaterial(medium, {"--medium-", ""});
    require(supersample == 1 || supersample == 2 || supersample == 4 || supersample == 8,
            "--supersample", std::to_string(supersample), "1, 2, 4 or 8");
    if (padding)
        require(*padding >= 0 && *padding < kLongestEdge / 2, "--padding", std::to_string(*padding),
                "0 to " + std::to_string(kLongestEdge / 2 - 1));
    require(resolution >= 1 && resolution <= kLongestEdge, "--resolution",
            std::to_string(resolution), "1 to " + std::to_string(kLongestEdge));
    if (voxelSize)
        require(*voxelSize >= kSmallestVoxel && *voxelSize <= kLargestVoxel, "--voxel-size",
                toText(*voxelSize), toText(kSmallestVoxel) + " to " + toText(kLargestVoxel));
    else if (padding && !bounds)
        require(resolution > 2 * *padding, "--resolution", std::to_string(resolution),
                "more than twice the --padding of " + std::to_string(*padding));
    if (bounds)
        checkBounds(*bounds);
    else if (std::any_of(objects.begin(), objects.end(),
                         [](const Object& o) { return o.fillBelow; }))
        throw UsageError("--fill-below: given without --bounds, expected the domain that closes "
                         "what it fills");
    // A cubic spline of distances looks two voxels far, from places up to two off the boundary.
    require(sdfBand >= 4 && sdfBand <= 100, "--sdf-band", toText(sdfBand), "4 to 100");
    // From 90° on a box would be a ball.
    require(smooth >= 0 && smooth < 90, "--smooth", toText(smooth), "0 or more, and less than 90");
    checkGround();
    if (!sharp) return;
    requireSharpCount(objects.size() + (ground ? 1 : 0));
    checkNames(objects, ground.has_value());
}

} // namespace eikonal::voxelize
