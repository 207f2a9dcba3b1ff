// How far a faint plume turns rays, against the integral of its gradient along them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

using namespace eikonal;
using glm::dvec3;

namespace {

constexpr double kWidth = 10; // standard deviation of the plume [voxel]
constexpr int kSize = 80, kHeight = 16;
const dvec3 kCentre(0.5 * kSize, 0.5 * kHeight, 0.5 * kSize);

double gaussian(const dvec3& p) {
    const double x = p.x - kCentre.x, z = p.z - kCentre.z;
    return std::exp(-(x * x + z * z) / (2 * kWidth * kWidth));
}

/// A Gaussian plume along y, by Gladstone and Dale's law of a density that is 1 in its middle.
volume::Volume plume(double contrast, bool inDouble) {
    TestVolume grids({kSize, kHeight, kSize});
    grids.add("density", gaussian);
    volume::Volume volume = grids.take();
    volume::Law law;
    law.value = [=](double density, int) { return 1.000277 + contrast * density; };
    law.inDouble = inDouble;
    volume.derive("density", "ior", law);
    return volume;
}

/// ∫ ∇n ds across the domain, by Simpson's rule: to first order the change of a ray's direction.
dvec3 turnOf(double contrast, const dvec3& start, const dvec3& along) {
    double enter = -1e9, leave = 1e9;
    const dvec3 high(kSize, kHeight, kSize);
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0) continue;
        const double a = -start[axis] / along[axis], b = (high[axis] - start[axis]) / along[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    dvec3 sum(0);
    const int parts = 2000;
    for (int i = 0; i <= parts && leave > enter; ++i) {
        const dvec3 p = start + along * (enter + (leave - enter) * i / parts);
        const dvec3 gradient =
            dvec3(-(p.x - kCentre.x), 0, -(p.z - kCentre.z)) / (kWidth * kWidth) * gaussian(p);
        const double weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
        sum += gradient * (weight * (leave - enter) / (3.0 * parts));
    }
    const dvec3 turn = contrast * sum;
    return turn - glm::dot(turn, along) * along;
}

/// The error's rms over that of the turn, of a row of parallel rays.
double errorOf(double contrast, bool inDouble, const dvec3& along, view::Params params = {}) {
    const int rays = 31;
    const double spacing = 1.73; // rays lie everywhere between voxels
    params.camera = view::parallel(kCentre - 100.0 * along, kCentre, spacing, {rays, 1}).camera;
    params.aovs = {"deflection"};
    const view::Look look(plume(contrast, inDouble), params);
    const dvec3 right = glm::normalize(glm::cross(along, dvec3(0, 1, 0)));
    const dvec3 up = glm::cross(right, along);
    double error = 0, all = 0;
    for (int i = 0; i < rays; ++i) {
        const double off = (i - 0.5 * (rays - 1)) * spacing;
        const dvec3 wanted = turnOf(contrast, kCentre + off * right - 100.0 * along, along);
        const double missed = std::hypot(look.at("deflection.X", i) - glm::dot(wanted, right),
                                         look.at("deflection.Y", i) - glm::dot(wanted, up));
        error += missed * missed;
        all += glm::dot(wanted, wanted);
    }
    const double share = std::sqrt(error / all);
    std::printf("contrast %g, %s, along (%.2f, %.2f, %.2f), %s: %.3g %%\n", contrast,
                inDouble ? "double" : "float", along.x, along.y, along.z,
                params.sampling() == optics::Interpolation::cubic ? "cubic" : "linear",
                100 * share);
    return share;
}

} // namespace

// Of rays along an axis, whose components across it are small floats with all their digits, and
// oblique ones, of which a direction in floats alone is off by 0.6 % of a turn at 2e-6.
const dvec3 kAlong[] = {{0, 0, 1}, glm::normalize(dvec3(1, 0.1, 2))};

TEST(Plume, TurnsRaysToOnePercentAtAContrastOfTwoMillionths) {
    for (const dvec3& along : kAlong) {
        EXPECT_LT(errorOf(2e-6, true, along), 0.01);
        view::Params cubic;
        cubic.interpolation = optics::Interpolation::cubic;
        EXPECT_LT(errorOf(2e-6, true, along, cubic), 0.01);
    }
}

TEST(Plume, TurnsRaysToAThousandthAtTwoTenThousandths) {
    for (const dvec3& along : kAlong) {
        EXPECT_LT(errorOf(2e-4, true, along), 0.001);
        view::Params cubic;
        cubic.interpolation = optics::Interpolation::cubic;
        EXPECT_LT(errorOf(2e-4, true, along, cubic), 0.001);
    }
}

TEST(Plume, IsNotToBeHadFromAnIndexInFloats) {
    for (const dvec3& along : kAlong) EXPECT_GT(errorOf(2e-6, false, along), 0.03);
}

TEST(Plume, KeepsItsContrastWhereWavelengthsDiffer) {
    // A dispersion of one value changes no gradient; sums with it are taken in double, too.
    volume::Volume volume = plume(2e-6, true);
    volume::Law law;
    law.value = [](double, int) { return 1.6e-6; }; // air's [µm²]
    volume.derive("density", "dispersion", law);
    const scene::Scene scene = scene::read(scene::Files(volume), {});
    ASSERT_FALSE(scene.index.dispersedRest.page.empty());
    const auto sum = [](const volume::BrickGrid& grid, const volume::BrickGrid& rest,
                        glm::ivec3 p) { return at(grid, p) + at(rest, p); };
    const scene::Index& index = scene.index;
    for (int x = 0; x < kSize; ++x) {
        const glm::ivec3 p(x, 3, kSize / 2), first(0);
        const double wanted = sum(index.grid, index.rest, p) - sum(index.grid, index.rest, first);
        EXPECT_NEAR(sum(index.dispersed, index.dispersedRest, p) -
                        sum(index.dispersed, index.dispersedRest, first),
                    wanted, 1e-13);
    }
}
