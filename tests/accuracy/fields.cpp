// The fields, and where their rays enter.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fields.h"

#include "support/test_volume.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace accuracy {

using namespace eikonal;

namespace {

using std::numbers::pi;

constexpr dvec3 kCentre(kBox / 2);
constexpr dvec3 kTilted(0.1, 0.05, 1); // along no axis, so that no ray keeps to one voxel's phase

Field plain(judge::Medium medium, const dvec3& through, double half,
            const dvec3& direction = kTilted) {
    const std::string name = medium.name;
    return {name, medium, medium.index, through, glm::normalize(direction), half, true};
}

constexpr double kRodIndex = 1.5, kRodPull = 2 * pi * 3 / kBox; // three pitches in the box

/// Its rays stay within 3.1 voxels of the axis. The parabola in n² would reach 0 at 6.8; beyond the
/// rays it levels off, and gently: wherever it is clipped a spline through the samples rings for
/// some voxels, as the next field shows.
Field rod() {
    Field field = plain(judge::grinRod(kRodIndex, kRodPull, kCentre), {64, 64, 0}, 2.1);
    field.index = [](dvec3 p) {
        const dvec3 r = kRodPull * (p - kCentre);
        const double square = r.x * r.x + r.y * r.y;
        const double from = std::pow(3.15 * kRodPull, 2), most = 0.9; // of 1 − n²/n0²
        const double over = std::max(0.0, (square - from) / (most - from));
        const double levelled = over / std::pow(1 + std::pow(over, 4), 0.25);
        return kRodIndex * std::sqrt(1 - std::min(square, from) - (most - from) * levelled);
    };
    return field;
}

/// The same, clipped where n² is 0.4, three voxels from the outermost ray.
Field clippedRod() {
    Field field = plain(judge::grinRod(kRodIndex, kRodPull, kCentre), {64, 64, 0}, 2.1);
    field.index = [medium = field.medium](dvec3 p) {
        return std::max(medium.index(p), std::sqrt(0.4));
    };
    return field;
}

Field named(const std::string& name, Field field, bool smooth = true) {
    field.name = name;
    field.medium.name = name;
    field.smooth = smooth;
    return field;
}

std::vector<Field> makeFields() {
    std::vector<Field> all;
    all.push_back(
        named("linear n²", plain(judge::linearSquared(1.2, dvec3(0.0015625)), {58, 60, 0}, 44)));
    all.push_back(named("GRIN rod", rod()));
    all.push_back(named("Luneburg core", plain(judge::luneburgCore(kCentre, 92), {60, 62, 0}, 40)));
    all.push_back(named("fish-eye", plain(judge::maxwellFishEye(kCentre, 45), {60, 62, 0}, 25)));
    // Rays that come down at 9° and turn between the heights 6 and 19.
    all.push_back(named("turning layers", plain(judge::layeredExponential(1, 0.6, -20, 25),
                                                {50, 20, 0}, 9, {0.1, -0.15, 1})));
    // Impact up to 0.7 of the radius, in the picture's corners.
    const double half = 0.7 * 40 / std::numbers::sqrt2;
    all.push_back(named("blob", plain(judge::blob(kCentre, 40, 2.5, 1.5), kCentre, half)));
    all.push_back(named("clipped rod", clippedRod(), false));
    all.push_back(
        named("Luneburg with rim", plain(judge::luneburg(kCentre, 56), kCentre, 36), false));
    all.push_back(
        named("blob, σ 1.5", plain(judge::blob(kCentre, 40, 1.5, 1.5), kCentre, half), false));
    const dvec3 normal = glm::normalize(dvec3(0.6, 0.3, 1)); // 27° from the rays
    all.push_back(named("blurred step, σ 1.5",
                        plain(judge::step(kCentre, normal, 1, 1.5, 1.5), kCentre, 30), false));
    return all;
}

} // namespace

const std::vector<Field>& fields() {
    static const std::vector<Field> all = makeFields();
    return all;
}

const Field& fieldNamed(const std::string& name) {
    for (const Field& field : fields())
        if (field.name == name) return field;
    throw std::logic_error("no field " + name);
}

view::Camera cameraOf(const Field& field, int pixels) {
    view::Camera camera;
    camera.eye = field.through - 2 * kBox * field.direction;
    camera.target = field.through;
    camera.parallel = true;
    camera.height = 2 * field.half;
    camera.width = camera.rows = pixels;
    return camera;
}

std::vector<judge::Ray> raysOf(const view::Camera& camera) {
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    std::vector<judge::Ray> rays;
    for (int row = 0; row < camera.rows; ++row)
        for (int column = 0; column < camera.width; ++column) {
            const double pixel = camera.height / camera.rows;
            const double s = (column + 0.5 - 0.5 * camera.width) * pixel;
            const double t = (0.5 * camera.rows - row - 0.5) * pixel;
            rays.push_back({camera.eye + s * right + t * up, forward});
        }
    return rays;
}

scene::Files sceneOf(const std::function<double(dvec3)>& index, const glm::ivec3& size,
                    double voxelSize) {
    TestVolume volume(size, voxelSize);
    volume.index(index);
    std::vector<volume::Volume> volumes;
    volumes.push_back(volume.take());
    return scene::Files(std::move(volumes));
}

} // namespace accuracy
