// Solids of glass with sharp boundaries, and the rays that Snell and Fresnel make of one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace judge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr size_t kMostSolids = 64;

Chord ballChord(const Solid& ball, const dvec3& x, const dvec3& d) {
    const dvec3 r = x - ball.centre;
    const double along = glm::dot(r, d);
    const dvec3 across = r - along * d;
    const double under = ball.radius * ball.radius - glm::dot(across, across);
    if (!(under > 0)) return {1, 0, {}, {}};
    const double half = std::sqrt(under);
    return {-along - half, -along + half, (across - half * d) / ball.radius,
            (across + half * d) / ball.radius};
}

Chord hullChord(const Solid& hull, const dvec3& x, const dvec3& d) {
    Chord chord{-kInfinity, kInfinity, {}, {}};
    for (const Plane& plane : hull.planes) {
        const double depth = plane.offset - glm::dot(plane.normal, x);
        const double rate = glm::dot(plane.normal, d);
        if (rate == 0) {
            if (depth < 0) return {1, 0, {}, {}};
        } else if (rate < 0) {
            if (depth / rate > chord.enter)
                chord.enter = depth / rate, chord.enterNormal = plane.normal;
        } else if (depth / rate < chord.leave)
            chord.leave = depth / rate, chord.leaveNormal = plane.normal;
    }
    return chord;
}

/// What a line meets, solid by solid.
class Line {
public:
    Line(const Glass& glass, const dvec3& x, const dvec3& d) : mGlass(glass) {
        if (glass.solids.size() > kMostSolids) throw std::invalid_argument("too many solids");
        for (size_t i = 0; i < glass.solids.size(); ++i)
            mChords[i] = chordOf(glass.solids[i], x, d);
    }

    /// The solid just past t, as if `without` were not there.
    int past(double t, int without = kAround) const {
        int found = kAround;
        for (size_t i = 0; i < mGlass.solids.size(); ++i) {
            const Chord& chord = mChords[i];
            if (static_cast<int>(i) == without) continue;
            if (chord.enter > t + kTouching || chord.leave <= t + kTouching) continue;
            if (found == kAround || mGlass.solids[i].priority >= mGlass.solids[found].priority)
                found = static_cast<int>(i);
        }
        return found;
    }

    struct End {
        double t;
        int to;
        dvec3 normal;
    };
    /// Where the line, in `from` to begin with, comes into another solid. Of several boundaries in
    /// one place the one that counts is that of the solid left or entered.
    std::optional<End> next(int from) const {
        std::optional<End> nearest;
        const auto consider = [&](double t, size_t solid, const dvec3& normal) {
            if (!(t > kTouching) || t == kInfinity || (nearest && t >= nearest->t)) return;
            const int to = past(t);
            if (to == from) return;
            const int here = static_cast<int>(solid);
            if (here == from || here == to) nearest = End{t, to, normal};
        };
        for (size_t i = 0; i < mGlass.solids.size(); ++i) {
            if (mChords[i].enter > mChords[i].leave) continue;
            consider(mChords[i].enter, i, mChords[i].enterNormal);
            consider(mChords[i].leave, i, mChords[i].leaveNormal);
        }
        return nearest;
    }

private:
    const Glass& mGlass;
    std::array<Chord, kMostSolids> mChords;
};

Met metAt(const Glass& glass, const dvec3& x, const dvec3& outward, const dvec3& d, int from,
          int to) {
    const double cosine = glm::dot(outward, d);
    const dvec3 normal = cosine > 0 ? -outward : outward;
    const double ratio = indexAt(glass, to, x) / indexAt(glass, from, x);
    return {
        x, normal, from, to, ratio, std::abs(cosine), reflectance(ratio, std::abs(cosine)).mean()};
}

/// Through a graded ball, which nothing else is in.
Piece gradedPiece(const Glass& glass, const Ray& ray, int from) {
    const Solid& ball = glass.solids[from];
    const Part part{[&](dvec3 x) { return glm::length(x - ball.centre) - ball.radius; },
                    ball.graded->index, ball.graded->force};
    const Medium medium{
        .name = "graded ball", .index = part.index, .force = part.force, .parts = {part}};
    // A box well around it, so that rays end on the ball.
    const dvec3 reach(1.5 * ball.radius);
    const Exit exit = trace(medium, ray, ball.centre - reach, ball.centre + reach);
    if (!exit.left) throw std::runtime_error("a ray is trapped in a graded ball");
    const int to = Line(glass, exit.x, exit.direction).past(0, from);
    const dvec3 outward = glm::normalize(exit.x - ball.centre);
    return {true, metAt(glass, exit.x, outward, exit.direction, from, to), exit.direction,
            exit.pathLength, exit.opticalLength};
}

/// Collects a tree.
struct Collector {
    Tree tree;
    double least;
    void onPiece(const dvec3&, const dvec3& to, double) { tree.met.push_back(to); }
    void onLeft(const Ray& ray, double weight, const std::string& course) {
        tree.left.push_back({ray, weight, course});
    }
    void onDeep(const Ray& ray, double weight, const std::string& course) {
        tree.deep.push_back({ray, weight, course});
        tree.tooDeep += weight;
    }
    void onDropped(double weight) { tree.tooFaint += weight; }
    void onWeight(double weight) {
        if (least > 0) tree.closestCall = std::min(tree.closestCall, std::abs(weight / least - 1));
    }
};

} // namespace

Solid glassBall(dvec3 centre, double radius, double index, int priority) {
    return {.centre = centre, .radius = radius, .planes = {}, .index = index, .priority = priority};
}

Solid glassBox(dvec3 low, dvec3 high, double index, int priority) {
    std::vector<Plane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 out(0);
        out[axis] = 1;
        planes.push_back({out, high[axis]});
        planes.push_back({-out, -low[axis]});
    }
    return glassHull(std::move(planes), index, priority);
}

Solid glassHull(std::vector<Plane> planes, double index, int priority) {
    return {.planes = std::move(planes), .index = index, .priority = priority};
}

Solid luneburgBall(dvec3 centre, double radius, double rim) {
    const double square = rim * rim / (radius * radius);
    const auto off = [=](dvec3 x) { return glm::dot(x - centre, x - centre); };
    Solid ball = glassBall(centre, radius, rim);
    ball.graded = Part{{},
                       [=](dvec3 x) { return std::sqrt(2 * rim * rim - square * off(x)); },
                       [=](dvec3 x) { return square * (centre - x); }};
    return ball;
}

Solid gradedBall(dvec3 centre, double radius, Profile n, Profile slope) {
    const Medium medium = radial("graded ball", centre, n, slope);
    Solid ball = glassBall(centre, radius, n(radius));
    ball.graded = Part{{}, medium.index, medium.force};
    return ball;
}

Chord chordOf(const Solid& solid, const dvec3& x, const dvec3& d) {
    return solid.planes.empty() ? ballChord(solid, x, d) : hullChord(solid, x, d);
}

int solidAt(const Glass& glass, const Ray& ray) {
    return Line(glass, ray.x, glm::normalize(ray.direction)).past(0);
}

double indexAt(const Glass& glass, int solid, const dvec3& x) {
    if (solid == kAround) return glass.around;
    const Solid& of = glass.solids[solid];
    return of.graded ? of.graded->index(x) : of.index;
}

Piece pieceOf(const Glass& glass, const Ray& ray, int from) {
    if (from != kAround && glass.solids[from].graded) return gradedPiece(glass, ray, from);
    const dvec3& d = ray.direction;
    const auto end = Line(glass, ray.x, d).next(from);
    if (!end) return {};
    const double n = indexAt(glass, from, ray.x);
    return {true, metAt(glass, ray.x + end->t * d, end->normal, d, from, end->to), d, end->t,
            n * end->t};
}

dvec3 refracted(const dvec3& direction, const Met& met) {
    const double sine2 = (1 - met.cosIncidence * met.cosIncidence) / (met.ratio * met.ratio);
    const double cosBeyond = std::sqrt(std::max(0.0, 1 - sine2));
    return glm::normalize(direction / met.ratio +
                          (met.cosIncidence / met.ratio - cosBeyond) * met.normal);
}

dvec3 reflected(const dvec3& direction, const Met& met) {
    return glm::normalize(direction + 2 * met.cosIncidence * met.normal);
}

Path followTransmitted(const Glass& glass, const Ray& ray, int mostMet) {
    Path path{{ray.x, glm::normalize(ray.direction)}, false, 0, 0, {}};
    int in = solidAt(glass, ray);
    while (static_cast<int>(path.met.size()) <= mostMet) {
        const Piece piece = pieceOf(glass, path.ray, in);
        if (!piece.meets) {
            path.left = true;
            break;
        }
        const bool total = piece.met.reflected == 1;
        path.pathLength += piece.pathLength;
        path.opticalLength += piece.opticalLength;
        path.ray = {piece.met.x, total ? reflected(piece.direction, piece.met)
                                       : refracted(piece.direction, piece.met)};
        if (!total) in = piece.met.to;
        path.met.push_back(piece.met);
    }
    return path;
}

Exit exitOf(const Glass& glass, const Ray& ray, dvec3 low, dvec3 high) {
    const Solid box = glassBox(low, high, 1);
    const dvec3 d = glm::normalize(ray.direction);
    const Chord in = chordOf(box, ray.x, d);
    if (in.enter > in.leave || in.leave < 0) return {ray.x, d, 0, 0, 0, true};
    const Path path = followTransmitted(glass, ray);
    const Chord out = chordOf(box, path.ray.x, path.ray.direction);
    const double before = std::max(0.0, in.enter);
    const double straight = out.leave - before;
    return {path.ray.x + out.leave * path.ray.direction,
            path.ray.direction,
            path.opticalLength + glass.around * straight,
            path.pathLength + straight,
            0,
            path.left};
}

double Tree::sum() const {
    double all = 0;
    for (const Branch& branch : left) all += branch.weight;
    return all;
}

Tree followAll(const Glass& glass, const Ray& ray, const Limits& limits) {
    Collector collector{{}, limits.minThroughput};
    std::string course;
    followTree(glass, {ray.x, glm::normalize(ray.direction)}, solidAt(glass, ray), 1, 0, course,
               limits, collector);
    return collector.tree;
}

double radiance(const Glass& glass, const Ray& ray, const std::function<double(dvec3)>& environment,
                const Limits& limits) {
    double sum = 0;
    const Tree tree = followAll(glass, ray, limits);
    for (const auto* branches : {&tree.left, &tree.deep})
        for (const Branch& branch : *branches)
            sum += branch.weight * environment(branch.ray.direction);
    const double ratio = indexAt(glass, solidAt(glass, ray), ray.x) / glass.around;
    return ratio * ratio * sum;
}

} // namespace judge
