// Letters: outlines filled, holes kept, overlaps made one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fill_loops.h"
#include "meshgen/sound.h"
#include "shapes/logo.h"
#include "support/scratch.h"

namespace eikonal {

using namespace shapes;

double areaOf(const mesh::FilledLoops& filled) {
    double area = 0;
    for (const glm::uvec3& t : filled.triangles) {
        const glm::dvec2 a = filled.points[t.y] - filled.points[t.x],
                         b = filled.points[t.z] - filled.points[t.x];
        EXPECT_GT(a.x * b.y - a.y * b.x, 0);
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

std::vector<glm::dvec2> square(double low, double high, bool turned = false) {
    std::vector<glm::dvec2> s = {{low, low}, {high, low}, {high, high}, {low, high}};
    if (turned) std::reverse(s.begin(), s.end());
    return s;
}

TEST(FillLoops, HolesOverlapsIslands) {
    EXPECT_DOUBLE_EQ(areaOf(mesh::fillLoops({square(0, 2)})), 4);
    EXPECT_DOUBLE_EQ(areaOf(mesh::fillLoops({square(0, 2, true)})),
                     4); // PostScript's fonts turn so
    EXPECT_DOUBLE_EQ(areaOf(mesh::fillLoops({square(0, 3), square(1, 2, true)})), 8);
    EXPECT_DOUBLE_EQ(areaOf(mesh::fillLoops({square(0, 3), square(1, 2)})), 9);
    const auto crossing = mesh::fillLoops({square(0, 2), square(1, 3)});
    EXPECT_DOUBLE_EQ(areaOf(crossing), 7);
    EXPECT_EQ(crossing.sides.size(), 8u);
    EXPECT_DOUBLE_EQ(areaOf(mesh::fillLoops({square(0, 5), square(1, 4, true), square(2, 3)})), 17);
    EXPECT_TRUE(mesh::fillLoops({}).triangles.empty());
}

TEST(Logo, AnIIsABoxAnOAHole) {
    LogoParams params;
    params.text = "I";
    params.height = 2;
    params.depth = 0.5;
    const auto box = makeLogo(params);
    const mesh::Box extent = mesh::boundingBox(box);
    const glm::dvec3 size = extent.max - extent.min;
    EXPECT_NEAR(size.y, 2, 1e-12);
    EXPECT_NEAR(size.z, 0.5, 1e-12);
    EXPECT_NEAR(extent.min.x, -extent.max.x, 1e-12);
    EXPECT_NEAR(sound(box).volume, size.x * size.y * size.z, 1e-12);
    params.text = "O";
    const auto ring = makeLogo(params);
    sound(ring);
    EXPECT_EQ(eulerCharacteristic(ring), 0);
    params.text = "B";
    const auto two = makeLogo(params);
    sound(two);
    EXPECT_EQ(eulerCharacteristic(two), -2);
}

TEST(Logo, EveryLetterIsSound) {
    LogoParams params;
    for (const char* text : {"ABCDEFGHIJKLMNOPQRSTUVWXYZ", "abcdefghijklmnopqrstuvwxyz",
                             "0123456789 .,:;!?&%@#$()[]{}+-*/=", "ÄÖÜäöüßéèçñ Ωπ∇"}) {
        params.text = text;
        SCOPED_TRACE(text);
        sound(makeLogo(params));
    }
    params.text = "Eikonal";
    EXPECT_EQ(sound(makeLogo(params)).components, 8u); // the i has two
    params.text = "A";
    const double once = sound(makeLogo(params)).volume;
    params.text = "A A";
    EXPECT_NEAR(sound(makeLogo(params)).volume, 2 * once, 1e-12);
}

TEST(Logo, RefusesByName) {
    const auto refused = [](ExitStatus status, const std::vector<std::string>& words,
                            LogoParams params) {
        expectError(status, words, [&] {
            params.check();
            makeLogo(params);
        });
    };
    refused(ExitStatus::usage, {"U+4E2D", "DejaVuSans-Bold.ttf"}, {.text = "A中"});
    refused(ExitStatus::usage, {"byte 2", "UTF-8"}, {.text = "A\xff"});
    refused(ExitStatus::usage, {"' '", "letters"}, {.text = " "});
    refused(ExitStatus::usage, {"--depth"}, {.text = "A", .depth = 0});
    refused(ExitStatus::missing, {"absent.ttf"}, {.text = "A", .font = "absent.ttf"});
    refused(ExitStatus::data, {"FreeType"}, {.text = "A", .font = EIKONAL_SOURCE_DIR "/LICENSE"});
}

} // namespace eikonal
