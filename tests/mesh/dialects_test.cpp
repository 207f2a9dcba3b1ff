// Files as programs write them beside what the formats say: read, or refused by their fault's name.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sample_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace eikonal::mesh {
namespace {

using Dialects = MeshFileTest;

const std::string kMark = "\xef\xbb\xbf"; // byte order mark

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    for (size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
        text.replace(at, old.size(), by);
    return text;
}

std::string obj() {
    return coordinates(sample(), "v ") + indices(sample(), "f ", 1);
}
std::string off(const std::string& head) {
    return head + coordinates(sample(), "") + indices(sample(), "3 ", 0);
}
std::string ply() {
    return asciiPly() + coordinates(sample(), "") + indices(sample(), "3 ", 0);
}

struct Text {
    std::string name, bytes;
};
std::vector<Text> texts() {
    return {
        {"a.obj", obj()}, {"a.off", off("OFF\n8 12 0\n")}, {"a.ply", ply()}, {"a.stl", asciiStl()}};
}

TEST_F(Dialects, LinesMayEndInAnyWay) {
    for (const Text& text : texts())
        for (const std::string end : {"\r", "\r\n", "\r\r\n", "\n\n", "\n\r"}) {
            SCOPED_TRACE(text.name + " " + std::to_string(end.size()) + " " +
                         std::to_string(int(end[0])));
            expectSample(readMesh(write(text.name, replaced(text.bytes, "\n", end))));
        }
    // Binary data behind a head of every kind, its first byte a line feed.
    std::string binary =
        replaced(binaryPly(false), "element extra 2\nproperty list uint8 int16 junk",
                 "element extra 1\nproperty uint8 junk");
    const size_t data = binary.find("end_header\n") + 11;
    binary.replace(data, 6, "\n");
    for (const std::string end : {"\n", "\r", "\r\n"})
        expectSample(readMesh(
            write("a.ply", replaced(binary.substr(0, data), "\n", end) + binary.substr(data))));
}

TEST_F(Dialects, AByteOrderMarkHidesNothing) {
    for (const Text& text : texts()) {
        expectSample(readMesh(write(text.name, kMark + text.bytes)));
        expectSample(readMesh(write(text.name, kMark + "\n" + text.bytes)));
    }
    // Files put one behind the other have one in the middle: the point behind it counts.
    const std::string points = coordinates(sample(), "v ");
    const size_t middle = points.find("v ", 20);
    expectSample(readMesh(write("a.obj", points.substr(0, middle) + kMark + points.substr(middle) +
                                             kMark + indices(sample(), "f ", 1))));
    // Anything else that can't be seen is named: it would take a point with it.
    for (const std::string hidden : {"\xc2\xa0", "\xe2\x80\x8b", "\x01", "\x7f"})
        EXPECT_NE(refusal("a.obj", hidden + obj()).find(":1: found '"), std::string::npos);
    for (const std::string wide : {"\xff\xfe", "\xfe\xff"})
        EXPECT_NE(refusal("a.obj", wide + "v").find("UTF-16"), std::string::npos);
}

TEST_F(Dialects, ObjLinesGoOnBehindABackslash) {
    for (const std::string broken : {" \\\n", "\\\n ", " \\\n\\\n ", " \\\r\n"})
        expectSample(readMesh(write("a.obj", replaced(obj(), " ", broken))));
    expectSample(readMesh(write("b.obj", "# no \\\n" + replaced(obj(), "\n", " # \\\n"))));
    EXPECT_NE(refusal("c.obj", obj() + "v 1 2 \\").find("the rest of a line"), std::string::npos);
    EXPECT_NE(refusal("c.obj", obj() + "g a \\\n").find("the rest of a line"), std::string::npos);
}

TEST_F(Dialects, OffHeads) {
    for (const std::string head : {"OFF8 12 0\n", "OFF 8 12\n", "8 12 0\n", "# a box\n8 12\n",
                                   "COFF8 12 0\n", "STCNOFF\n8 12 0\n", "OFF\n\n# x\n8 12\n"})
        expectSample(readMesh(write("a.off", off(head))));
    EXPECT_NE(refusal("a.off", off("4OFF\n8 12 0\n")).find("'4OFF'"), std::string::npos);
    EXPECT_NE(refusal("a.off", off("OFFx 8 12 0\n")).find("'OFFx'"), std::string::npos);
    EXPECT_NE(refusal("a.off", off("OFF BINARY\n8 12 0\n")).find("ASCII form"), std::string::npos);
    EXPECT_NE(refusal("a.off", "8 x\n").find("'x'"), std::string::npos);
}

TEST_F(Dialects, PlyPropertiesOfNoInterestMayBeAnything) {
    std::string head = replaced(asciiPly(), "element face", "property float nx\nelement face");
    head = replaced(head, "vertex_indices\n", "vertex_indices\nproperty float quality\n");
    std::ostringstream body;
    for (const glm::dvec3& p : sample().points)
        body << p.x << ' ' << p.y << ' ' << p.z << " -nan(ind)\n";
    for (const glm::uvec3& f : sample().triangles)
        body << "3 " << f.x << ' ' << f.y << ' ' << f.z << " inf\n";
    expectSample(readMesh(write("a.ply", head + body.str())));
    EXPECT_NE(
        refusal("a.ply", replaced(head + body.str(), "0 0.5 -1", "nan 0.5 -1")).find("vertex"),
        std::string::npos);
    for (const std::string count : {"-1", "2.5", "nan", "1e300"})
        EXPECT_NE(refusal("a.ply", asciiPly() + coordinates(sample(), "") + count + " 0 1 2\n"),
                  "(read without complaint)");
}

/// The sample's quads, as strips of four corners.
std::string strips(const std::string& apart) {
    const int quads[6][4] = {{0, 2, 1, 3}, {4, 5, 6, 7}, {0, 1, 4, 5},
                             {2, 6, 3, 7}, {0, 4, 2, 6}, {1, 3, 5, 7}};
    std::string list;
    for (const auto& quad : quads) {
        for (const int corner : quad) list += std::to_string(corner) + " ";
        list += apart + " ";
    }
    return list;
}

std::string stripHead(int lists) {
    const std::string head = asciiPly();
    return head.substr(0, head.find("element face")) + "element tristrips " +
           std::to_string(lists) + "\nproperty list int int vertex_indices\nend_header\n" +
           coordinates(sample(), "");
}

TEST_F(Dialects, PlyTriangleStrips) {
    expectSample(readMesh(write("a.ply", stripHead(1) + "30 " + strips("-1"))));
    std::string lists = "4 " + strips("\n4"); // one for each side
    lists.resize(lists.rfind('4'));
    expectSample(readMesh(write("b.ply", stripHead(6) + lists)));
    // The first two sides in one strip, joined by triangles of no area: a corner more, and the
    // second would run the other way round.
    const std::string rest = strips("-1").substr(22);
    expectSample(readMesh(write("c.ply", stripHead(1) + "31 0 2 1 3 3 4 4 5 6 7 -1 " + rest)));
    EXPECT_NE(refusal("d.ply", stripHead(1) + "3 0 1 8").find("point 9"), std::string::npos);
    EXPECT_NE(refusal("d.ply", stripHead(1) + "2 0 1").find("no faces"), std::string::npos);
}

TEST_F(Dialects, StlWhoseSizeAndCountDisagree) {
    for (const std::string title : {"streamed", "solid part"}) {
        std::string stl = binaryStl(title);
        for (const size_t tail : {1, 2, 49, 51, 120})
            expectSample(readMesh(write("a.stl", stl + std::string(tail, '\0'))));
        // Whole triangles beyond the count: which of the two is right, nobody knows.
        EXPECT_NE(refusal("a.stl", stl + std::string(100, '\0')).find("found 14 triangles"),
                  std::string::npos);
        for (const std::uint32_t unset : {0u, 0xffffffffu}) {
            stl.replace(80, 4, rawBytes(unset));
            expectSample(readMesh(write("b.stl", stl)));
        }
        stl.replace(80, 4, rawBytes(std::uint32_t(13)));
        EXPECT_NE(refusal("b.stl", stl).find("at least 734"), std::string::npos);
    }
}

TEST_F(Dialects, StreamsAndOtherNamesAreToldByTheirContent) {
    std::vector<std::string> files = {
        off("# box\nCOFF\n8 12 0\n"),  off("8 12 0\n"),      binaryPly(true), binaryStl("a title"),
        binaryStl("solid but binary"), "# by hand\n" + obj()};
    for (const Text& text : texts()) {
        files.push_back(text.bytes);
        files.push_back(kMark + text.bytes);
    }
    for (const std::string& bytes : files) {
        SCOPED_TRACE(bytes.substr(0, 20));
        expectSample(readMesh(write("plain", bytes)));
        expectSample(readMesh(write("mesh.part", bytes)));
        ASSERT_EQ(::mkfifo(at("fifo").c_str(), 0600), 0);
        std::thread writer([&] {
            const int file = ::open(at("fifo").c_str(), O_WRONLY);
            EXPECT_EQ(::write(file, bytes.data(), bytes.size()), ssize_t(bytes.size()));
            ::close(file);
        });
        expectSample(readMesh(at("fifo")));
        writer.join();
        ::unlink(at("fifo").c_str());
    }
    for (const std::string& foreign :
         {std::string("\x1f\x8b\x08\0\0\0", 6), std::string("PK\x03\x04"),
          std::string("\xfd") + "7zXZ" + std::string(200, '\0')})
        for (const char* name : {"plain", "a.obj", "a.stl"})
            EXPECT_EQ(refusal(name, foreign).find("(read"), std::string::npos) << name;
    EXPECT_NE(refusal("a.ply", "\x1f\x8b\x08").find("gzip"), std::string::npos);
    EXPECT_NE(refusal("a.vdb", " BDV" + std::string(200, '\0')).find("VDB"), std::string::npos);
}

} // namespace
} // namespace eikonal::mesh
