// Photons through a ball by Snell's law, and the fluence of their tracks in a grid.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/snell.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace judge {

namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Span {
    double enter, leave;
};

/// Where the line from + t d is within the grid.
Span spanOf(const Grid& grid, const dvec3& from, const dvec3& d) {
    const dvec3 low = grid.low, high = grid.high();
    Span span{-kInfinity, kInfinity};
    for (int i = 0; i < 3; ++i) {
        if (d[i] == 0) {
            if (from[i] < low[i] || from[i] >= high[i]) return {1, 0};
            continue;
        }
        const double a = (low[i] - from[i]) / d[i], b = (high[i] - from[i]) / d[i];
        span.enter = std::max(span.enter, std::min(a, b));
        span.leave = std::min(span.leave, std::max(a, b));
    }
    return span;
}

class Photons {
public:
    Photons(const BallScene& scene, const Grid& grid, std::vector<double>& fluence, Energy& energy)
        : mScene(scene), mGrid(grid), mFluence(fluence), mEnergy(energy),
          mVolume(grid.voxel * grid.voxel * grid.voxel), mRatio(scene.index / scene.around) {}

    /// One photon along unit d; x is anywhere on its line before the ball.
    void send(const dvec3& x, const dvec3& d, double power) {
        const Span span = spanOf(mGrid, x, d);
        if (span.enter >= span.leave) return;
        mEnergy.entered += power;
        const dvec3 in = x + span.enter * d, out = x + span.leave * d;
        const dvec3 r = x - mScene.centre;
        const double along = glm::dot(r, d);
        const double under = mScene.radius * mScene.radius - glm::dot(r - along * d, r - along * d);
        if (under <= 0) {
            mEnergy.escaped += lay(in, out, mScene.extinctionAround, power);
            return;
        }
        const dvec3 hit = x - (along + std::sqrt(under)) * d;
        through(hit, d, lay(in, hit, mScene.extinctionAround, power));
    }

private:
    void through(const dvec3& hit, const dvec3& d, double power) {
        const dvec3 normal = (hit - mScene.centre) / mScene.radius;
        const double cosI = -glm::dot(normal, d);
        const double sinT = std::sqrt(std::max(0.0, 1 - cosI * cosI)) / mRatio;
        if (sinT >= 1) { // total reflection, of a bubble
            leave(hit, d + 2 * cosI * normal, power);
            return;
        }
        const double cosT = std::sqrt(1 - sinT * sinT);
        const dvec3 inside = d / mRatio + (cosI / mRatio - cosT) * normal;
        const Reflectance r = reflectance(mRatio, cosI);
        const double first = mScene.fresnel == Fresnel::None ? 1 : 1 - r.mean();
        mEnergy.reflected += power * (1 - first);
        // The chord meets the sphere at the same angle again, with the same reflectances.
        const dvec3 end = hit + 2 * mScene.radius * cosT * inside;
        power = lay(hit, end, mScene.extinction, power * first);
        const double both = mScene.fresnel == Fresnel::Polarised
                                ? 0.5 * ((1 - r.s) * (1 - r.s) + (1 - r.p) * (1 - r.p))
                                : first * first;
        const double second = first > 0 ? both / first : 0;
        mEnergy.reflected += power * (1 - second);
        const dvec3 up = (end - mScene.centre) / mScene.radius;
        leave(end, mRatio * inside + (cosI - mRatio * cosT) * up, power * second);
    }

    void leave(const dvec3& x, const dvec3& d, double power) {
        const Span span = spanOf(mGrid, x, d);
        mEnergy.escaped += lay(x, x + span.leave * d, mScene.extinctionAround, power);
    }

    /// Adds the segment's track to the grid; what is left of the power at its end.
    double lay(const dvec3& from, const dvec3& to, double extinction, double power) {
        walk(mGrid, from, to, [&](size_t cell, double length) {
            const double depth = extinction * length, lost = -std::expm1(-depth);
            mFluence[cell] += power / mVolume * (depth > 0 ? lost / depth : 1) * length;
            mEnergy.attenuated += power * lost;
            power -= power * lost;
        });
        return power;
    }

    const BallScene& mScene;
    const Grid& mGrid;
    std::vector<double>& mFluence;
    Energy& mEnergy;
    double mVolume, mRatio;
};

} // namespace

size_t Grid::cells() const {
    return static_cast<size_t>(size.x) * size.y * size.z;
}

size_t Grid::cell(ivec3 at) const {
    return at.x + static_cast<size_t>(size.x) * (at.y + static_cast<size_t>(size.y) * at.z);
}

dvec3 Grid::high() const {
    return low + voxel * dvec3(size);
}

dvec3 Grid::middle(ivec3 at) const {
    return low + voxel * (dvec3(at) + 0.5);
}

void walk(const Grid& grid, dvec3 from, dvec3 to,
          const std::function<void(size_t cell, double length)>& visit) {
    const double length = glm::length(to - from);
    if (length == 0) return;
    const dvec3 d = (to - from) / length;
    const Span span = spanOf(grid, from, d);
    double t = std::max(0.0, span.enter);
    const double end = std::min(length, span.leave);
    if (t >= end) return;
    // The walk of Amanatides and Woo, 1987. The next plane's t is worked out from the plane's
    // number, not summed up, so that a long walk gathers no rounding.
    const dvec3 x = (from + t * d - grid.low) / grid.voxel;
    ivec3 at = glm::clamp(ivec3(glm::floor(x)), ivec3(0), grid.size - 1);
    const auto planeAt = [&](int i) {
        if (d[i] == 0) return kInfinity;
        const double plane = grid.low[i] + grid.voxel * (at[i] + (d[i] > 0 ? 1 : 0));
        return (plane - from[i]) / d[i];
    };
    dvec3 next(planeAt(0), planeAt(1), planeAt(2));
    while (t < end) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        const double until = std::min(next[axis], end);
        if (until > t) visit(grid.cell(at), until - t), t = until;
        if (next[axis] >= end) break;
        at[axis] += d[axis] > 0 ? 1 : -1;
        if (at[axis] < 0 || at[axis] >= grid.size[axis]) break;
        next[axis] = planeAt(axis);
    }
}

std::vector<double> ballFluence(const BallScene& scene, const Grid& grid, Energy* energy) {
    for (int i = 0; i < 3; ++i)
        if (scene.centre[i] - scene.radius < grid.low[i] ||
            scene.centre[i] + scene.radius > grid.high()[i])
            throw std::invalid_argument("the ball must lie within the grid");
    const dvec3 d = glm::normalize(scene.direction);
    // The axis least along the light, to span the plane across it with.
    const dvec3 a = glm::abs(d);
    const dvec3 least = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0)
                        : a.y <= a.z             ? dvec3(0, 1, 0)
                                                 : dvec3(0, 0, 1);
    const dvec3 u = glm::normalize(glm::cross(d, least)), v = glm::cross(d, u);
    // Far enough to be before the grid and the ball, and a disc that covers the grid's corners.
    double reach = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 high = grid.high();
        const dvec3 at(corner & 1 ? high.x : grid.low.x, corner & 2 ? high.y : grid.low.y,
                       corner & 4 ? high.z : grid.low.z);
        reach = std::max(reach, glm::length(at - scene.centre));
    }
    std::vector<double> fluence(grid.cells(), 0);
    Energy book;
    Photons photons(scene, grid, fluence, book);
    const double power = scene.irradiance * pi * scene.radius * scene.radius / scene.photons;
    const double all = scene.photons * (reach / scene.radius) * (reach / scene.radius);
    // Vogel's sunflower: the golden angle from seed to seed, equal areas from the middle out.
    const double golden = pi * (3 - std::sqrt(5.0));
    for (double i = 0.5; i < all; ++i) {
        const double r = scene.radius * std::sqrt(i / scene.photons);
        const double angle = std::fmod(golden * i, 2 * pi);
        photons.send(scene.centre + r * (std::cos(angle) * u + std::sin(angle) * v) - 2 * reach * d,
                     d, power);
    }
    if (energy) *energy = book;
    return fluence;
}

} // namespace judge
