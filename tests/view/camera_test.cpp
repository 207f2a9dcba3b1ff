// Cameras and what surrounds the scene: which ray belongs to which pixel, and what it sees.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/background.h"
#include "support/look.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;

volume::Volume emptiness(ivec3 size = ivec3(16), double index = 1) {
    TestVolume scene(size);
    scene.add(
        "ior", [=](dvec3) { return index; }, index);
    return scene.take();
}

/// A map whose colour tells the direction, (d + 1)/2, by the formulas of ImfEnvmap.h.
image::Image directionMap(image::Envmap kind) {
    const int width = 256, height = 128;
    image::Image map(width, height);
    std::vector<float> pixels;
    const bool edges = kind == image::Envmap::latLong;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double u = edges ? column / (width - 1.0) : (column + 0.5) / width;
            const double v = edges ? row / (height - 1.0) : (row + 0.5) / height;
            const double latitude = kPi * (0.5 - v), longitude = kPi * (1 - 2 * u);
            const dvec3 d(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                          std::cos(longitude) * std::cos(latitude));
            for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<float>(0.5 + 0.5 * d[c]));
        }
    map.addChannels({"R", "G", "B"}, pixels, 3);
    map.envmap = kind;
    return map;
}

/// The direction whose colour a ray along `direction` sees.
dvec3 seenAlong(const dvec3& direction, image::Envmap kind, double turn = 0, bool zUp = false) {
    const dvec3 up =
        std::abs(direction.y) > 0.9 * glm::length(direction) ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    Params params = parallel(dvec3(8) - 50.0 * direction, dvec3(8), 1, {1, 1}, up);
    params.environmentTurn = turn;
    params.environmentZUp = zUp;
    return 2.0 * Look(emptiness(), params, directionMap(kind)).colour() - 1.0;
}

const dvec3 kDirections[] = {{0, 0, 1},  {0, 0, -1}, {1, 0, 0},     {-1, 0, 0},   {0, 1, 0},
                             {0, -1, 0}, {1, 1, 1},  {-0.3, 2, -1}, {0.5, -1, -3}};

// Bilinear between pixels 2π/256 apart, of which the second derivative is at most 1: 2.45e-2² / 8
// is 7.5e-5 each way; at the poles of a map by centres half a pixel is missing: 1 − cos of it is
// nothing, but its sine is 1.2e-2.
constexpr double kMapTolerance = 3e-4, kPoleTolerance = 1.3e-2;

} // namespace

TEST(ViewEnvironment, DirectionsAreOpenExrs) {
    for (const auto kind : {image::Envmap::none, image::Envmap::latLong})
        for (const dvec3& direction : kDirections) {
            const bool pole = direction.x == 0 && direction.z == 0;
            expectNear(seenAlong(direction, kind), glm::normalize(direction),
                       pole && kind == image::Envmap::none ? kPoleTolerance : kMapTolerance);
        }
}

TEST(ViewEnvironment, DirectionsAreFoundToAHundredthOfAPixel) {
    // A map of its own coordinates, which bilinear look-ups leave as they are.
    for (const auto kind : {image::Envmap::none, image::Envmap::latLong}) {
        const int width = 64, height = 32;
        image::Image map(width, height);
        std::vector<float> pixels;
        const bool edges = kind == image::Envmap::latLong;
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                const double u = edges ? column / 63.0 : (column + 0.5) / 64;
                const double v = edges ? row / 31.0 : (row + 0.5) / 32;
                pixels.insert(pixels.end(), {static_cast<float>(u), static_cast<float>(v), 0});
            }
        map.addChannels({"R", "G", "B"}, pixels, 3);
        map.envmap = kind;
        const Look look(emptiness(), perspective(dvec3(8), {8, 8.3, 9}, 150, {41, 41}), map);
        double worst = 0;
        for (int y = 0; y < 41; ++y)
            for (int x = 0; x < 41; ++x) {
                const dvec3 d = look.direction(x, y);
                const double u = 0.5 - std::atan2(d.x, d.z) / (2 * kPi);
                const double v = 0.5 - std::atan2(d.y, std::hypot(d.x, d.z)) / kPi;
                if (u < 0.02 || u > 0.98 || v < 0.03 || v > 0.97) continue; // seam and poles
                worst = std::max({worst, std::abs(look.at("R", x, y) - u) * 2,
                                  std::abs(look.at("G", x, y) - v)});
            }
        // In units of half a turn: a hundredth of a pixel of a map of 4096 by 2048.
        EXPECT_LT(worst, 5e-6);
    }
}

TEST(ViewEnvironment, MapsOfHalvesTakeHalfTheMemoryAndLookTheSame) {
    const int width = 256, height = 128;
    std::vector<float> pixels(3 * static_cast<size_t>(width) * height);
    std::mt19937 random(3);
    // Eleven digits from 2^-14 to 2^15, as halves have them.
    for (float& value : pixels)
        value = std::ldexp(static_cast<float>(1024 + random() % 1024),
                           static_cast<int>(random() % 30) - 24);
    const auto mapOf = [&] {
        image::Image map(width, height);
        map.addChannels({"R", "G", "B"}, pixels, 3);
        return map;
    };
    const auto lookAt = [](const image::Image& map) {
        return Look(emptiness(), perspective(dvec3(8), {8, 8.3, 9}, 120, {41, 41}), map);
    };
    const image::Image halves = mapOf();
    pixels[0] = 1 + 1e-5f; // at the map's edge, behind the camera: no half
    const image::Image floats = mapOf();
    EXPECT_EQ(lookAt(halves).picture.pixels, lookAt(floats).picture.pixels);
    EXPECT_EQ(camera::makeMap(device(), halves).bytes(), 8 * width * height);
    EXPECT_EQ(camera::makeMap(device(), floats).bytes(), 16 * width * height);
}

TEST(ViewEnvironment, TurnsAndOtherUpAxes) {
    const auto kind = image::Envmap::latLong;
    // Turned by +90°, what was at +X is at +Z, and the poles stay.
    expectNear(seenAlong({0, 0, 1}, kind, 90), {1, 0, 0}, kMapTolerance);
    expectNear(seenAlong({1, 0, 0}, kind, 90), {0, 0, -1}, kMapTolerance);
    expectNear(seenAlong({0, 1, 0}, kind, 90), {0, 1, 0}, kMapTolerance);
    // A map with its pole at +Z: what is up in it is seen there.
    expectNear(seenAlong({0, 0, 1}, kind, 0, true), {0, 1, 0}, kMapTolerance);
    expectNear(seenAlong({1, 0, 0}, kind, 0, true), {1, 0, 0}, kMapTolerance);
    expectNear(seenAlong({0, 1, 0}, kind, 0, true), {0, 0, -1}, kMapTolerance);
}

TEST(ViewEnvironment, AConstantOneIsSeenExactly) {
    image::Image map(8, 4);
    std::vector<float> pixels;
    for (int i = 0; i < 32; ++i) pixels.insert(pixels.end(), {0.1f, 2.0f, 30.0f});
    map.addChannels({"R", "G", "B"}, pixels, 3);
    for (const double index : {1.0, 1.5}) {
        const Look look(emptiness(ivec3(16), index),
                        perspective({20, 30, 40}, dvec3(8), 50, {24, 16}), map);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 24; ++x) {
                // Divided and multiplied by the same n², and mixed from equals: three roundings.
                expectNear(look.colour(x, y) / dvec3(0.1f, 2.0f, 30.0f), dvec3(1), 3e-7);
                EXPECT_EQ(look.at("A", x, y), 0);
            }
    }
    Params params = perspective({20, 30, 40}, dvec3(8), 50, {24, 16});
    params.background = {1, 2, 3};
    EXPECT_EQ(Look(emptiness(), params).colour(7, 9), dvec3(1, 2, 3));
}

TEST(ViewCamera, PicturesAreTheRightWayRound) {
    // Shining blocks beyond the middle along +X red, +Y green, +Z blue.
    const auto scene = [] {
        TestVolume out(ivec3(16));
        out.addVector("emission", [](dvec3 p) {
            dvec3 colour(0);
            for (int c = 0; c < 3; ++c) {
                dvec3 d = glm::abs(p - 8.0);
                d[c] = std::abs(p[c] - 13);
                if (std::max({d.x, d.y, d.z}) < 1.6) colour[c] = 1;
            }
            return colour;
        });
        return out.take();
    };
    struct View {
        dvec3 eye, up;
        ivec2 places[3]; // where each colour's centre lies among 3 × 3 fields, from the top left
    };
    const View views[] = {
        {{0, 0, 1}, {0, 1, 0}, {{2, 1}, {1, 0}, {1, 1}}},
        {{0, 0, -1}, {0, 1, 0}, {{0, 1}, {1, 0}, {1, 1}}},
        {{1, 0, 0}, {0, 1, 0}, {{1, 1}, {1, 0}, {0, 1}}},
        {{-1, 0, 0}, {0, 1, 0}, {{1, 1}, {1, 0}, {2, 1}}},
        {{0, 1, 0}, {0, 0, -1}, {{2, 1}, {1, 1}, {1, 2}}},
        {{0, -1, 0}, {0, 0, 1}, {{2, 1}, {1, 1}, {1, 0}}},
        {{0, 0, 1}, {1, 0, 0}, {{1, 0}, {0, 1}, {1, 1}}},
    };
    for (const View& view : views)
        for (const bool ortho : {true, false}) {
            const dvec3 eye = 8.0 + 60.0 * view.eye;
            const Look look(scene(), ortho ? parallel(eye, dvec3(8), 15, {3, 3}, view.up)
                                           : perspective(eye, dvec3(8), 14, {3, 3}, view.up));
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < 3; ++y)
                    for (int x = 0; x < 3; ++x)
                        EXPECT_EQ(look.colour(x, y)[c] > 0.5, ivec2(x, y) == view.places[c])
                            << "colour " << c << " at " << x << " " << y << " from " << view.eye.x
                            << " " << view.eye.y << " " << view.eye.z;
        }
}

TEST(ViewCamera, RaysGoThroughPixelCentres) {
    const dvec3 eye(3, 5, 40), target(8, 8, 8);
    const dvec3 forward = glm::normalize(target - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
    const dvec3 up = glm::cross(right, forward);
    const ivec2 size(6, 4);
    for (const bool ortho : {true, false}) {
        const Look look(emptiness(), ortho ? parallel(eye, target, 10, size)
                                           : perspective(eye, target, 20, size));
        const double half = ortho ? 5 : std::tan(kPi / 18);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                // 4 rows of 2·half/4: square pixels.
                const dvec3 offset = half * ((x - 2.5) / 2 * right - (y - 1.5) / 2 * up);
                const dvec3 start = ortho ? eye + offset : eye;
                const dvec3 d = ortho ? forward : glm::normalize(forward + offset);
                expectNear(look.direction(x, y), d, 1e-6); // floats
                // The exit lies on the ray, on a face, and beyond the middle.
                const dvec3 p = look.place(x, y);
                const double t = glm::dot(p - start, d);
                EXPECT_LT(glm::length(p - start - t * d), 1e-5); // floats of 16 voxels
                EXPECT_NEAR(std::max({std::abs(p.x - 8), std::abs(p.y - 8), std::abs(p.z - 8)}), 8,
                            1e-5); // as above
                EXPECT_GT(glm::dot(p - dvec3(8), d), 0);
                EXPECT_NEAR(look.at("Z", x, y), glm::dot(p - eye, forward), 1e-4); // of 50
                EXPECT_EQ(look.at("A", x, y), 0);
                EXPECT_EQ(look.at("transmittance.R", x, y), 1);
            }
    }
}

TEST(ViewCamera, ARayThatMissesKeepsItsOriginAndDirection) {
    const dvec3 eye(8, 100, 40), target(8, 100, 8);
    for (const bool ortho : {true, false}) {
        Params params =
            ortho ? parallel(eye, target, 10, {3, 3}) : perspective(eye, target, 20, {3, 3});
        params.background = {1, 2, 3};
        const Look look(emptiness(ivec3(16), 1.5), params);
        EXPECT_EQ(look.counter("rays"), 0);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) {
                const double step = 10.0 / 3;
                const dvec3 start = ortho ? eye + dvec3((x - 1) * step, (1 - y) * step, 0) : eye;
                expectNear(look.place(x, y), start, 1e-5); // floats of a hundred
                if (ortho) expectNear(look.direction(x, y), {0, 0, -1}, 1e-6);
                for (const char* name : {"path_length.V", "optical_path_length.V", "steps.V", "A"})
                    EXPECT_EQ(look.at(name, x, y), 0) << name;
                EXPECT_NEAR(look.at("error.V", x, y), 0, 1e-6); // a direction's length, in floats
                expectNear(look.colour(x, y), {1, 2, 3}, 1e-6); // n² / n², as above
            }
    }
}

TEST(ViewCamera, TheEyeMayStandAnywhere) {
    const auto glow = [] {
        TestVolume scene(ivec3(16));
        scene.constantVector("emission", dvec3(0.01));
        return scene.take();
    };
    const double inSixteen = 0.16 * 1e-5; // floats over some tens of steps
    const auto lookAlong = [&](const dvec3& eye, const dvec3& target) {
        return Look(glow(), perspective(eye, target, 1));
    };
    // On a face looking in, and out; in a corner; at an edge's middle; inside.
    EXPECT_NEAR(lookAlong({8, 8, 16}, {8, 8, 0}).at("R"), 0.16, inSixteen);
    EXPECT_NEAR(lookAlong({8, 8, 16}, {8, 8, 30}).at("R"), 0, 1e-5); // rounding of the face
    EXPECT_NEAR(lookAlong({0, 0, 0}, {8, 8, 8}).at("R"), 0.16 * std::sqrt(3.0), 2 * inSixteen);
    EXPECT_NEAR(lookAlong({16, 8, 16}, {0, 8, 0}).at("R"), 0.16 * std::sqrt(2.0), 2 * inSixteen);
    EXPECT_NEAR(lookAlong({5, 6, 7}, {5, 6, 100}).at("R"), 0.09, inSixteen);
    // Far off the setup is in double: the picture does not jitter.
    for (const dvec3& way : {dvec3(0, 0, 1), dvec3(1, 0.1, -0.3)}) {
        const dvec3 eye = 8.0 + 1e6 * glm::normalize(way);
        const Params params = perspective(eye, dvec3(8), 12e-6 * 180 / kPi, {5, 5});
        const Look look(glow(), params);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 5; ++x) {
                const dvec3 forward = glm::normalize(-way);
                const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
                const dvec3 up = glm::cross(right, forward);
                const dvec3 d = look.place(x, y) - dvec3(8);
                // The viewing axis in floats is off by 6e-8 of 1e6; from pixel to pixel the place
                // must be right to the eye's two floats, 1e6 · 2^-48, and the view's own, 6e-8
                // of 6.
                expectNear({glm::dot(d, right), glm::dot(d, up), 0},
                           {(x - 2) * 12.0 / 5, (2 - y) * 12.0 / 5, 0}, 0.06);
                const dvec3 step = look.place(x, y) - look.place(2, 2);
                expectNear({glm::dot(step, right), glm::dot(step, up), 0},
                           {(x - 2) * 12.0 / 5, (2 - y) * 12.0 / 5, 0}, 2e-4);
            }
    }
}

TEST(ViewCamera, ATurnedSceneSeenByATurnedCameraLooksTheSame) {
    const glm::dmat4 placed = glm::rotate(glm::translate(glm::dmat4(1), dvec3(30, -20, 3)), 0.9,
                                          glm::normalize(dvec3(1, -2, 0.5)));
    const auto scene = [](const glm::dmat4& where) {
        TestVolume out(ivec3(16), 0.5, where);
        out.index([](dvec3 p) { return 1.2 + 0.1 * std::sin(p.x) + 0.05 * p.y / (1 + p.z); });
        out.addVector("absorption", [](dvec3 p) { return dvec3(0.01, 0.02, 0.01) * p.x; });
        out.constantVector("scattering", {0.05, 0.1, 0.15});
        out.constant("anisotropy", 0.6);
        out.addVector("fluence", [](dvec3 p) { return dvec3(1 + p.y); });
        out.addVector("light_direction",
                      [&](dvec3 p) { return glm::dmat3(where) * dvec3(0.7, -0.1 * p.z / 8, 0.5); });
        return out.take();
    };
    const auto moved = [&](const dvec3& p) { return dvec3(placed * glm::dvec4(p, 1)); };
    const dvec3 eye(12, 5, 15), target(4, 4, 4), up(0, 1, 0);
    const ivec2 size(12, 8);
    const Look still(scene(glm::dmat4(1)), perspective(eye, target, 40, size, up));
    const Look turned(scene(placed),
                      perspective(moved(eye), moved(target), 40, size, glm::dmat3(placed) * up));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            // Floats over some thirty curved steps.
            expectNear(turned.colour(x, y), still.colour(x, y), 1e-4 * still.at("R", x, y) + 1e-6);
            expectNear(turned.place(x, y), moved(still.place(x, y)), 1e-3);
            expectNear(turned.direction(x, y), glm::dmat3(placed) * still.direction(x, y), 1e-4);
        }
}

TEST(ViewCamera, TheHeaderTellsWhereAPointIsSeen) {
    for (const bool ortho : {true, false}) {
        const Params params = ortho ? parallel({3, 5, 40}, dvec3(8), 10, {6, 4})
                                    : perspective({3, 5, 40}, dvec3(8), 20, {6, 4});
        image::ImageAttributes attributes;
        describeCamera(params.camera, attributes);
        const Look look(emptiness(), params);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) {
                // Where the ray of a pixel left is seen in that pixel's centre.
                const glm::dvec4 clip = attributes.worldToNDC * glm::dvec4(look.place(x, y), 1);
                EXPECT_NEAR(clip.x / clip.w, (x + 0.5) / 6, 1e-5); // floats of 40 voxels
                EXPECT_NEAR(clip.y / clip.w, (y + 0.5) / 4, 1e-5); // as above
            }
    }
}
