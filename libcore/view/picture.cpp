// A picture in the making: colours, rays' paths and counters, strip by strip.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/picture.h"

#include "camera/aovs.h"
#include "camera/pattern.h"
#include "view/camera_ray.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;

/// Voxel space to the world, and the camera's own axes and rays.
struct Places {
    glm::dmat4 worldFromVoxel;
    glm::dmat3 turn;
    double voxelSize;
    dvec3 eye, forward;
    camera::CameraAxes axes; ///< in voxel space
    ViewParams rays{};
    glm::vec2 place; ///< where in its pixel a ray goes whose path is written
    int width;

    Places(const Plan& plan, const Params& params)
        : worldFromVoxel(glm::inverse(plan.scene.voxelFromWorld())),
          turn(plan.scene.worldFromVoxelTurn()), voxelSize(plan.scene.voxelSize()),
          eye(params.camera.eye), forward(axesOf(params.camera).forward),
          place(camera::samplePattern(params.samples).front()), width(params.camera.width) {
        const camera::CameraAxes world = axesOf(params.camera);
        const glm::dmat3 voxelFromWorld = glm::transpose(turn);
        axes = {voxelFromWorld * world.forward, voxelFromWorld * world.right,
                voxelFromWorld * world.up};
        setCamera(rays, params.camera, plan.scene);
    }

    /// The direction that a pixel's ray began along, in voxel space.
    dvec3 beganAt(size_t pixel) const {
        const auto at = static_cast<int>(pixel);
        return cameraDirection(rays, {at % width, at / width}, place);
    }

    dvec3 placeOf(const PixelPath& path) const {
        return dvec3(worldFromVoxel * glm::dvec4(dvec3(path.place), 1.0));
    }
};

bool isOnSurface(const PixelPath& path) {
    return static_cast<int>(path.error.y) % 2 == 1;
}

/// Which domain it ended in.
size_t domainOf(const PixelPath& path) {
    return static_cast<size_t>(path.error.y) / 2;
}

bool anySharp(const std::vector<Plan>& plans) {
    return std::any_of(plans.begin(), plans.end(), [](const Plan& p) { return p.scene.sharp; });
}

bool anyWantsPaths(const std::vector<Plan>& plans, const Params& params) {
    return std::any_of(plans.begin(), plans.end(),
                       [&](const Plan& plan) { return wantsPaths(plan, params); });
}

/// The normal where it ended, as shaders/lib/octahedral.glsl packs it.
dvec3 outwardOf(const PixelPath& path) {
    const glm::dvec2 p(path.error.z, path.error.w);
    const double z = 1 - std::abs(p.x) - std::abs(p.y);
    if (z >= 0) return {p, z};
    return {(1 - std::abs(p.y)) * (p.x < 0 ? -1 : 1), (1 - std::abs(p.x)) * (p.y < 0 ? -1 : 1), z};
}

/// A picture that goes beside the colour: its channels, and a pixel's values.
struct Aov {
    const char* name;
    const char* components; ///< "" for Z alone, whose name every reader knows
    dvec3 (*valueOf)(const PixelPath&, const Places&, size_t pixel);
};

constexpr Aov kAovTable[] = {
    {"exit_position", "XYZ",
     [](const PixelPath& path, const Places& places, size_t) { return places.placeOf(path); }},
    {"exit_direction", "XYZ",
     [](const PixelPath& path, const Places& places, size_t) {
         return glm::normalize(places.turn * dvec3(path.direction));
     }},
    {"deflection", "XY",
     [](const PixelPath& path, const Places& places, size_t pixel) {
         return dvec3(
             camera::deflectionOf(places.axes, places.beganAt(pixel), dvec3(path.direction)), 0);
     }},
    {"transmittance", "RGB",
     [](const PixelPath& path, const Places&, size_t) { return dvec3(path.through); }},
    {"optical_path_length", "V",
     [](const PixelPath& path, const Places& places, size_t) {
         return dvec3(static_cast<double>(path.place.w) * places.voxelSize);
     }},
    {"path_length", "V",
     [](const PixelPath& path, const Places& places, size_t) {
         return dvec3(static_cast<double>(path.direction.w) * places.voxelSize);
     }},
    {"steps", "V",
     [](const PixelPath& path, const Places&, size_t) { return dvec3(path.through.w); }},
    {"Z", "",
     [](const PixelPath& path, const Places& places, size_t) {
         return dvec3(glm::dot(places.placeOf(path) - places.eye, places.forward));
     }},
    {"position", "XYZ",
     [](const PixelPath& path, const Places& places, size_t) {
         return isOnSurface(path) ? places.placeOf(path) : dvec3(0);
     }},
    {"normal", "XYZ",
     [](const PixelPath& path, const Places& places, size_t) {
         return isOnSurface(path) ? glm::normalize(places.turn * outwardOf(path)) : dvec3(0);
     }},
    {"error", "V",
     [](const PixelPath& path, const Places&, size_t) { return dvec3(path.error.x); }},
};

/// For the rays that rest: some thousands, where few of a strip do.
constexpr std::int64_t kMostRestBytes = std::int64_t{32} << 20;

/// A pixel's ray at rest has every branch that waits: more than `struct Rest` of
/// shaders/view/rest.glsl takes, of which the kernel fits in as many as it can.
std::int64_t restBytes(const std::vector<Plan>& plans, const Params& params) {
    if (!anySharp(plans)) return 0;
    const std::int64_t one = 1024 + 96 * std::int64_t{branchesWaiting(params)};
    const std::int64_t strip =
        std::int64_t{params.camera.width} * rowsPerStrip(params, plans.size() > 1);
    return std::min(2 * strip * one, kMostRestBytes);
}

} // namespace

const std::vector<std::string>& allAovs() {
    static const std::vector<std::string> kNames = camera::namesOf(kAovTable);
    return kNames;
}

int branchesWaiting(const Params& params) {
    const auto depth = static_cast<unsigned>(std::clamp(params.maxDepth, 1, 32));
    return static_cast<int>(std::bit_ceil(depth));
}

int rowsPerStrip(const Params& params, bool several) {
    const std::int64_t rows = (std::int64_t{1} << (several ? 16 : 20)) / params.camera.width;
    return static_cast<int>(std::clamp<std::int64_t>(rows, 1, params.camera.rows));
}

bool wantsPaths(const Plan& plan, const Params& params) {
    return plan.paths || !params.aovs.empty() || (plan.dims && plan.colour);
}

std::vector<gpu::Need> pictureNeeds(const std::vector<Plan>& plans, const Params& params) {
    const std::int64_t strip =
        std::int64_t{params.camera.width} * rowsPerStrip(params, plans.size() > 1);
    std::vector<gpu::Need> needs{{"the picture", strip * 16, true, 0}};
    if (anyWantsPaths(plans, params))
        needs.push_back(
            {"the rays' paths", strip * static_cast<std::int64_t>(sizeof(PixelPath)), true, 0});
    if (anySharp(plans)) needs.push_back({"rays that rest", restBytes(plans, params), true, 0});
    return needs;
}

Picture::Picture(gpu::Device& device, const std::vector<Plan>& plans, const Params& params)
    : mCounters(device, kSlots * kCounters * 8), mWidth(params.camera.width) {
    const std::int64_t strip =
        std::int64_t{params.camera.width} * rowsPerStrip(params, plans.size() > 1);
    const auto path = static_cast<std::int64_t>(sizeof(PixelPath));
    const bool paths = anyWantsPaths(plans, params);
    mColours = gpu::Buffer(device, strip * 16);
    mPaths = gpu::Buffer(device, paths ? strip * path : path);
    mCounters.clear();
    if (anySharp(plans)) mRests = gpu::Buffer(device, restBytes(plans, params));
    const size_t pixels = static_cast<size_t>(params.camera.width) * params.camera.rows;
    mPixels.resize(pixels);
    if (paths) mPixelPaths.resize(pixels);
}

void Picture::bind() const {
    mColours.bindStorage(kColoursBuffer);
    mPaths.bindStorage(kPixelPathsBuffer);
    mCounters.bindStorage(kCountersBuffer);
    if (mRests.bytes() > 0) mRests.bindStorage(kRestsBuffer);
}

void Picture::clearRests() {
    const uint none = 0;
    if (mRests.bytes() > 0) mRests.upload(&none, sizeof none);
}

int Picture::resting() const {
    uint asked = 0;
    if (mRests.bytes() > 0) mRests.download(&asked, sizeof asked);
    return static_cast<int>(asked);
}

void Picture::readStrip(int row, int rows) {
    const size_t first = static_cast<size_t>(row) * mWidth;
    const std::int64_t pixels = std::int64_t{rows} * mWidth;
    mColours.download(mPixels.data() + first, pixels * 16);
    if (!mPixelPaths.empty())
        mPaths.download(mPixelPaths.data() + first,
                        pixels * static_cast<std::int64_t>(sizeof(PixelPath)));
}

void Picture::readCounters(const std::vector<Plan>& plans, const Params& params,
                           Stats& stats) const {
    std::array<std::uint64_t, kSlots * kCounters> slots{};
    mCounters.download(slots.data(), sizeof slots);
    const auto sum = [&](uint counter) {
        double all = 0;
        for (uint slot = 0; slot < kSlots; ++slot)
            all += static_cast<double>(slots[slot * kCounters + counter]);
        return all;
    };
    stats.count("rays", sum(kRays));
    stats.count("steps", sum(kSteps));
    stats.count("trapped", sum(kTrappedRays));
    if (anySharp(plans)) {
        const double shares = static_cast<double>(kShareUnit) * std::max(sum(kRays), 1.0);
        stats.count("boundaries_met", sum(kInterfaces));
        stats.count("light_dropped_by_depth", sum(kDroppedByDepth) / shares);
        stats.count("light_dropped_as_dim", sum(kDroppedAsDim) / shares);
    }
    const bool bends = std::any_of(plans.begin(), plans.end(),
                                   [](const Plan& p) { return p.scene.index.varies(); });
    if (bends && params.integrator == Integrator::adaptive) {
        float worst = 0;
        for (uint slot = 0; slot < kSlots; ++slot)
            worst = std::max(worst, std::bit_cast<float>(static_cast<std::uint32_t>(
                                        slots[slot * kCounters + kWorstError])));
        stats.raise("position_error_voxels", static_cast<double>(worst));
        stats.count("over_tolerance", sum(kOverTolerance));
    }
}

image::Image Picture::assemble(const std::vector<Plan>& plans, const Params& params) const {
    image::Image picture(params.camera.width, params.camera.rows);
    picture.addChannels({"R", "G", "B", "A"},
                        {reinterpret_cast<const float*>(mPixels.data()), mPixels.size() * 4}, 4);
    if (mPixelPaths.empty()) return picture;
    std::vector<Places> places;
    for (const Plan& plan : plans) places.emplace_back(plan, params);
    if (std::any_of(plans.begin(), plans.end(),
                    [](const Plan& plan) { return plan.dims && plan.colour; }))
        camera::addChannels(picture, {"AR", "AG", "AB"},
                            [&](size_t pixel) { return 1.0 - dvec3(mPixelPaths[pixel].through); });
    for (const std::string& name : params.aovs)
        for (const Aov& aov : kAovTable)
            if (name == aov.name)
                camera::addChannels(picture, camera::channelsOf(aov.name, aov.components),
                                    [&](size_t pixel) {
                                        const PixelPath& path = mPixelPaths[pixel];
                                        return aov.valueOf(path, places[domainOf(path)], pixel);
                                    });
    return picture;
}

} // namespace eikonal::view
