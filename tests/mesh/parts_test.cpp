// Objects of a file come apart where each is whole, and stay together where only all are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sample_files.h"

#include <map>

namespace eikonal::mesh {
namespace {

/// An OBJ file that grows object by object.
class Obj {
public:
    Obj& add(const std::string& label, const TriangleMesh& mesh) {
        if (!label.empty()) mText += label + "\n";
        mText += coordinates(mesh, "v ") + indices(mesh, "f ", mNext);
        mNext += static_cast<unsigned>(mesh.points.size());
        return *this;
    }
    const std::string& text() const { return mText; }

private:
    std::string mText;
    unsigned mNext = 1;
};

class Parts : public MeshFileTest {
protected:
    /// Names and volumes of a file's objects, all of which are sound.
    std::map<std::string, double> partsOf(const Obj& obj) {
        std::map<std::string, double> found;
        for (const Part& part : readParts(write("a.obj", obj.text()))) {
            const MeshReport report = checkMesh(part.mesh);
            EXPECT_TRUE(report.boundsVolume()) << part.name;
            found[part.name] = report.volume;
        }
        return found;
    }
};
using Volumes = std::map<std::string, double>;

TriangleMesh cube(double half, double x = 0) {
    return moved(boxShape(glm::dvec3(-half), glm::dvec3(half)), {x, 0, 0});
}

/// Only the triangles from one to another; the points are all there.
TriangleMesh some(TriangleMesh mesh, size_t first, size_t last) {
    mesh.triangles = {mesh.triangles.begin() + std::ptrdiff_t(first),
                      mesh.triangles.begin() + std::ptrdiff_t(last)};
    return mesh;
}

TEST_F(Parts, ObjectsThatAreWholeComeApart) {
    const Volumes wanted{{"a", 8}, {"b 2", 64}, {"c", 1}};
    const auto with = [](const std::string& key) {
        return Obj()
            .add(key + " a", cube(1))
            .add(key + "  b  2", cube(2, 9))
            .add(key + " c", cube(0.5, -9));
    };
    EXPECT_EQ(partsOf(with("o")), wanted);
    EXPECT_EQ(partsOf(with("g")), wanted);
    // Where there are objects, groups are parts of them.
    EXPECT_EQ(partsOf(Obj().add("o a\ng x", cube(1)).add("g y", cube(2, 9))), (Volumes{{"", 72}}));
    EXPECT_EQ(partsOf(Obj().add("o a", cube(1)).add("o b", cube(1, 9)).add("o a", cube(1, 20))),
              (Volumes{{"a", 16}, {"b", 8}}));
}

TEST_F(Parts, OneOrNoneIsTheFile) {
    EXPECT_EQ(partsOf(Obj().add("", cube(1)).add("", cube(1, 9))), (Volumes{{"", 16}}));
    EXPECT_EQ(partsOf(Obj().add("o only", cube(1))), (Volumes{{"", 8}}));
    EXPECT_EQ(partsOf(Obj().add("o empty\no only", cube(1))), (Volumes{{"", 8}}));
    EXPECT_EQ(partsOf(Obj().add("", cube(1)).add("o named", cube(1, 9))),
              (Volumes{{"part 1", 8}, {"named", 8}}));
}

TEST_F(Parts, WhatIsClosedOnlyTogetherStaysTogether) {
    const TriangleMesh ball = cube(2);
    Obj sides;
    for (size_t i = 0; i < 6; ++i)
        sides.add("g side" + std::to_string(i), some(ball, 2 * i, 2 * i + 2));
    EXPECT_EQ(partsOf(sides), (Volumes{{"", 64}}));
    sides.add("g other", cube(1, 9));
    EXPECT_EQ(partsOf(sides), (Volumes{{"side0", 64}, {"other", 8}}));
    // A lid on a box that another object touches: the edges they share are open in lid and box.
    Obj jar;
    jar.add("o jar", some(ball, 2, 12)).add("o on top", moved(cube(2), {0, 0, 4}));
    jar.add("o lid", some(ball, 0, 2));
    EXPECT_EQ(partsOf(jar), (Volumes{{"jar", 64}, {"on top", 64}}));
}

TEST_F(Parts, ObjectsThatTouchComeApart) {
    // They share a side, point by point.
    EXPECT_EQ(partsOf(Obj().add("o a", cube(1)).add("o b", cube(1, 2))),
              (Volumes{{"a", 8}, {"b", 8}}));
    EXPECT_EQ(partsOf(Obj().add("o glass", cube(2)).add("o same", cube(2))),
              (Volumes{{"glass", 64}, {"same", 64}}));
}

TEST_F(Parts, ACavityBelongsToWhatIsAroundIt) {
    Obj glass;
    glass.add("o inner", turnedInsideOut(cube(2))).add("o room", cube(9)).add("o outer", cube(3));
    glass.add("o wine", cube(1));
    EXPECT_EQ(partsOf(glass), (Volumes{{"inner", 216 - 64}, {"room", 5832}, {"wine", 8}}));
    // One that lies in nothing is inside out, and so it is said to be.
    const auto parts = readParts(
        write("b.obj", Obj().add("o a", cube(1)).add("o b", turnedInsideOut(cube(1, 9))).text()));
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_FALSE(checkMesh(parts[1].mesh).boundsVolume());
}

TEST_F(Parts, OpenOnesStayAloneAndOpen) {
    const auto parts = readParts(write(
        "a.obj", Obj().add("o whole", cube(1)).add("o open", some(cube(1, 9), 1, 12)).text()));
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_TRUE(checkMesh(parts[0].mesh).boundsVolume());
    EXPECT_EQ(checkMesh(parts[1].mesh).boundaryEdges, 3u);
}

} // namespace
} // namespace eikonal::mesh
