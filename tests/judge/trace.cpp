// Traces rays through closed-form media to rounding, as the reference that steps are judged by.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/trace.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>

namespace judge {

namespace {

namespace odeint = boost::numeric::odeint;

// Position, w, optical length, path length. Lengths are in units of half the box's longest edge and
// positions are from its centre, so that one tolerance fits boxes of any size anywhere.
using State = std::array<double, 8>;
using Stepper = odeint::runge_kutta_fehlberg78<State>;
using OfState = std::function<double(const State&)>;

// A start this near a surface is on it: some thousand roundings of a box's coordinates.
constexpr double kTouch = 1e-12;

dvec3 positionOf(const State& s) {
    return {s[0], s[1], s[2]};
}
dvec3 momentumOf(const State& s) {
    return {s[3], s[4], s[5]};
}

struct Frame {
    dvec3 centre;
    double length; // [voxel] in one unit
    dvec3 voxelFromUnit(const dvec3& x) const { return centre + length * x; }
};

/// The ray equation within one part.
struct Flow {
    const Part* part;
    const Frame* frame;
    void operator()(const State& s, State& rate, double) const {
        const dvec3 x = frame->voxelFromUnit(positionOf(s));
        const dvec3 force = frame->length * part->force(x);
        const double n = part->index(x);
        rate = {s[3], s[4], s[5], force.x, force.y, force.z, n * n, n};
    }
};

/// Something to stop at: `ahead` is negative before it and changes no faster than the path is long.
struct Event {
    enum class Kind { Face, Length, Edge } kind;
    int which; // face: axis, plus 3 for the high side; edge: the part's number
    OfState ahead;
};

/// Where in [0, 1] `ahead` first exceeds 0, given its ends and the length of path between them.
/// Looks for a visit to the far side between two ends on the near one, too.
std::optional<double> crossing(const std::function<double(double)>& ahead, double atStart,
                               double atEnd, double length) {
    const auto rootBetween = [&](double from, double to) {
        std::uintmax_t most = 200;
        // 52 bits: down to neighbouring doubles. The upper one, so that the crossing is behind.
        return boost::math::tools::toms748_solve(
                   ahead, from, to, boost::math::tools::eps_tolerance<double>(52), most)
            .second;
    };
    // 26 bits: half of a double's, all that the place of an extremum can have.
    if (atEnd > 0) {
        if (atStart < 0) return rootBetween(0, 1);
        const auto [u, least] = boost::math::tools::brent_find_minima(ahead, 0.0, 1.0, 26);
        return least < 0 ? rootBetween(u, 1) : 0;
    }
    if (atStart + atEnd + length < 0) return {}; // too short to reach 0 and return
    const auto behind = [&](double u) { return -ahead(u); };
    const auto [u, least] = boost::math::tools::brent_find_minima(behind, 0.0, 1.0, 26);
    if (-least <= (atStart > -kTouch ? kTouch : 0)) return {};
    return atStart < 0 ? rootBetween(0, u) : 0;
}

class Tracer {
public:
    Tracer(const Medium& medium, dvec3 low, dvec3 high, double tolerance, double mostLength)
        : mFrame{0.5 * (low + high), 0}, mParts(medium.parts) {
        // Below some forty roundings no step would ever be good enough.
        mTolerance = std::max(tolerance, 1e-14);
        const dvec3 size = high - low;
        mFrame.length = 0.5 * std::max({size.x, size.y, size.z});
        mHalf = 0.5 * size / mFrame.length;
        if (mParts.empty()) mParts.push_back({{}, medium.index, medium.force});
        // A quarter: a box is crossed in eight steps or more, so that a step bends little and meets
        // a surface once or twice.
        mLongest = std::min(0.25, medium.longestStep / mFrame.length);
        mMost = mostLength / mFrame.length;
    }

    Exit run(const Ray& ray, dvec3 low, dvec3 high) {
        start(ray);
        std::optional<Event> end;
        while (!end) {
            end = advance();
            noteDrift();
            if (end && end->kind == Event::Kind::Edge && mParts.size() > 1) {
                enter(partBeyond(end->which));
                end = {};
            }
        }
        Exit exit{mFrame.voxelFromUnit(positionOf(mState)),
                  glm::normalize(momentumOf(mState)),
                  mFrame.length * mState[6],
                  mFrame.length * mState[7],
                  mDrift,
                  end->kind != Event::Kind::Length};
        if (end->kind == Event::Kind::Face) {
            const int axis = end->which % 3;
            exit.x[axis] = end->which < 3 ? low[axis] : high[axis];
        }
        return exit;
    }

private:
    double whereOf(size_t part, const State& s) const {
        return mParts[part].where(mFrame.voxelFromUnit(positionOf(s))) / mFrame.length;
    }

    void start(const Ray& ray) {
        const dvec3 d = glm::normalize(ray.direction);
        const dvec3 x = (ray.x - mFrame.centre) / mFrame.length;
        mState = {x.x, x.y, x.z, 0, 0, 0, 0, 0};
        size_t part = 0;
        for (; part + 1 < mParts.size(); ++part) {
            double where = whereOf(part, mState);
            if (std::abs(where) < kTouch) { // on an edge: where is the ray bound for?
                const dvec3 next = x + 1e-6 * d;
                where = whereOf(part, {next.x, next.y, next.z});
            }
            if (where < 0) break;
        }
        enter(part);
        const dvec3 w = mParts[part].index(ray.x) * d;
        mState[3] = w.x, mState[4] = w.y, mState[5] = w.z;
    }

    size_t partBeyond(int edge) const {
        if (edge != static_cast<int>(mPart)) return static_cast<size_t>(edge);
        for (size_t i = 0; i < mParts.size(); ++i)
            if (i != mPart && (!mParts[i].where || whereOf(i, mState) < 0)) return i;
        throw std::runtime_error("a medium's last part must be everywhere");
    }

    void enter(size_t part) {
        mPart = part;
        mEvents.clear();
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<size_t>(axis);
            const double half = mHalf[axis];
            mEvents.push_back(
                {Event::Kind::Face, axis, [=](const State& s) { return -half - s[i]; }});
            mEvents.push_back(
                {Event::Kind::Face, axis + 3, [=](const State& s) { return s[i] - half; }});
        }
        mEvents.push_back(
            {Event::Kind::Length, 0, [this](const State& s) { return s[7] - mMost; }});
        for (size_t i = 0; i <= part; ++i) {
            if (!mParts[i].where) continue;
            const double side = i == part ? 1 : -1; // leaving this one, or entering one before it
            mEvents.push_back({Event::Kind::Edge, static_cast<int>(i),
                               [=, this](const State& s) { return side * whereOf(i, s); }});
        }
    }

    State fehlberg(const State& from, double dt) const {
        State to;
        Stepper().do_step(Flow{&mParts[mPart], &mFrame}, from, 0.0, to, dt);
        return to;
    }

    State twoHalves(const State& from, double dt) const {
        return fehlberg(fehlberg(from, dt / 2), dt / 2);
    }

    /// A step that keeps the tolerance: dt comes as what to try, goes as what was taken, and
    /// mStep is the next to try. The error is told from two half steps against a whole one, not by
    /// Fehlberg's own estimate: that is 0 where the force hardly depends on the path's bending, as
    /// on a straight way through a thin edge, whatever the step. The difference is some 2⁸ times
    /// the error; that is left as a margin.
    State stepped(const State& from, double& dt) {
        for (;;) {
            const State whole = fehlberg(from, dt), halves = twoHalves(from, dt);
            double error = 0;
            for (size_t i = 0; i < whole.size(); ++i) {
                const double off = std::abs(halves[i] - whole[i]) / (1 + std::abs(halves[i]));
                if (!std::isfinite(off)) throw std::runtime_error("the field is not finite");
                error = std::max(error, off / mTolerance);
            }
            // The difference goes with dt⁹. No more than fivefold either way, by custom.
            mStep = dt * std::clamp(0.9 * std::pow(error, -1.0 / 9), 0.2, 5.0);
            if (error <= 1) return halves;
            dt = mStep;
            // No smooth field asks for a step near a rounding.
            if (dt < 1e-12) throw std::runtime_error("the field is not smooth within a part");
        }
    }

    /// One step, cut short at the first thing to stop at, which is returned.
    std::optional<Event> advance() {
        const State from = mState;
        double dt = std::min(mStep, mLongest / glm::length(momentumOf(from)));
        mState = stepped(from, dt);
        const double taken = dt;
        const auto at = [&](double u) { return twoHalves(from, u * taken); };
        const double length = mState[7] - from[7];
        double first = 2;
        const Event* met = nullptr;
        for (const Event& event : mEvents) {
            const auto u = crossing([&](double v) { return event.ahead(at(v)); }, event.ahead(from),
                                    event.ahead(mState), length);
            if (u && *u < first) first = *u, met = &event;
        }
        if (!met) return {};
        mState = at(first);
        return *met;
    }

    void noteDrift() {
        const double n = mParts[mPart].index(mFrame.voxelFromUnit(positionOf(mState)));
        mDrift = std::max(mDrift, std::abs(glm::length(momentumOf(mState)) - n));
    }

    Frame mFrame;
    dvec3 mHalf{};
    std::vector<Part> mParts;
    std::vector<Event> mEvents;
    double mTolerance, mLongest, mMost;
    double mStep = 1e-2; // a first guess; the control finds its own
    State mState{};
    size_t mPart = 0;
    double mDrift = 0;
};

/// Brings a ray from outside straight to the box; none if it misses.
std::optional<Ray> broughtTo(const Ray& ray, const dvec3& low, const dvec3& high) {
    if (glm::all(glm::greaterThanEqual(ray.x, low)) && glm::all(glm::lessThanEqual(ray.x, high)))
        return ray;
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
        const double d = ray.direction[i];
        if (d == 0) {
            if (ray.x[i] < low[i] || ray.x[i] > high[i]) return {};
            continue;
        }
        const double near = ((d > 0 ? low : high)[i] - ray.x[i]) / d;
        if (near > enter) enter = near, axis = i;
        leave = std::min(leave, ((d > 0 ? high : low)[i] - ray.x[i]) / d);
    }
    if (axis < 0 || enter > leave) return {};
    Ray result{glm::clamp(ray.x + enter * ray.direction, low, high), ray.direction};
    result.x[axis] = (ray.direction[axis] > 0 ? low : high)[axis];
    return result;
}

} // namespace

Exit trace(const Medium& medium, const Ray& ray, dvec3 low, dvec3 high, double tolerance,
           double mostLength) {
    if (!glm::all(glm::lessThan(low, high))) throw std::invalid_argument("the box is empty");
    if (!(glm::length(ray.direction) > 0)) throw std::invalid_argument("the ray has no direction");
    const std::optional<Ray> brought = broughtTo(ray, low, high);
    if (!brought) return {ray.x, glm::normalize(ray.direction), 0, 0, 0, true};
    return Tracer(medium, low, high, tolerance, mostLength).run(*brought, low, high);
}

} // namespace judge
