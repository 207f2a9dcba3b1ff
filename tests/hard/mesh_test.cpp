// Hard cases of meshes, through mesh2vol: the right status, or the right volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scratch.h"
#include "support/shapes.h"
#include "support/tool.h"
#include "volume/volume.h"

#include <iomanip>
#include <sstream>

using namespace eikonal;
using glm::dvec3;
using glm::uvec3;
using mesh::TriangleMesh;

namespace {

/// A box whose faces lie on voxels' faces of the lattice below, hence between samples: its volume
/// by counting samples is exact.
TriangleMesh box(const dvec3& low = dvec3(0), const dvec3& high = dvec3(1)) {
    return mesh::boxShape(low, high);
}

/// Replaces the box's first triangle's first edge by two, over a point `off` from its middle, and
/// fills the gap between by a sliver that wide.
TriangleMesh splitEdge(TriangleMesh mesh, const dvec3& off) {
    const uvec3 face = mesh.triangles[0];
    const auto middle = static_cast<unsigned>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[face.x] + mesh.points[face.y]) + off);
    mesh.triangles[0] = {face.x, middle, face.z};
    mesh.triangles.push_back({middle, face.y, face.z});
    mesh.triangles.push_back({face.x, face.y, middle});
    return mesh;
}

class HardMesh : public ScratchTest {
protected:
    void write(const TriangleMesh& mesh, const std::string& name = "in.obj") const {
        std::ofstream out(at(name));
        out << std::setprecision(17);
        for (const dvec3& p : mesh.points) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        for (const uvec3& t : mesh.triangles)
            out << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
    }

    /// The command that voxelises in.obj in voxels of 1/16 from −¼ to 2¼ around `where`.
    static std::string command(const std::string& options = "", const dvec3& where = dvec3(0)) {
        std::ostringstream out;
        out << std::setprecision(17) << "mesh2vol in.obj -o out.vdb --ior 1 --absorption 1"
            << " --voxel-size 0.0625 --bounds=";
        for (const double side : {-0.25, 2.25})
            for (int c = 0; c < 3; ++c) out << (side > 0 || c > 0 ? "," : "") << where[c] + side;
        return out.str() + " " + options;
    }

    /// What the voxels of the output hold: the share of each that is inside.
    volume::DenseGrid coverage() const {
        const volume::Volume volume = volume::Volume::open(at("out.vdb"));
        volume::DenseGrid grid = volume.dense("absorption", volume.domain());
        mVoxel = volume.frame().voxelSize;
        return grid;
    }

    /// The volume by them [unit³].
    double filled() const {
        const volume::DenseGrid grid = coverage();
        double sum = 0;
        for (size_t i = 0; i < grid.voxels(); ++i) {
            EXPECT_GE(grid.values[3 * i], 0);
            EXPECT_LE(grid.values[3 * i], 1);
            sum += grid.values[3 * i];
        }
        return sum * mVoxel * mVoxel * mVoxel;
    }

    void expectVolume(double wanted, double tolerance, const std::string& options = "",
                      const dvec3& where = dvec3(0)) const {
        const Ran ran = run(command(options, where), folder);
        ASSERT_EQ(ran.status, 0) << ran.said;
        EXPECT_NEAR(filled(), wanted, tolerance) << ran.said;
        std::filesystem::remove(at("out.vdb"));
    }

    void expectRefused(const std::vector<std::string>& words) const {
        refused(65, words, command(), folder);
    }

    mutable double mVoxel = 0;
};

constexpr double kExact = 1e-6; // sums of floats that are eighths cubed

} // namespace

TEST_F(HardMesh, ABoxHasItsVolume) {
    write(box());
    for (const char* samples : {"1", "2", "4", "8"})
        expectVolume(1, kExact, std::string("--supersample ") + samples);
}

TEST_F(HardMesh, AnOpenOneIsRefusedAndClosedWhenAskedTo) {
    TriangleMesh open = box();
    open.triangles.pop_back();
    write(open);
    expectRefused({"open", "--repair"});
    expectVolume(1, kExact, "--repair");
}

TEST_F(HardMesh, AnInvertedOneIsRefusedAndTurnedWhenAskedTo) {
    write(mesh::turnedInsideOut(box()));
    expectRefused({"inside out", "--repair"});
    expectVolume(1, kExact, "--repair");
    TriangleMesh one = box(); // one face alone
    std::swap(one.triangles[3].x, one.triangles[3].y);
    write(one);
    expectRefused({"disagree"});
    expectVolume(1, kExact, "--repair");
}

TEST_F(HardMesh, ShellsThatCrossEachOtherAreTheirUnion) {
    write(mesh::joined(box(), box(dvec3(0.5), dvec3(1.5))));
    const Ran ran = run(command(), folder);
    ASSERT_EQ(ran.status, 0) << ran.said;
    EXPECT_NE(ran.said.find("cross"), std::string::npos) << ran.said;
    EXPECT_NEAR(filled(), 2 - 0.125, kExact);
}

TEST_F(HardMesh, AShellWithinAnotherIsACavityWhenItLooksInward) {
    write(mesh::joined(box(), mesh::turnedInsideOut(box(dvec3(0.25), dvec3(0.75)))));
    expectVolume(1 - 0.125, kExact);
}

TEST_F(HardMesh, FacesGivenTwiceAddNothing) {
    TriangleMesh one = box();
    one.triangles.push_back(one.triangles.front());
    write(one);
    expectRefused({"given twice"});
    expectVolume(1, kExact, "--repair");
    TriangleMesh all = box();
    const auto faces = all.triangles;
    all.triangles.insert(all.triangles.end(), faces.begin(), faces.end());
    write(all);
    // Closed and outward it is; wound round twice is inside once.
    expectVolume(1, kExact);
    expectVolume(1, kExact, "--repair");
}

TEST_F(HardMesh, FacesOfNoAreaAddNothing) {
    TriangleMesh repeated = box(); // twice the same corner
    repeated.triangles.push_back({0, 0, 1});
    repeated.triangles.push_back({2, 2, 2});
    write(repeated);
    expectVolume(1, kExact);
    write(splitEdge(box(), dvec3(0))); // three corners in a line
    expectVolume(1, kExact);
}

TEST_F(HardMesh, SliversOfATenMillionthAreHarmless) {
    for (const dvec3& off : {dvec3(1e-7), dvec3(-1e-7, 0, 1e-7), dvec3(0, 1e-12, 0)}) {
        write(splitEdge(box(), off));
        expectVolume(1, 1e-3); // the sliver may cover samples: one edge's row of 128 of 2 million
    }
}

TEST_F(HardMesh, ShellsThatTouchHaveTheirSumAndNoSeam) {
    // In a face, in an edge, in a corner; each with corners of its own.
    for (const dvec3& off : {dvec3(1, 0, 0), dvec3(1, 1, 0), dvec3(1, 1, 1)}) {
        write(mesh::joined(box(), box(off, off + 1.0)));
        expectVolume(2, kExact);
    }
}

TEST_F(HardMesh, FacesExactlyOnRowsOfSamplesCountThemOnce) {
    // Eight samples a voxel of 1/16: rows at (k + ½)/128. A box with every face on one of them has
    // the volume of its size, as do two halves of it that meet on one: no row is missed or counted
    // twice.
    const double row = 0.5 / 128;
    write(box(dvec3(row), dvec3(1 + row)));
    expectVolume(1, kExact, "--supersample 8");
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 high(1), low(0);
        high[axis] = low[axis] = 0.5 + row;
        write(mesh::joined(box(dvec3(0), high), box(low, dvec3(1))));
        expectVolume(1, kExact, "--supersample 8");
        const Ran ran = run(command("--supersample 8"), folder);
        ASSERT_EQ(ran.status, 0) << ran.said;
        for (const float value : coverage().values)
            ASSERT_TRUE(value == 0 || value == 1) << "a seam at half the box along " << axis;
    }
    // Also where the row runs in the triangle's own plane and along its diagonal.
    const TriangleMesh ball = mesh::moved(mesh::icosphere(0.5, 2), dvec3(0.5 + row));
    write(ball);
    double volume = 0;
    for (const uvec3& t : ball.triangles)
        volume += glm::dot(ball.points[t.x] - 0.5,
                           glm::cross(ball.points[t.y] - 0.5, ball.points[t.z] - 0.5)) /
                  6;
    // 270,000 samples, random at the rim
    expectVolume(volume, 2e-3 * volume, "--supersample 8 --smooth 0");
}

TEST_F(HardMesh, AMillionUnitsFromTheOriginItIsTheSame) {
    for (const dvec3& where : {dvec3(1e6, 0, 0), dvec3(-1e6, 1e6, 999999), dvec3(1048576.5)}) {
        write(mesh::moved(box(), where));
        expectVolume(1, kExact, "", where);
        write(mesh::moved(mesh::icosphere(0.5, 2), where + 0.5));
        const Ran far = run(command("", where), folder);
        ASSERT_EQ(far.status, 0) << far.said;
        const double volume = filled();
        write(mesh::moved(mesh::icosphere(0.5, 2), dvec3(0.5)));
        // Doubles hold 1e6 to 1e-10: a sample in a billion.
        expectVolume(volume, 1e-5);
    }
}
