// Every format written here and read back, and files that must be refused with a reason.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sample_files.h"

namespace eikonal::mesh {
namespace {

using Read = MeshFileTest;

TEST_F(Read, ObjInItsManySpellings) {
    const TriangleMesh mesh = sample();
    expectSample(readMesh(write("a.obj", coordinates(mesh, "v ") + indices(mesh, "f ", 1))));
    // Upper-case extension, Windows line ends, tabs, textures, normals, comments, groups; quads
    // that count backwards, one of them on two lines.
    expectSample(readMesh(
        write("b.OBJ", "# a box\r\nmtllib x.mtl\r\no box\r\n" + coordinates(mesh, "v\t") +
                           "vt 0 0\nvn 0 0 1\nusemtl glass\nf 1/1/1\t3/1/1\t4/1/1 2/1/1 # back\n"
                           "f -4//1 -3//1 -1//1 -2//1\nf 1 2 \\\n 6 5\nf 3/1 7/1 8/1 4/1\n"
                           "f 1 5 7 3\nl 1 2\nf 2 4 8 6\n")));
}

TEST_F(Read, Off) {
    const TriangleMesh mesh = sample();
    const std::string points = coordinates(mesh, ""), faces = indices(mesh, "3 ", 0);
    expectSample(readMesh(write("a.off", "OFF\n8 12 0\n" + points + faces)));
    expectSample(readMesh(write("b.off", "# box\nOFF 8 12 0 # counts\n\n" + points + faces)));
    std::string coloured = "COFF\n8 6 0\n";
    for (const glm::dvec3& p : mesh.points) {
        std::ostringstream line;
        line << p.x << ' ' << p.y << ' ' << p.z << " 255 0 0 255\n";
        coloured += line.str();
    }
    coloured += "4 0 2 3 1 255 0 0\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5";
    expectSample(readMesh(write("c.off", coloured)));
}

TEST_F(Read, PlyInThreeForms) {
    const TriangleMesh mesh = sample();
    expectSample(
        readMesh(write("a.ply", asciiPly() + coordinates(mesh, "") + indices(mesh, "3 ", 0))));
    expectSample(readMesh(write("little.ply", binaryPly(false))));
    expectSample(readMesh(write("big.ply", binaryPly(true))));
}

TEST_F(Read, StlOfBothKindsMergesItsPoints) {
    expectSample(readMesh(write("a.stl", asciiStl())));
    expectSample(readMesh(write("b.stl", binaryStl("made by a test"))));
    expectSample(readMesh(write("c.STL", binaryStl("solid but binary"))));
}

TEST_F(Read, WhatIsNotThereIsMissing) {
    EXPECT_THROW(readMesh((folder / "none.obj").string()), MissingError);
    std::filesystem::create_directory(folder / "folder.obj");
    EXPECT_THROW(readMesh((folder / "folder.obj").string()), MissingError);
}

TEST_F(Read, RefusesOtherExtensionsAndEmptyFiles) {
    EXPECT_NE(refusal("a.fbx", "x").find("'.fbx'"), std::string::npos);
    EXPECT_NE(refusal("plain", "x").find("no extension"), std::string::npos);
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"})
        EXPECT_NE(refusal(name, "").find("empty file"), std::string::npos) << name;
}

TEST_F(Read, RefusesGarbageInEveryFormat) {
    std::string noise;
    for (unsigned i = 0; i < 5000; ++i) noise += static_cast<char>((i * i * 2654435761u) >> 13);
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
        EXPECT_NE(refusal(name, noise), "(read without complaint)") << name;
        EXPECT_NE(refusal(name, "once upon a time"), "(read without complaint)") << name;
        EXPECT_NE(refusal(name, "\n\n\n"), "(read without complaint)") << name;
    }
}

TEST_F(Read, SaysWhichLineAndWhat) {
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 nan 0\n").find("a.obj:2: found 'nan'"),
              std::string::npos);
    EXPECT_NE(refusal("a.obj", "v 1 2\n").find("the end of the line"), std::string::npos);
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nf 1 x 2\n").find("a.obj:2: found 'x'"), std::string::npos);
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nf 0 1 1\n").find("counted from 1"), std::string::npos);
    EXPECT_NE(refusal("a.off", "OFF\n1 1 0\n0 inf 0\n").find("a.off:3: found 'inf'"),
              std::string::npos);
    EXPECT_NE(refusal("a.stl", "solid\nfacet\nvertex 0 1e999 0\n").find("a.stl:3"),
              std::string::npos);
}

TEST_F(Read, RefusesIndicesOutOfRangeAndFacesTooSmall) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_NE(refusal("a.obj", three + "f 1 2 4\n").find("face 1 uses point 4"), std::string::npos);
    EXPECT_NE(refusal("a.obj", three + "f 1 2 -4\n").find("expected 1 to 3"), std::string::npos);
    EXPECT_NE(refusal("a.obj", three + "f 1 2\n").find("has 2 corners"), std::string::npos);
    EXPECT_NE(refusal("a.obj", three).find("no faces"), std::string::npos);
    EXPECT_NE(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("uses point 4"),
              std::string::npos);
    EXPECT_NE(refusal("a.off", "OFF\n1 1 0\n0 0 0\n-3 0 0 0\n").find("has 0 corners"),
              std::string::npos);
}

TEST_F(Read, CountsThatLieCostNothing) {
    // Each promises more than any memory holds; the files are a few bytes long.
    EXPECT_NE(refusal("a.off", "OFF\n900000000000000 1 0\n0 0 0\n").find("end of the file"),
              std::string::npos);
    EXPECT_NE(refusal("a.off", "OFF\n1 1 0\n0 0 0\n900000000000 0 0 0\n").find("end of the line"),
              std::string::npos);
    std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
                      "property float y\nproperty float z\nelement hole 9000000000000000\n"
                      "element face 1\nproperty list uint int vertex_indices\nend_header\n";
    ply += rawBytes(std::uint32_t(0xffffffff));
    EXPECT_NE(refusal("a.ply", ply).find("end of the file"), std::string::npos);
    EXPECT_NE(refusal("a.stl", std::string(80, ' ') + rawBytes(std::uint32_t(0xffffffff)))
                  .find("214748364834"), // 84 + 50 (2^32 - 1) bytes
              std::string::npos);
}

TEST_F(Read, RefusesEveryTruncationOfAFile) {
    const TriangleMesh mesh = sample();
    const std::string off = "OFF\n8 12 0\n" + coordinates(mesh, "") + indices(mesh, "3 ", 0);
    for (size_t size = 1; size + 3 < off.size(); size += 7)
        EXPECT_NE(refusal("a.off", off.substr(0, size)), "(read without complaint)") << size;
    const std::string ply = binaryPly(false);
    for (size_t size = 1; size < ply.size(); size += 7)
        EXPECT_NE(refusal("a.ply", ply.substr(0, size)), "(read without complaint)") << size;
    for (const std::string& stl : {asciiStl(), binaryStl("box")})
        for (size_t size = 1; size + 5 < stl.size(); size += 7)
            EXPECT_NE(refusal("a.stl", stl.substr(0, size)), "(read without complaint)") << size;
}

TEST_F(Read, RefusesBinaryCoordinatesThatAreNoNumbers) {
    std::string stl = binaryStl("box");
    const std::string nan = rawBytes(std::numeric_limits<float>::quiet_NaN());
    stl.replace(84 + 50 * 4 + 12, 4, nan); // the fifth triangle's first coordinate
    EXPECT_NE(refusal("a.stl", stl).find("triangle 5"), std::string::npos);
    std::string ply = binaryPly(false);
    const size_t data = ply.find("end_header\n") + 11 + 2 * 3; // behind the extra elements
    ply.replace(data + 9, 4, nan);                             // the first vertex's y
    EXPECT_NE(refusal("a.ply", ply).find("vertex 1"), std::string::npos);
}

TEST_F(Read, PlyHeadsThatMissPartsAreRefused) {
    std::string noZ = asciiPly();
    noZ.erase(noZ.find("property int8 z\n"), 16);
    EXPECT_NE(refusal("a.ply", noZ).find("x, y and z"), std::string::npos);
    EXPECT_NE(refusal("a.ply", "ply\nformat ascii 1.0\nproperty float x\n").find("a.ply:3"),
              std::string::npos);
    EXPECT_NE(refusal("a.ply", "ply\nformat morse 1.0\n").find("'morse'"), std::string::npos);
}

} // namespace
} // namespace eikonal::mesh
