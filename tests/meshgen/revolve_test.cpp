// Profiles read, refused, and turned into bodies, against Pappus.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshgen/sound.h"
#include "shapes/outline_checks.h"
#include "shapes/revolve.h"
#include "support/scratch.h"

#include <numbers>

namespace eikonal {

using namespace shapes;
using std::numbers::pi;

class Revolve : public ScratchTest {
protected:
    mesh::TriangleMesh of(const std::string& text, int segments = 64) {
        putBytes("profile", text);
        return revolve(readProfile(at("profile"), 0), {segments, 0});
    }
    mesh::TriangleMesh ofPath(const std::string& d) {
        return of("<svg><path d=\"" + d + "\"/></svg>");
    }
    void refused(const std::vector<std::string>& words, const std::string& text) {
        SCOPED_TRACE(text);
        expectError(ExitStatus::data, words, [&] { of(text); });
    }
    void pathRefused(const std::vector<std::string>& words, const std::string& d) {
        refused(words, "<svg><path d=\"" + d + "\"/></svg>");
    }
    /// What the polygon of so many corners has of a circle's area.
    static double share(int segments) { return segments / (2 * pi) * std::sin(2 * pi / segments); }
};

TEST_F(Revolve, ACylinderOfAnOpenProfileEitherWay) {
    for (const char* text : {"1,0\n1,2\n", "1;2\n1;0", "0 0\n1 0\n1 2\n0 2\n",
                             "# a can\n\n0, 2 # top\r\n1, 2\r\n1, 0\r\n0, 0\r\n"}) {
        const auto body = of(text);
        EXPECT_NEAR(sound(body).volume, 2 * pi * share(64), 1e-12);
        EXPECT_EQ(eulerCharacteristic(body), 2);
    }
}

TEST_F(Revolve, ALoopOffTheAxisIsARing) {
    for (const char* text : {"2,0\n3,0\n3,1\n2,1\n2,0\n", "2,0\n2,1\n3,1\n3,0\n2,0\n"}) {
        const auto ring = of(text, 48);
        EXPECT_NEAR(sound(ring).volume, 5 * pi * share(48), 1e-12); // Pappus: 2π 2.5
        EXPECT_EQ(eulerCharacteristic(ring), 0);
    }
}

TEST_F(Revolve, ALoopAlongTheAxisIsABodyAroundIt) {
    for (const char* text : {"0,0\n1,0\n1,1\n0,1\n0,0\n", "1,1\n0,1\n0,0.5\n0,0\n1,0\n1,1\n"})
        EXPECT_NEAR(sound(of(text)).volume, pi * share(64), 1e-12);
    refused({"line 1", "the axis"}, "0,0\n1,-1\n1,1\n0,0\n");
}

TEST_F(Revolve, DrawingsReadAsTablesDo) {
    const double can = 2 * pi * share(64);
    for (const char* d : {"M0,5 L1,5 L1,7 L0,7", "m0 5h1v2H0", "M 0 5 1 5 1 7 0 7", "M0-1h1v2h-1",
                          "M0,5 l1,0 0,2 -1,0z", "M0 5C.3 5 .6 5 1 5Q1 6 1 7L0 7Z"})
        EXPECT_NEAR(sound(ofPath(d)).volume, can, 1e-12) << d;
    EXPECT_NEAR(sound(of("<svg><polyline points='0,0 1,0 1,2 0,2'/></svg>")).volume, can, 1e-12);
    EXPECT_NEAR(sound(of("<svg><polygon points='0,0 1,0 1,2 0,2'/></svg>")).volume, can, 1e-12);
    // Upward is up: a cone with its point at the top, standing on 0.
    const auto cone = ofPath("M0,10 L2,16 H0");
    EXPECT_NEAR(sound(cone).volume, 4 * pi / 3 * 6 * share(64), 1e-12);
    EXPECT_EQ(mesh::boundingBox(cone).min.y, 0);
    EXPECT_EQ(std::max_element(cone.points.begin(), cone.points.end(),
                               [](auto& a, auto& b) { return a.y < b.y; })
                  ->x,
              0);
}

TEST_F(Revolve, CurvesAreWithinTheirTolerance) {
    // A parabola as a conic: x² = y from (0, 0) to (1, 1), y downward.
    const auto bowl = ofPath("M0,0 Q0.5,0 1,1 H0");
    EXPECT_NEAR(sound(bowl).volume, pi / 2 * share(64), pi / 2 * 2e-3);
    // The same curve raised to a cubic.
    EXPECT_NEAR(sound(ofPath("M0,0 C0.333333333333,0 0.666666666667,0.333333333333 1,1 H0")).volume,
                pi / 2 * share(64), pi / 2 * 2e-3);
}

TEST_F(Revolve, CurvesGoOnSmoothly) {
    // The same parabola in two halves.
    for (const char* d : {"M0,0 C.166666666667,0 .333333333333,.083333333333 .5,.25 "
                          "S.833333333333,.666666666667 1,1 H0",
                          "M0,0 c.166666666667,0 .333333333333,.083333333333 .5,.25 "
                          "s.333333333333,.416666666667 .5,.75 H0",
                          "M0,0 Q.25,0 .5,.25 T1,1 H0", "M0,0 q.25,0 .5,.25 t.5,.75 H0"})
        EXPECT_NEAR(sound(ofPath(d)).volume, pi / 2 * share(64), pi / 2 * 2e-3) << d;
    // Behind a line there is nothing to go on from: a quadratic whose handle is its start is
    // straight.
    EXPECT_NEAR(sound(ofPath("M0,0 H1 T1,1 H0")).volume, pi * share(64), 1e-12);
    // Nor behind an arc, though it is made of cubics.
    EXPECT_NEAR(sound(ofPath("M0,0 A.5,.5 0 0 1 1,0 S2,0 2,0 V2 H0")).volume,
                sound(ofPath("M0,0 A.5,.5 0 0 1 1,0 L2,0 V2 H0")).volume, 1e-12);
}

TEST_F(Revolve, ACurveOfNoExtentIsAPoint) {
    EXPECT_NEAR(sound(ofPath("M0,0 C0,0 0,0 0,0 H1 V2 Q1,2 1,2 H0")).volume, 2 * pi * share(64),
                1e-12);
    refused({"1 point "}, "<svg><path d='M1,1 C1,1 1,1 1,1'/></svg>");
}

TEST_F(Revolve, ArcsAreOfTheirEllipse) {
    const double ball = 4 * pi / 3 * share(64), ring = 2 * pi * 3 * pi * share(64);
    // From the top to the bottom; radii that do not reach grow, signs of radii are nothing.
    for (const char* d : {"M0,0 A1,1 0 0 1 0,2", "M0,2 a1 1 0 000-2", "M0,0 A.2,.2 0 0 1 0,2",
                          "M0,0 A1e-200,1e-200 0 0 1 0,2", "M0,0 A-1,1 77 1 1 0,2"})
        EXPECT_NEAR(sound(ofPath(d)).volume, ball, 2e-3 * ball) << d;
    for (const char* d : {"M0,0 A3,1 0 0 1 0,2", "M0,0 A1,3 90 0 1 0,2", "M0,0 A1,3 -90 0 1 0,2"})
        EXPECT_NEAR(sound(ofPath(d)).volume, 9 * ball, 2e-3 * 9 * ball) << d;
    // Halves, then three quarters one way round or the other and the quarter that is left.
    for (const char* d :
         {"M2,0 A1,1 0 0 1 4,0 a1 1 0 01-2 0Z", "M3,-1 A1,1 0 1 1 2,0 A1,1 0 0 1 3,-1",
          "M3,-1 A1,1 0 1 0 4,0 A1,1 0 0 0 3,-1"})
        EXPECT_NEAR(sound(ofPath(d)).volume, ring, 4e-3 * ring) << d;
    // Without a radius it is a line, between one point and itself nothing.
    EXPECT_NEAR(sound(ofPath("M0,0 H1 A0,1 0 0 1 1,2 A1,1 0 0 1 1,2 H0")).volume,
                2 * pi * share(64), 1e-12);
}

TEST_F(Revolve, WhatIsNotDrawnIsPassedOver) {
    const auto body = of("<?xml version='1.0'?><!-- <path d='M0 0'/> --><svg><title>a > b</title>"
                         "<defs><g><path d='M9 9L9 9'/></g></defs><g id='x'><circle r='1'/>"
                         "<path id=\"a>b\" style='d:1' d = \"M0,0 H1 V2 H0\"/></g></svg>");
    EXPECT_NEAR(sound(body).volume, 2 * pi * share(64), 1e-12);
    refused({"transform"}, "<svg><g transform='scale(2)'><path d='M0,0 H1 V2'/></g></svg>");
    refused({"no path"}, "<svg><rect/></svg>");
    refused({"without d"}, "<svg><path/></svg>");
}

TEST_F(Revolve, BadProfilesAreRefusedByPlace) {
    refused({"line 2", "radius of -1"}, "1,0\n-1,1\n");
    refused({"line 3", "'x 1'"}, "1,0\n1,1\nx,1\n");
    refused({"line 1", "expected a radius and a height"}, "1,0,3\n1,1\n");
    refused({"line 2"}, "1,0\n1,inf\n");
    refused({"0 points"}, "# nothing\n");
    refused({"0 points"}, "");
    refused({"1 point "}, "1,0\n1,0\n");
    refused({"meets itself", "line 1", "line 3"}, "0,0\n2,2\n2,0\n1,2\n0,2\n");
    refused({"meets itself"}, "1,0\n1,2\n1,1\n"); // back over itself
    refused({"encloses nothing"}, "0,0\n0,1\n");
    refused({"meets itself"}, "0,1\n1,1\n"); // back along the disc that closes it
    refused({"line 3", "axis"}, "1,0\n1,1\n0,1.5\n1,2\n1,3\n");
    pathRefused({"character 6", "'B'"}, "M0,0 B1,1");
    pathRefused({"character 13", "'2'", "a flag"}, "M0,0 A1,1 0 2 1 2,2");
    pathRefused({"beyond 1e+100"}, "M0,0 H1e101 V1");
    pathRefused({"the end", "a flag"}, "M0,0 A1,1 0 ");
    pathRefused({"character 1", "'L'", "M first"}, "L0,0");
    pathRefused({"character 7", "'x'", "a number"}, "M0,0 Lx");
    pathRefused({"a second 'M'"}, "M0,0 H1 V1 M2,2");
    pathRefused({"behind Z"}, "M0,0 H1 V1 Z L3,3");
    pathRefused({"the end", "a number"}, "M0,0 C1,1");
    pathRefused({"the end", "lines or curves"}, "M0,0");
    pathRefused({"part 2", "radius of -1"}, "M0,0 H1 L-1,1");
    expectError(ExitStatus::missing, {"absent"}, [&] { readProfile(at("absent"), 0); });
}

TEST(Outline, FindsOneCrossingAmongMany) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 4000; ++i) {
        const double a = 2 * pi * i / 4000;
        points.push_back({2 + std::cos(a), std::sin(a)});
    }
    EXPECT_FALSE(selfCrossing(points, true));
    EXPECT_NEAR(enclosedArea(points), pi, 1e-5);
    std::swap(points[1000], points[1001]);
    EXPECT_TRUE(selfCrossing(points, true));
}

} // namespace eikonal
