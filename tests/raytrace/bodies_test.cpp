// Rays through bodies whose exit directions are known: spheres, boxes with total reflection.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/scenes.h"

#include <gtest/gtest.h>
#include <optional>
#include <tbb/global_control.h>

namespace eikonal::raytrace {
namespace {

using glm::dvec3;

/// Snell's law by the vector form, on paper: u along, normal against it, m = n / n'.
dvec3 refracted(const dvec3& u, const dvec3& normal, double m) {
    const double c = -glm::dot(u, normal);
    return m * u + (m * c - std::sqrt(1 - m * m * (1 - c * c))) * normal;
}

/// Where a ray leaves a sphere of radius 1, and how; nothing if it misses it.
struct Exit {
    dvec3 direction;
    double impact; ///< how far from the middle it passed before [radius]
};
std::optional<Exit> throughSphere(const dvec3& eye, const dvec3& u, double n) {
    const double b = glm::dot(eye, u), square = b * b - glm::dot(eye, eye) + 1;
    if (square < 0) return std::nullopt;
    const dvec3 p = eye + (-b - std::sqrt(square)) * u;
    const dvec3 within = refracted(u, p, 1 / n);
    const dvec3 q = p - 2 * glm::dot(p, within) * within;
    return Exit{refracted(within, -q, n), std::sqrt(1 - square)};
}

/// The mean angle to the exact exit directions, and the greatest below an impact of 0.95 [degree].
struct Errors {
    double mean = 0, worst = 0;
};
Errors sphereErrors(int subdivisions) {
    const Params params = lookingFrom({1, 2, 4}, 64, {"exit_direction"});
    const image::Image picture =
        rendered(params, {glass(smooth(mesh::icosphere(1, subdivisions)))});
    Errors errors;
    int count = 0;
    for (size_t i = 0; i < picture.area(); ++i) {
        const auto exact = throughSphere(params.camera.eye, rayOf(params.camera, i), 1.5);
        if (!exact || exact->impact > 0.95) continue;
        const double angle =
            degreesBetween(exact->direction, vectorAt(picture, "exit_direction.", i));
        errors.mean += angle;
        errors.worst = std::max(errors.worst, angle);
        ++count;
    }
    EXPECT_GT(count, 600);
    errors.mean /= count;
    return errors;
}

// What is left is what facets with interpolated normals are off a sphere: a quarter for each
// halving of their edges, h² / 8 in place and as much in direction. At six subdivisions h = 0.017
// and that is 4e-5 = 0.002°, some times as much where a ray is oblique.
TEST(Bodies, ASphereRefractsAsOnPaper) {
    const Errors coarse = sphereErrors(4), fine = sphereErrors(5), finest = sphereErrors(6);
    EXPECT_LT(finest.mean, 0.005);
    EXPECT_LT(finest.worst, 0.05);
    EXPECT_NEAR(std::log2(coarse.mean / fine.mean), 2, 0.3);
    EXPECT_NEAR(std::log2(fine.mean / finest.mean), 2, 0.3);
}

TEST(Bodies, WithoutNormalsASphereIsAPolyhedron) {
    const Params params = lookingFrom({1, 2, 4}, 32, {"exit_direction"});
    const image::Image smoothed = rendered(params, {glass(smooth(mesh::icosphere(1, 3)))});
    const image::Image flat = rendered(params, {glass(mesh::icosphere(1, 3))});
    double mean = 0;
    for (size_t i = 0; i < flat.area(); ++i)
        mean += degreesBetween(vectorAt(flat, "exit_direction.", i),
                               vectorAt(smoothed, "exit_direction.", i));
    EXPECT_GT(mean / static_cast<double>(flat.area()), 0.3);
}

/// The path of a ray that refracts where it can, through the box of half-size h about the origin.
struct BoxExit {
    dvec3 x, direction;
    int reflections;
    double margin; ///< nearest to an edge that it came [unit]
};
std::optional<BoxExit> throughBox(const dvec3& eye, const dvec3& u, const dvec3& h, double n) {
    const auto marginAt = [&](const dvec3& x, int axis) {
        const dvec3 left = h - glm::abs(x);
        return std::min(left[(axis + 1) % 3], left[(axis + 2) % 3]);
    };
    double enter = -1e9, leave = 1e9;
    int axis = 0;
    for (int a = 0; a < 3; ++a) {
        const double s = (-h[a] - eye[a]) / u[a], t = (h[a] - eye[a]) / u[a];
        if (std::min(s, t) > enter) {
            enter = std::min(s, t);
            axis = a;
        }
        leave = std::min(leave, std::max(s, t));
    }
    if (enter >= leave) return std::nullopt;
    BoxExit path{eye + enter * u, u / n, 0, 1e9};
    path.margin = marginAt(path.x, axis);
    path.direction[axis] = 0;
    path.direction[axis] =
        std::copysign(std::sqrt(1 - glm::dot(path.direction, path.direction)), u[axis]);
    for (; path.reflections < 64; ++path.reflections) {
        double t = 1e9;
        for (int a = 0; a < 3; ++a) {
            const double way =
                (std::copysign(h[a], path.direction[a]) - path.x[a]) / path.direction[a];
            if (way < t && way > 1e-12) {
                t = way;
                axis = a;
            }
        }
        path.x += t * path.direction;
        path.margin = std::min(path.margin, marginAt(path.x, axis));
        dvec3 out = n * path.direction;
        out[axis] = 0;
        const double rest = 1 - glm::dot(out, out);
        if (rest > 0) {
            out[axis] = std::copysign(std::sqrt(rest), path.direction[axis]);
            path.direction = out;
            return path;
        }
        path.direction[axis] = -path.direction[axis];
    }
    return std::nullopt;
}

TEST(Bodies, ABoxReflectsTotallyAsOnPaper) {
    const dvec3 half(0.5, 0.8, 0.3);
    const Params params = lookingFrom({1.5, 1.1, 2}, 64, {"exit_direction", "exit_position"});
    const image::Image picture = rendered(params, {glass(smooth(mesh::boxShape(-half, half)))});
    int refracted = 0, total = 0;
    for (size_t i = 0; i < picture.area(); ++i) {
        const auto exact = throughBox(params.camera.eye, rayOf(params.camera, i), half, 1.5);
        if (!exact || exact->margin < 1e-5) continue;
        (exact->reflections > 0 ? total : refracted)++;
        // What floats of the picture hold.
        EXPECT_LT(glm::distance(exact->direction, vectorAt(picture, "exit_direction.", i)), 1e-6)
            << "pixel " << i;
        EXPECT_LT(glm::distance(exact->x, vectorAt(picture, "exit_position.", i)), 1e-6);
    }
    EXPECT_GT(refracted, 100);
    EXPECT_GT(total, 300);
}

TEST(Bodies, AWhiteRoomStaysWhite) {
    Params params = lookingFrom({1, 2, 4}, 48);
    params.background = dvec3(1);
    const mesh::TriangleMesh box = mesh::boxShape(dvec3(-1), dvec3(0.6, 0.7, 0.8));
    const std::vector<std::vector<Body>> scenes = {
        {glass(smooth(mesh::icosphere(1, 3)))},
        {glass(mesh::icosphere(1, 2), 2.4)},
        {glass(box), glass(smooth(mesh::icosphere(1, 3)), 1.33)},
        {glass(mesh::joined(box, mesh::turnedInsideOut(mesh::icosphere(0.5, 2))))},
        {glass(mesh::joined(box, mesh::boxShape(dvec3(-0.5), dvec3(1.2))))},
        {plate(box, dvec3(1)), glass(mesh::moved(mesh::icosphere(1, 3), {1, 1, 1}))}};
    for (const int depth : {1, 4, 64})
        for (size_t scene = 0; scene < scenes.size(); ++scene) {
            params.maxDepth = depth;
            const image::Image picture = rendered(params, scenes[scene]);
            int seen = 0;
            for (size_t i = 0; i < picture.area(); ++i) {
                ASSERT_LT(glm::distance(colourAt(picture, i), dvec3(1)), 1e-6)
                    << "scene " << scene << ", depth " << depth << ", pixel " << i;
                seen += picture.plane(3)[i] == 1;
            }
            EXPECT_GT(seen, 300);
        }
}

// Paths that skim along facets and meet edges and corners by the thousand: none gets out between
// two triangles. One in a million is what single precision leaves.
TEST(Bodies, NoLightLeavesABumpyBodyThroughItsEdges) {
    mesh::TriangleMesh bumpy = mesh::icosphere(1, 5);
    for (dvec3& x : bumpy.points)
        x *= 1 + 0.15 * std::sin(7 * x.x) * std::sin(8 * x.y + 1) * std::sin(6 * x.z + 2);
    for (const mesh::TriangleMesh& mesh : {bumpy, smooth(bumpy)}) {
        Stats stats;
        render(lookingFrom({1, 2, 3}, 128), {glass(mesh, 1.6)}, std::nullopt, stats, {});
        EXPECT_GT(stats.counter("boundaries_met"), 50000);
        EXPECT_LT(stats.counter("light_lost_by_holes") * stats.counter("rays"), 1);
    }
}

// Many shells that cross are one solid: within it paths pass faces by the dozen, and all of them
// end.
TEST(Bodies, CrossingShellsAreOneSolid) {
    mesh::TriangleMesh heap;
    for (int i = 0; i < 24; ++i)
        heap = mesh::joined(heap, mesh::moved(mesh::icosphere(0.5, 3),
                                              0.6 * dvec3(std::sin(7.1 * i), std::sin(5.3 * i),
                                                          std::sin(3.7 * i))));
    Params params = lookingFrom({1, 2, 3}, 96);
    params.background = dvec3(1);
    for (const mesh::TriangleMesh& mesh : {heap, smooth(heap)}) {
        Stats stats;
        const image::Image picture = render(params, {glass(mesh)}, std::nullopt, stats, {});
        for (size_t i = 0; i < picture.area(); ++i)
            ASSERT_LT(glm::distance(colourAt(picture, i), dvec3(1)), 1e-6);
        EXPECT_LT(stats.counter("light_lost_by_holes"), 1e-3);
    }
}

TEST(Bodies, AnEyeInGlassSeesBrighterLight) {
    Params params = lookingFrom({0.1, 0.2, 0.3}, 16);
    params.background = dvec3(1);
    params.camera.fov = 20;
    // L/n² is what stays along a ray; all of it comes from outside.
    const image::Image picture = rendered(params, {glass(smooth(mesh::icosphere(1, 3)))});
    for (size_t i = 0; i < picture.area(); ++i) EXPECT_NEAR(colourAt(picture, i).x, 2.25, 1e-5);
}

TEST(Bodies, ABubbleOfTheSameIndexIsNotSeen) {
    const Params params = lookingFrom({1, 2, 4}, 32, {"exit_direction"});
    const std::vector<Body> one = {glass(mesh::boxShape(dvec3(-1), dvec3(1)))};
    std::vector<Body> two = one;
    two.push_back(glass(mesh::icosphere(0.5, 3)));
    EXPECT_EQ(rendered(params, one).pixels, rendered(params, two).pixels);
    two.back().ior = 1.0;
    EXPECT_NE(rendered(params, one).pixels, rendered(params, two).pixels);
}

TEST(Bodies, ThePictureDoesNotDependOnThreads) {
    Params params = lookingFrom({1, 2, 4}, 48, allAovs());
    params.background = dvec3(0.2, 0.5, 1);
    params.samples = 2;
    const std::vector<Body> bodies = {
        glass(smooth(mesh::icosphere(1, 5)), 1.5, {0.1, 0.4, 0.2}),
        plate(mesh::boxShape({-3, -2, -3}, {3, -1.5, 3}), {0.5, 0.4, 0.3})};
    const auto by = [&](size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return rendered(params, bodies).pixels;
    };
    const std::vector<float> one = by(1);
    EXPECT_EQ(one, by(2));
    EXPECT_EQ(one, by(5));
}

TEST(Bodies, DeflectionIsTheExitsAnglesInThePicturesAxes) {
    Params params = lookingFrom({0, 0, 4}, 24, {"exit_direction", "deflection"});
    const image::Image picture = rendered(params, {glass(smooth(mesh::icosphere(1, 4)))});
    const auto at = [&](const char* channel, size_t i) {
        return picture.plane(*picture.find(channel))[i];
    };
    double most = 0;
    for (size_t i = 0; i < picture.area(); ++i) {
        const dvec3 began = rayOf(params.camera, i), exit = vectorAt(picture, "exit_direction.", i);
        // Each is the angle of a projection, so below that of the directions themselves.
        const double angle = glm::radians(degreesBetween(began, exit));
        EXPECT_LT(std::abs(at("deflection.X", i)), angle + 1e-6);
        EXPECT_LT(std::abs(at("deflection.Y", i)), angle + 1e-6);
        most = std::max(most, angle);
        const double turned = exit.x / -exit.z - began.x / -began.z;
        if (angle > 1e-3 && angle < 1) {
            EXPECT_EQ(at("deflection.X", i) > 0, turned > 0);
        }
    }
    EXPECT_GT(most, 0.5);
}

} // namespace
} // namespace eikonal::raytrace
