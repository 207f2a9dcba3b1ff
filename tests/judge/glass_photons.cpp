// Parallel light through solids of glass, split at every boundary, and the fluence of its tracks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/boundary.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace judge {

namespace {

using std::numbers::pi;

/// A box that grows.
struct Bounds {
    dvec3 low{1e300}, high{-1e300};
    void include(const dvec3& x) { low = glm::min(low, x), high = glm::max(high, x); }
};

/// Adds a hull's corners: where three of its planes meet and no other cuts them off.
void includeHull(Bounds& bounds, const std::vector<Plane>& planes) {
    for (size_t a = 0; a < planes.size(); ++a)
        for (size_t b = 0; b < a; ++b)
            for (size_t c = 0; c < b; ++c) {
                const glm::dmat3 normals(planes[a].normal, planes[b].normal, planes[c].normal);
                if (std::abs(glm::determinant(normals)) < 1e-12) continue; // parallel to a line
                const dvec3 x = glm::inverse(glm::transpose(normals)) *
                                dvec3(planes[a].offset, planes[b].offset, planes[c].offset);
                bool within = true;
                for (const Plane& plane : planes)
                    within = within && glm::dot(plane.normal, x) <= plane.offset + kTouching;
                if (within) bounds.include(x);
            }
}

Bounds boundsOf(const Glass& glass, const Grid& grid) {
    Bounds bounds;
    bounds.include(grid.low);
    bounds.include(grid.high());
    for (const Solid& solid : glass.solids) {
        if (solid.graded) throw std::invalid_argument("photons take no graded glass");
        if (!solid.planes.empty()) {
            includeHull(bounds, solid.planes);
            continue;
        }
        bounds.include(solid.centre - solid.radius);
        bounds.include(solid.centre + solid.radius);
    }
    return bounds;
}

/// Sends one share of the photons; has its own sums.
class Sender {
public:
    Sender(const Glass& glass, const Beam& beam, const Grid& grid, const Bounds& bounds)
        : mGlass(glass), mBeam(beam), mGrid(grid), mMiddle(0.5 * (bounds.low + bounds.high)),
          mReach(0.5 * glm::length(bounds.high - bounds.low)),
          mVolume(grid.voxel * grid.voxel * grid.voxel), mFluence(grid.cells(), 0) {}

    /// Photons first, first + every, ... of Vogel's sunflower: equal areas from the middle out.
    void send(int first, int every) {
        const dvec3 d = glm::normalize(mBeam.direction), a = glm::abs(d);
        const dvec3 least = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0)
                            : a.y <= a.z             ? dvec3(0, 1, 0)
                                                     : dvec3(0, 0, 1);
        const dvec3 u = glm::normalize(glm::cross(d, least)), v = glm::cross(d, u);
        const double power = mBeam.irradiance * pi * mReach * mReach / mBeam.photons;
        const double golden = pi * (3 - std::sqrt(5.0));
        std::string course;
        for (double i = first + 0.5; i < mBeam.photons; i += every) {
            const double r = mReach * std::sqrt(i / mBeam.photons);
            const double angle = std::fmod(golden * i, 2 * pi);
            const dvec3 x =
                mMiddle + r * (std::cos(angle) * u + std::sin(angle) * v) - 2 * mReach * d;
            mMetGlass = false;
            followTree(mGlass, {x, d}, kAround, power, 0, course, limitsAt(power), *this);
            if (mMetGlass) mBook.met += power;
        }
    }

    void onPiece(const dvec3& from, const dvec3& to, double weight) {
        mMetGlass = true;
        lay(from, to, weight);
    }
    void onLeft(const Ray& ray, double weight, const std::string&) {
        if (mMetGlass) mBook.left += weight;
        lay(ray.x, ray.x + 4 * mReach * ray.direction, weight); // 4: from before the disc to behind
    }
    void onDeep(const Ray&, double weight, const std::string&) { mBook.dropped += weight; }
    void onDropped(double weight) { mBook.dropped += weight; }
    void onWeight(double) {}

    const std::vector<double>& fluence() const { return mFluence; }
    const BeamBook& book() const { return mBook; }

private:
    Limits limitsAt(double power) const {
        return {mBeam.limits.maxDepth, mBeam.limits.minThroughput * power};
    }

    void lay(const dvec3& from, const dvec3& to, double power) {
        walk(mGrid, from, to,
             [&](size_t cell, double length) { mFluence[cell] += power / mVolume * length; });
    }

    const Glass& mGlass;
    const Beam& mBeam;
    const Grid& mGrid;
    dvec3 mMiddle;
    double mReach, mVolume;
    bool mMetGlass = false;
    std::vector<double> mFluence;
    BeamBook mBook;
};

} // namespace

std::vector<double> beamFluence(const Glass& glass, const Beam& beam, const Grid& grid,
                                BeamBook* book) {
    const Bounds bounds = boundsOf(glass, grid);
    // Always as many shares, so that the sums are the same on any machine.
    constexpr int kShares = 4;
    std::vector<Sender> senders(kShares, Sender(glass, beam, grid, bounds));
    std::vector<std::thread> threads;
    for (int i = 0; i < kShares; ++i)
        threads.emplace_back([&, i] { senders[static_cast<size_t>(i)].send(i, kShares); });
    for (std::thread& thread : threads) thread.join();
    std::vector<double> fluence(grid.cells(), 0);
    BeamBook all;
    for (const Sender& sender : senders) {
        for (size_t c = 0; c < fluence.size(); ++c) fluence[c] += sender.fluence()[c];
        all.met += sender.book().met;
        all.left += sender.book().left;
        all.dropped += sender.book().dropped;
    }
    if (book) *book = all;
    return fluence;
}

} // namespace judge
