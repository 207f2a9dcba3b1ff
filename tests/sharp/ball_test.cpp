// Balls of glass with a sharp boundary: every ray by Snell's law, every order by Fresnel's.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

using std::numbers::pi;

const dvec3 kCentre(31.63, 32.21, 31.87); // on no lattice point, and at no one's half
constexpr double kRadius = 26.3;

judge::Glass ballOf(double inside, double around) {
    return {{judge::glassBall(kCentre, kRadius, inside)}, around};
}

struct Kind {
    const char* name;
    judge::Glass glass;
    double ratio() const { return glass.solids[0].index / glass.around; }
};
const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"glass", ballOf(1.5, 1)}, {"bubble", ballOf(1, 1.5)}, {"diamond", ballOf(2.42, 1)}};
    return all;
}

const std::vector<dvec3> kViews = {{0, 0, -1}, {1, 0.37, -0.21}, {-0.4, -1, 0.7}};

/// Where refraction turns into total reflection a bubble's deflection has an infinite slope: within
/// half a percent of there 1e-4 voxels are more than 0.01°.
bool critical(double ratio, double impact) {
    return ratio < 1 && std::abs(impact - ratio) < 0.005;
}

/// A ray past the centre at impact · radius, on the side of `azimuth`, along `view`.
judge::Ray aimed(const dvec3& view, double impact, double azimuth) {
    const dvec3 d = glm::normalize(view);
    const dvec3 u = glm::normalize(glm::cross(d, dvec3(0.3, 0.8, 0.5))), v = glm::cross(d, u);
    return {kCentre - 60.0 * d + impact * kRadius * (std::cos(azimuth) * u + std::sin(azimuth) * v),
            d};
}

/// Bars of the requirements: 0.01° up to 0.95 of the radius, 0.1° up to 0.99.
void expectSnells(const Kind& kind, const Voxels& voxels) {
    for (const dvec3& direction : kViews) {
        const Params params = along(direction, kCentre, 2 * kRadius, {61, 61});
        const Look look(volumeOf(kind.glass, voxels), params);
        for (const auto& [from, to, degrees] :
             {std::tuple(0.0, 0.95, 0.01), std::tuple(0.95, 0.99, 0.1)}) {
            const Off off = offOf(look, params, kind.glass, [&](const judge::Ray& ray) {
                const double impact = impactOf(ray, kCentre, kRadius);
                return impact > from && impact <= to && !critical(kind.ratio(), impact);
            });
            EXPECT_GT(off.rays, 100);
            EXPECT_LT(off.degrees, degrees) << kind.name << " to " << to << ", worst at impact "
                                            << impactOf(off.worst, kCentre, kRadius);
            // From the ball to the domain's face are 40 voxels at most; the bar's angle over them,
            // and as much again for where the ray left the ball.
            const double place = 2 * 40 * degrees * pi / 180;
            EXPECT_LT(off.place, place) << kind.name;
            EXPECT_LT(off.optical, 3 * place) << kind.name; // an index of up to 2.42
        }
    }
}

/// Radiance of each order alone: the surroundings shine in cones of 5° about their directions, one
/// colour an order.
std::array<double, 4> ordersSeen(const Kind& kind, const judge::Ray& ray,
                                 const std::array<dvec3, 4>& directions) {
    std::array<double, 4> seen{};
    for (size_t first = 0; first < 4; first += 2) {
        const image::Image map = mapOf([&](dvec3 d) {
            return dvec3(degreesBetween(d, directions[first]) < 5,
                         degreesBetween(d, directions[first + 1]) < 5, 0);
        });
        const Look look(volumeOf(kind.glass), oneRay(ray), map);
        seen[first] = look.at("R");
        seen[first + 1] = look.at("G");
    }
    return seen;
}

} // namespace

TEST(SharpBall, RaysLeaveAsSnellSays) {
    for (const Kind& kind : kinds()) expectSnells(kind, {});
}

TEST(SharpBall, ABandOfFourVoxelsIsEnough) {
    // As mesh2vol writes it: beyond the band distances are cut, and nothing of that kink may be
    // seen.
    expectSnells(kinds()[0], {.halfWidth = 4});
}

TEST(SharpBall, TheWorldsUnitDoesNotMatter) {
    // Voxels of 0.02 units: distances are in units, and rays come from elsewhere in floats.
    const Kind& kind = kinds()[0];
    const double h = 0.02;
    Params params = along(kViews[1], kCentre, 2 * kRadius, {31, 31});
    const Params inVoxels = params;
    params.camera.eye *= h;
    params.camera.target *= h;
    params.camera.height *= h;
    const Look look(volumeOf(kind.glass, {.voxelSize = h}), params);
    const auto [width, height] = std::pair(31, 31);
    double worst = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const judge::Ray ray = rayOf(inVoxels, x, y);
            if (impactOf(ray, kCentre, kRadius) > 0.95) continue;
            const judge::Path path = judge::followTransmitted(kind.glass, ray);
            worst = std::max(worst, degreesBetween(look.direction(x, y), path.ray.direction));
        }
    EXPECT_LT(worst, 0.01); // the bar of the requirements
}

TEST(SharpBall, FirstFourOrdersAreFresnels) {
    for (const Kind& kind : kinds()) {
        int compared = 0;
        for (double impact = 0.04; impact < 0.99; impact += 0.05) {
            if (critical(kind.ratio(), impact) || impact > kind.ratio()) continue;
            const judge::Ray ray = aimed(kViews[1], impact, 9 * impact);
            const judge::Tree tree =
                judge::followAll(kind.glass, ray, {.maxDepth = 8, .minThroughput = 1e-5});
            const std::string courses[] = {"R", "TT", "TRT", "TRRT"};
            std::array<dvec3, 4> directions{};
            for (const judge::Branch& branch : tree.left)
                for (size_t order = 0; order < 4; ++order)
                    if (branch.course == courses[order]) directions[order] = branch.ray.direction;
            // A cone's edge is a pixel of the map wide, 0.7°: no other branch may come within 6°.
            bool apart = true;
            for (const judge::Branch& branch : tree.left)
                for (size_t order = 0; order < 4; ++order)
                    apart = apart && (branch.course == courses[order] ||
                                      degreesBetween(branch.ray.direction, directions[order]) > 6);
            if (!apart) continue;
            ++compared;
            const auto shares = judge::ballOrders(kind.ratio(), impact, false);
            const auto seen = ordersSeen(kind, ray, directions);
            for (size_t order = 0; order < 4; ++order) // the bar of the requirements
                EXPECT_NEAR(seen[order], shares[order], 1e-3)
                    << kind.name << " at " << impact << ", order " << order;
        }
        EXPECT_GE(compared, 4) << kind.name;
    }
}

TEST(SharpBall, SurroundingsAreSeenByEveryOrder) {
    // Radiance that differs by direction, each colour along an axis of its own, against the judge's
    // whole tree. The map is linear between pixels of 0.7°: off by (0.012)²/8.
    const auto shine = [](dvec3 d) { return 1.0 + 0.8 * d; };
    const image::Image map = mapOf(shine);
    for (const Kind& kind : kinds()) {
        const Params params = along(kViews[2], kCentre, 2 * kRadius, {31, 31});
        const Look look(volumeOf(kind.glass), params, map);
        int compared = 0;
        for (int y = 0; y < 31; ++y)
            for (int x = 0; x < 31; ++x) {
                const judge::Ray ray = rayOf(params, x, y);
                const double impact = impactOf(ray, kCentre, kRadius);
                if (impact > 0.97 || critical(kind.ratio(), impact)) continue;
                const judge::Tree tree = judge::followAll(
                    kind.glass, ray, {.maxDepth = params.maxDepth, .minThroughput = params.cutoff});
                if (tree.closestCall < 0.01) continue; // rounding decides which branches count
                dvec3 wanted(0);
                for (const auto* branches : {&tree.left, &tree.deep})
                    for (const judge::Branch& branch : *branches)
                        wanted += branch.weight * shine(branch.ray.direction);
                expectNear(look.colour(x, y), wanted, 1e-3); // the bar of one order, for all
                ++compared;
            }
        EXPECT_GT(compared, 200);
    }
}

TEST(SharpBall, AUniformBackgroundShowsNoGlass) {
    // 1 less what is dropped, 1e-4 by the requirements.
    for (const Kind& kind : kinds()) {
        Params params = along(kViews[1], kCentre, 2.4 * kRadius, {61, 61});
        params.background = dvec3(1);
        const Look look(volumeOf(kind.glass), params);
        int rays = 0;
        const double off = energyOff(
            look, params, kind.glass,
            [&](const judge::Ray& ray) {
                const double impact = impactOf(ray, kCentre, kRadius);
                return !critical(kind.ratio(), impact) && !(impact > 0.99 && impact < 1.001);
            },
            &rays);
        EXPECT_GT(rays, 1000);
        EXPECT_LT(off, 1e-4) << kind.name;
    }
}

TEST(SharpBall, WhatIsTooDimToFollowIsNotLost) {
    // Branches of a share below the cutoff are not followed, but their light is: clear glass takes
    // none of a uniform background, however coarse the cutoff is, up to a tenth.
    const Kind& kind = kinds()[0];
    for (const double cutoff : {1e-3, 0.01, 0.1}) {
        Params params = along(kViews[0], kCentre, 1.9 * kRadius, {31, 31});
        params.background = dvec3(1);
        params.maxDepth = 40;
        params.cutoff = cutoff;
        const Look look(volumeOf(kind.glass), params);
        for (int y = 0; y < 31; ++y)
            for (int x = 0; x < 31; ++x) EXPECT_NEAR(look.at("R", x, y), 1, 1e-4) << cutoff;
        EXPECT_LT(look.counter("light_dropped_as_dim"), 1e-6);
        EXPECT_LT(look.counter("light_dropped_by_depth"), 1e-6);
    }
}

TEST(SharpBall, TheCutoffBoundsTheError) {
    // Each branch given up moves less than the cutoff of light to where another one goes: at the
    // usual cutoff a few of a thousandth, of surroundings between 0.2 and 1.8.
    const image::Image map = mapOf([](dvec3 d) { return 1.0 + 0.8 * d; });
    const Kind& kind = kinds()[0];
    Params params = along(kViews[2], kCentre, 1.9 * kRadius, {31, 31});
    params.maxDepth = 40;
    const Look exact(volumeOf(kind.glass), params, map);
    params.cutoff = view::Params().cutoff;
    const Look usual(volumeOf(kind.glass), params, map);
    double worst = 0, sum = 0;
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 31; ++x) {
            const double off = std::abs(usual.at("R", x, y) - exact.at("R", x, y));
            worst = std::max(worst, off);
            sum += off / (31 * 31);
        }
    EXPECT_LT(worst, 5e-3);
    EXPECT_LT(sum, 1e-3);
}

TEST(SharpBall, LimitsAreKeptToTheBoundary) {
    // At depth 1 all goes on but the mirror's share; at 2 what is reflected within. It is told as
    // dropped, and sees what is straight ahead: a uniform background shows no glass at any depth.
    const Kind& kind = kinds()[0];
    for (const int depth : {1, 2, 3}) {
        Params params = along(kViews[0], kCentre, 1.9 * kRadius, {21, 21});
        params.background = dvec3(1);
        params.maxDepth = depth;
        const Look look(volumeOf(kind.glass), params);
        double deep = 0;
        for (int y = 0; y < 21; ++y)
            for (int x = 0; x < 21; ++x) {
                deep += judge::followAll(kind.glass, rayOf(params, x, y),
                                         {.maxDepth = depth, .minThroughput = params.cutoff})
                            .tooDeep;
                EXPECT_NEAR(look.at("R", x, y), 1, 1e-4);
            }
        EXPECT_NEAR(look.counter("light_dropped_by_depth"), deep / (21 * 21), 1e-4) << depth;
    }
}

TEST(SharpBall, TheSilhouetteIsSharp) {
    // Rays 1.2e-4 voxels apart across the rim: a thousandth of a voxel beyond it they go straight
    // on, as far inside they are turned by nearly as much as a grazing ray, π − 2 asin(1/n).
    const Kind& kind = kinds()[0];
    const double most = 180 - 2 * std::asin(1 / 1.5) * 180 / pi;
    for (const dvec3& direction : kViews)
        for (double azimuth = 0.1; azimuth < 2 * pi; azimuth += 0.8) {
            const judge::Ray rim = aimed(direction, 1, azimuth);
            const judge::Ray middle = aimed(direction, 0, 0);
            Params params = sharply(view::parallel(rim.x, rim.x + rim.direction, 6e-3, {1, 51},
                                                   glm::normalize(rim.x - middle.x)));
            params.background = dvec3(1);
            const Look look(volumeOf(kind.glass), params); // which checks every sample
            for (int y = 0; y < 51; ++y) {
                const double beyond =
                    (impactOf(rayOf(params, 0, y), kCentre, kRadius) - 1) * kRadius;
                const double turn = degreesBetween(look.direction(0, y), rim.direction);
                if (beyond > 1e-3) {
                    EXPECT_LT(turn, 1e-3) << beyond << " voxels beyond";
                }
                // A ray 3e-3 voxels inside arrives at cosθ = 0.015, which deflection falls with
                // twice: 1.7°.
                if (beyond < -1e-3) {
                    EXPECT_NEAR(turn, most, 2) << -beyond << " voxels inside";
                }
                // What grazes is mirrored. At most the tenth that gets in there may be dropped.
                EXPECT_GT(look.at("R", 0, y), 0.9);
                EXPECT_LT(look.at("R", 0, y), 1 + 1e-4);
            }
        }
}

TEST(SharpBall, RaysMayStartInsideGlass) {
    for (const Kind& kind : kinds())
        for (const dvec3& direction : kViews) {
            const dvec3 d = glm::normalize(direction);
            const dvec3 eye = kCentre - 0.2 * kRadius * d;
            Params params =
                sharply(view::parallel(eye, eye + d, kRadius, {31, 31},
                                       std::abs(d.y) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
            params.background = dvec3(1);
            const Look look(volumeOf(kind.glass), params);
            const auto counts = [&](const judge::Ray& ray) { return tellable(kind.glass, ray); };
            const Off off = offOf(look, params, kind.glass, counts);
            EXPECT_GT(off.rays, kind.ratio() > 2 ? 300 : 600) << kind.name; // many are trapped
            EXPECT_LT(off.degrees, 0.01) << kind.name;
            // L/n² at the eye: the bar of 1e-4 is for radiance of 1.
            const double square = kind.ratio() * kind.ratio();
            EXPECT_LT(energyOff(look, params, kind.glass, counts), 1e-4 * std::max(1.0, square));
        }
}

TEST(SharpBall, ASmallBallIsRefractedToo) {
    // Radius 4: at so few voxels the spline's own error shows, and the distance's kink in the
    // centre. Reached is 0.31° up to 0.95 of the radius, 0.09° up to 0.8.
    const dvec3 centre(7.63, 8.21, 7.87);
    const judge::Glass glass{{judge::glassBall(centre, 4, 1.5)}};
    double worst = 0;
    for (const dvec3& direction : kViews) {
        Params params = along(direction, centre, 8, {41, 41});
        params.background = dvec3(1);
        const Look look(volumeOf(glass, {.size = ivec3(16)}), params);
        const auto within = [&](const judge::Ray& ray) { return impactOf(ray, centre, 4) < 0.95; };
        worst = std::max(worst, offOf(look, params, glass, within).degrees);
        // So do weights err, and with them what falls below a thousandth.
        const auto told = [&](const judge::Ray& ray) {
            return within(ray) && judge::followAll(glass, ray).closestCall > 0.1;
        };
        EXPECT_LT(energyOff(look, params, glass, told), 1e-4);
    }
    EXPECT_LT(worst, 0.4);
}

TEST(SharpBall, ALensFocusesWhereItShouldAndItsCausticEndsThere) {
    const Kind& kind = kinds()[0];
    const dvec3 d = glm::normalize(kViews[1]);
    // Where the ray of an impact meets its neighbour's, and where it meets the axis.
    const auto look = [&](double impact) {
        const judge::Ray ray = aimed(d, impact, 1.3);
        const Look one(volumeOf(kind.glass), oneRay(ray));
        const dvec3 across = glm::normalize(ray.x - aimed(d, 0, 0).x);
        struct Line {
            double along, across, slope; // of a point on it from the centre, and d across / d along
        };
        const dvec3 r = one.place() - kCentre, out = one.direction();
        return Line{glm::dot(r, d), glm::dot(r, across), glm::dot(out, across) / glm::dot(out, d)};
    };
    // Near the axis the crossing is n R/(2 (n − 1)) less a term in impact²; from two the limit.
    const auto crossing = [&](double impact) {
        const auto line = look(impact);
        return line.along - line.across / line.slope;
    };
    const double near = crossing(0.05), far = crossing(0.1);
    // A direction good to 0.001° at a slope of 0.03 places the crossing to 6e-4 of 39 voxels.
    EXPECT_NEAR(near + (near - far) / 3, judge::ballFocus(1.5, kRadius), 0.05);
    for (const double impact : {0.1, 0.25, 0.4, 0.55, 0.7, 0.85}) {
        const double h = 0.02;
        const auto a = look(impact - h), b = look(impact + h);
        // The crossing of two lines in the plane of incidence, against that of the judge's.
        const double x =
            (b.across - b.slope * b.along - a.across + a.slope * a.along) / (a.slope - b.slope);
        const double t0 = judge::ballDeflection(1.5, impact - h),
                     t1 = judge::ballDeflection(1.5, impact + h);
        const double b0 = (impact - h) * kRadius, b1 = (impact + h) * kRadius;
        const double wanted =
            (b1 / std::cos(t1) - b0 / std::cos(t0)) / (std::tan(t1) - std::tan(t0));
        // 0.001° of two rays that meet at half a degree and more: 0.2 % of the way from the ball.
        EXPECT_NEAR(x, wanted, 0.1) << impact;
        // h² apart from the caustic itself.
        EXPECT_NEAR(wanted, judge::ballCaustic(1.5, kRadius, impact).along, 0.2) << impact;
    }
}
