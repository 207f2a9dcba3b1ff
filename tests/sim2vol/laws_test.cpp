// Laws of the index against published numbers, and what becomes of grids of every kind.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "optics/air.h"
#include "simgrids/simgrids.h"
#include "support/vdb_files.h"

using namespace eikonal;
using namespace eikonal::volume;

namespace {

const IndexBox kBox{glm::ivec3(0), glm::ivec3(7)};
const glm::ivec3 kInside(3, 3, 3), kBeside(20, 3, 3);

class SimGrids : public VolumeTest {
protected:
    /// What a file of these grids becomes by the maps "ior density:1:1"; written as out.vdb.
    std::vector<std::string> make(const std::vector<VdbGrid>& grids,
                                  const std::vector<std::pair<std::string, std::string>>& maps,
                                  simgrids::Params params = {}) const {
        for (const auto& [to, text] : maps) params.maps.push_back(simgrids::parseMap(to, text));
        params.check();
        simgrids::Plan plan = simgrids::makePlan(vdb("in.vdb", grids), params);
        Stats stats;
        const std::vector<std::string> warnings = simgrids::run(plan, params, stats);
        write(plan.volume, "out.vdb");
        return warnings;
    }
    VdbGrid out(const std::string& grid) const { return gridIn("out.vdb", grid); }
};

} // namespace

TEST(AirIndex, IsThatOfCiddorsTable) {
    // Ciddor 1996, table 1: dry air, 450 ppm of CO₂, 633.0 nm; given to 1e-9.
    const struct {
        double celsius, kilopascal, refractivity;
    } rows[] = {{20, 80, 21458.0e-8},
                {20, 100, 26824.4e-8},
                {20, 120, 32191.6e-8},
                {10, 100, 27774.7e-8},
                {30, 100, 25937.2e-8}};
    for (const auto& row : rows)
        EXPECT_NEAR(optics::airRefractivity(row.celsius + 273.15, 1000 * row.kilopascal, 633),
                    row.refractivity, 1e-9);
}

TEST(AirIndex, FollowsTheGasLawInFlames) {
    // What remains of the compressibility is below 5e-4.
    const double cold = optics::airRefractivity(300, 101325, 587.6);
    for (const double kelvin : {600.0, 1500.0, 2500.0})
        EXPECT_NEAR(optics::airRefractivity(kelvin, 101325, 587.6) / cold * kelvin / 300, 1, 5e-4);
}

TEST(AirIndex, GladstoneAndDalesConstantIsTheKnownOne) {
    // Textbooks on flow visualisation have 2.26e-4 m³/kg, in three digits, in the visible.
    EXPECT_NEAR(optics::gladstoneDaleOfAir(587.6), 2.26e-4, 1e-6);
}

TEST_F(SimGrids, AnIndexOfATemperatureKeepsItsDigits) {
    VdbGrid kelvin("temperature", VdbGrid::Type::float32, glm::dvec3(293.15f));
    kelvin.fill(kBox, glm::dvec3(293.25));
    make({kelvin}, {{"ior", "temperature:air"}});
    const VdbGrid ior = out("ior");
    EXPECT_EQ(ior.type(), "double");
    // dn/dT = −0.93e-6 / K: that of a tenth of a kelvin, which no float near 1 holds, to 1e-6 of
    // it.
    const double wanted = optics::airRefractivity(293.25, 101325, 587.6) -
                          optics::airRefractivity(double{293.15f}, 101325, 587.6);
    EXPECT_NEAR(ior.valueAt(kInside) - ior.valueAt(kBeside), wanted, 1e-6 * std::abs(wanted));
    EXPECT_TRUE(ior.isActive(kInside));
    EXPECT_FALSE(ior.isActive(kBeside));
    EXPECT_EQ(ior.activeVoxels(), 512u);
    // The whole file goes on, its first grid too.
    EXPECT_EQ(out("temperature").valueAt(kInside), 293.25);
}

TEST_F(SimGrids, KelvinsAndWhatSurroundsThemAreTold) {
    simgrids::Params params;
    params.kelvinScale = 300;
    params.kelvinOffset = 290;
    params.ambient = 280;
    const VdbGrid heat = floats("temperature", 0.5f, 0);
    make({heat}, {{"ior", "temperature:air:90000"}}, params);
    EXPECT_NEAR(out("ior").valueAt(kInside), 1 + optics::airRefractivity(440, 90000, 587.6), 1e-15);
    EXPECT_NEAR(out("ior").valueAt(kBeside), 1 + optics::airRefractivity(280, 90000, 587.6), 1e-12);
}

TEST_F(SimGrids, LinearMapsOfEveryKind) {
    const VdbGrid density = floats("density", 0.5f, 0);
    const VdbGrid colour = vectors("color", {0.25, 0.5, 1});
    make({density, colour}, {{"scattering", "density:5"},
                             {"absorption", "density:1,2,4:0.5"},
                             {"albedo", "color:0.5"},
                             {"ior", "density:gladstone-dale:2e-4"}});
    EXPECT_EQ(out("scattering").type(), "float"); // grey
    EXPECT_EQ(out("scattering").valueAt(kInside), 2.5);
    EXPECT_EQ(out("absorption").at(kInside), glm::dvec3(1, 1.5, 2.5));
    EXPECT_EQ(out("absorption").at(kBeside), glm::dvec3(0.5));
    EXPECT_EQ(out("albedo").at(kInside), glm::dvec3(0.125, 0.25, 0.5));
    EXPECT_EQ(out("ior").valueAt(kInside), 1.0001);
}

TEST_F(SimGrids, GridsMayTakeEachOthersNames) {
    // Emission is what the file held of it, though scattering is read from it and made, too.
    const VdbGrid emission = floats("emission", 3, 0), density = floats("density", 2, 0);
    make({emission, density}, {{"emission", "density:1"}, {"scattering", "emission:1"}});
    EXPECT_EQ(out("emission").valueAt(kInside), 2);
    EXPECT_EQ(out("scattering").valueAt(kInside), 3);
}

TEST_F(SimGrids, ALevelSetStaysOne) {
    VdbGrid surface = floats("surface", -0.5f, 3);
    surface.setLevelSet();
    make({surface}, {{"sdf", "surface:2"}});
    EXPECT_TRUE(out("sdf").isLevelSet());
    EXPECT_EQ(out("sdf").valueAt(kInside), -1);
    EXPECT_EQ(out("sdf").background(), 6);
}

TEST_F(SimGrids, TransformsAreKeptAndMustAgree) {
    VdbGrid density = floats("density", 0.5f, 0), fuel = floats("fuel", 0.5f, 0);
    for (VdbGrid* grid : {&density, &fuel}) grid->setVoxelSize(0.25);
    fuel.translate({0.1, 0, 0});
    make({fuel, density}, {{"scattering", "density:1"}}); // fuel is only copied
    EXPECT_EQ(out("scattering").worldFromIndex({4, 0, 0}), glm::dvec3(1, 0, 0));
    expectError(ExitStatus::data, {"'density'", "another transform than grid 'fuel'"}, [&] {
        make({fuel, density}, {{"scattering", "density:1"}, {"absorption", "fuel:1"}});
    });
}

TEST_F(SimGrids, WhatIsNoNumberIsRefusedWithItsVoxel) {
    VdbGrid density = floats("density", 0.5f, 0);
    density.set({1, 2, 3}, NAN);
    for (const char* to : {"ior", "scattering"})
        expectError(ExitStatus::data, {"in.vdb: grid 'density': voxel (1, 2, 3) is NaN"}, [&] {
            make({density}, {{to, "density:1:1"}});
        });
    const VdbGrid steps("density", VdbGrid::Type::int32, glm::dvec3(0));
    expectError(ExitStatus::data, {"grid 'density' holds int32"}, [&] {
        make({floats("fuel"), steps}, {{"scattering", "density:1"}});
    });
}

TEST_F(SimGrids, CutsAreCountedByActiveVoxels) {
    VdbGrid density = floats("density", 0.5f, 0);
    density.set({1, 2, 3}, -1e-7); // as solvers leave them
    density.set({1, 2, 4}, -1e-7);
    const auto warnings = make({density}, {{"absorption", "density:1,2,3"}});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("in 2 voxels: it is 0 there"), std::string::npos) << warnings[0];
    EXPECT_EQ(out("absorption").at({1, 2, 3}), glm::dvec3(0));
}
