// OBJ's materials.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/mtl.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace eikonal::scenefile {
namespace {

using Kind = Material::Kind;

Material only(const std::string& lines) {
    return readMtl("a.mtl", "newmtl stuff\n" + lines).materials.at(0);
}

TEST(Mtl, WhatLetsLightThrough) {
    for (const char* lines : {"d 0.1", "Tr 0.9", "illum 7", "Tf 0.5 1 1", "Tf 1 1 1\nPr 0"})
        EXPECT_EQ(only(lines).kind, Kind::glass) << lines;
    for (const char* lines : {"d 1", "Tr 0", "illum 2", "Tf 1 1 1", "Kd 1 0 0"})
        EXPECT_EQ(only(lines).kind, Kind::matt) << lines;
    const Material glass = only("Ni 1.62 # flint\nTf 0.2 0.4 0.6\nPr 0.5\n");
    EXPECT_EQ(glass.ior, 1.62);
    EXPECT_EQ(glass.colour, glm::dvec3(0.2, 0.4, 0.6));
    EXPECT_EQ(glass.roughness, 0.25);
}

TEST(Mtl, OpaqueOnes) {
    const Material metal = only("Kd 1 0.8 0.3\nPm 1\nPr 0");
    EXPECT_EQ(metal.kind, Kind::metal);
    EXPECT_EQ(metal.colour, glm::dvec3(1, 0.8, 0.3));
    const Material lamp = only("Kd 0 0 0\nKe 3 2 1");
    EXPECT_EQ(lamp.kind, Kind::glow);
    EXPECT_EQ(lamp.radiance, glm::dvec3(3, 2, 1));
    EXPECT_EQ(only("Kd 0.5").colour, glm::dvec3(0.5));
}

TEST(Mtl, NamesWithBlanksAndWhatIsNotUnderstood) {
    const Materials found =
        readMtl("a.mtl", "# by hand\r\nnewmtl green glass\r\nKs 1 1 1\r\nmap_Kd a.png\r\n"
                         "Pc 0\r\nKs 1 1 1\r\nnewmtl other\r\n");
    ASSERT_EQ(found.materials.size(), 2u);
    EXPECT_EQ(found.materials[0].name, "green glass");
    EXPECT_EQ(found.unknown, (std::vector<std::string>{"Ks", "map_Kd"}));
}

TEST(Mtl, RefusesWhatIsNoNumberOrOutOfRange) {
    for (const char* lines : {"Ni", "Ni glass", "Ni -1", "Kd 2 0 0", "Pr nan", "d 1.5"})
        EXPECT_THROW(only(lines), DataError) << lines;
    EXPECT_THROW(readMtl("a.mtl", "Kd 1 1 1"), DataError);
}

} // namespace
} // namespace eikonal::scenefile
