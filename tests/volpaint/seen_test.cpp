// Painted glass as the other tools see it: what a slab lets through against sums over its voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"
#include "support/scratch.h"
#include "support/tool.h"
#include "volume/volume.h"

#include <cmath>
#include <glm/glm.hpp>

namespace eikonal {

class Seen : public ScratchTest {
protected:
    void command(const std::string& line) {
        const Ran ran = run(line, folder);
        ASSERT_EQ(ran.status, 0) << line << "\n" << ran.said;
    }
};

/// The grid at a place, linear between voxels, in color R.
double linearAt(const volume::DenseGrid& grid, const glm::dvec3& x) {
    const glm::dvec3 low = glm::floor(x), t = x - low;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2), p = glm::ivec3(low) + d;
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= d[axis] ? t[axis] : 1 - t[axis];
        const auto voxel = static_cast<size_t>((p.z * grid.size.y + p.y) * grid.size.x + p.x);
        sum += weight * static_cast<double>(grid.values[voxel * 3]);
    }
    return sum;
}

TEST_F(Seen, APaintedSlabDimsByTheSumOfItsVoxels) {
    command("meshgen box -o slab.obj");
    command("mesh2vol slab.obj -o slab.vdb --ior 1 --absorption 1.5 --smooth 0 --resolution 40");
    command("volpaint slab.vdb -o painted.vdb --object slab --noise absorption:0.9:0.35:2 "
            "--sphere absorption:0.1,0.15,-0.2:0.3:3");
    command("render painted.vdb -o seen.exr --eye 0,0,3 --target 0,0,0 --ortho 0.8 --size 16x16 "
            "--aov transmittance");
    // Light that goes the same way, 1 W/m², stored where it has come through.
    command("lightsim painted.vdb -o lit.vdb --light directional:0,0,-1:1 --outputs fluence "
            "--photons 65536 --smoothing 0");

    const volume::Volume painted = volume::Volume::open(at("painted.vdb"));
    const volume::Volume lit = volume::Volume::open(at("lit.vdb"));
    const auto grid = painted.dense("absorption.slab", painted.domain());
    const auto fluence = lit.dense("fluence", painted.domain());
    const image::Image seen = image::readExr(at("seen.exr"));
    const auto through = seen.plane(seen.find("transmittance.R").value());
    const glm::dmat4 indexFromWorld = painted.frame().indexFromWorld();
    const glm::dvec3 first(painted.domain().min);
    double least = 1, most = 0, lightOff = 0;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
            const double x = (i + 0.5) / 16 * 0.8 - 0.4, y = 0.4 - (j + 0.5) / 16 * 0.8;
            const auto indexOf = [&](double z) {
                return glm::dvec3(indexFromWorld * glm::dvec4(x, y, z, 1)) - first;
            };
            double sum = 0;
            const int steps = 2000;
            for (int k = 0; k < steps; ++k)
                sum += linearAt(grid, indexOf((k + 0.5) / steps - 0.5)) / steps;
            const double wanted = std::exp(-sum);
            least = std::min(least, wanted);
            most = std::max(most, wanted);
            EXPECT_NEAR(through[static_cast<size_t>(16 * j + i)], wanted, 0.004 * wanted)
                << i << ' ' << j;
            lightOff += std::pow(linearAt(fluence, indexOf(-0.545)) / wanted - 1, 2) / 256;
        }
    EXPECT_GT(most, 1.8 * least); // it is a picture
    EXPECT_LT(std::sqrt(lightOff), 0.03);
}

TEST_F(Seen, NamesOfObjectsAreAskedFor) {
    command("meshgen box -o a.obj");
    command("meshgen sphere --radius 0.3 --segments 32 -o b.obj");
    command("mesh2vol a.obj b.obj -o v.vdb --ior 1.5 --ior 1.3 --resolution 24 --quiet");
    refused(65, {"absorption.b, absorption.a, absorption.medium", "--object"},
            "volpaint v.vdb -o out.vdb --sphere absorption:0,0,0:1:1", folder);
    refused(65, {"no object 'c'", "b, a, medium"},
            "volpaint v.vdb -o out.vdb --object c --sphere absorption:0,0,0:1:1", folder);
    refused(65, {"no object 'c'"}, "volpaint v.vdb -o out.vdb --sphere absorption.c:0,0,0:1:1",
            folder);
    command(
        "volpaint v.vdb -o - --sphere absorption.b:0,0,0:1:1 | volpaint - -o painted.vdb --object "
        "medium --sphere scattering:0,0,0:1:1");
    const volume::Volume painted = volume::Volume::open(at("painted.vdb"));
    EXPECT_TRUE(painted.has("scattering.medium"));
    EXPECT_FALSE(painted.has("absorption.a"));
    EXPECT_FALSE(painted.constant("absorption.b"));
}

} // namespace eikonal
