// What a look-up costs in a dense texture, in bricks by a page table, and in NanoVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "gpu/program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/vec4.hpp>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/tools/LevelSetSphere.h>

namespace bench {

using namespace eikonal;

namespace {

constexpr int kVoxels = 256, kBrick = 8, kPadded = kBrick + 1;
constexpr float kBeyond = 3;
constexpr unsigned kNoBrick = 0xFFFFFFFEu;

enum Store { kDense, kPaged, kNano };
enum Filtered { kNearest, kByHand, kByDevice };

/// The distances of a ball, three voxels to either side, in all three forms.
struct Forms {
    gpu::Texture dense, pages, atlas;
    gpu::Buffer nano;

    explicit Forms(gpu::Device& device) {
        openvdb::initialize();
        const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
            0.35f * kVoxels, openvdb::Vec3f(kVoxels / 2), 1.0f, kBeyond);
        makeDense(device, *grid);
        makePages(device, *grid);
        const auto handle = nanovdb::openToNanoVDB(*grid);
        nano = gpu::Buffer(device, static_cast<std::int64_t>(handle.size()), handle.data());
    }

    void makeDense(gpu::Device& device, const openvdb::FloatGrid& grid) {
        std::vector<float> values;
        values.reserve(std::size_t{kVoxels} * kVoxels * kVoxels);
        auto accessor = grid.getConstAccessor();
        for (int z = 0; z < kVoxels; ++z)
            for (int y = 0; y < kVoxels; ++y)
                for (int x = 0; x < kVoxels; ++x) values.push_back(accessor.getValue({x, y, z}));
        dense =
            gpu::Texture(device, glm::ivec3(kVoxels), gpu::TexelFormat::r32f, gpu::Filter::linear);
        dense.upload(values.data());
    }

    void makePages(gpu::Device& device, const openvdb::FloatGrid& grid) {
        auto accessor = grid.getConstAccessor();
        // A brick's last cells reach into its neighbours.
        const auto varies = [&](const openvdb::Coord& low) {
            bool any = false;
            for (int i = 0; i < 8 && !any; ++i)
                any = accessor.probeConstLeaf(low.offsetBy(i & 1 ? kBrick : 0, i & 2 ? kBrick : 0,
                                                           i & 4 ? kBrick : 0)) != nullptr;
            return any;
        };
        constexpr int edge = kVoxels / kBrick;
        std::vector<openvdb::Coord> bricks;
        std::vector<unsigned> table;
        for (int z = 0; z < edge; ++z)
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) {
                    const openvdb::Coord low(kBrick * x, kBrick * y, kBrick * z);
                    const bool has = varies(low);
                    table.push_back(has ? static_cast<unsigned>(bricks.size())
                                        : kNoBrick + (accessor.getValue(low) < 0));
                    if (has) bricks.push_back(low);
                }
        const int wide = static_cast<int>(std::ceil(std::cbrt(bricks.size()))),
                  size = kPadded * wide;
        const auto place = [&](int k) {
            return kPadded * glm::ivec3(k % wide, k / wide % wide, k / (wide * wide));
        };
        std::vector<float> values(static_cast<size_t>(size) * size * size);
        for (int k = 0; k < static_cast<int>(bricks.size()); ++k)
            for (int i = 0; i < kPadded * kPadded * kPadded; ++i) {
                const glm::ivec3 in(i % kPadded, i / kPadded % kPadded, i / (kPadded * kPadded));
                const glm::ivec3 at = place(k) + in;
                values[(static_cast<size_t>(at.z) * size + at.y) * size + at.x] =
                    accessor.getValue(bricks[static_cast<size_t>(k)].offsetBy(in.x, in.y, in.z));
            }
        for (unsigned& page : table) {
            if (page >= kNoBrick) continue;
            const glm::uvec3 first(place(static_cast<int>(page)));
            page = first.x | first.y << 10 | first.z << 20;
        }
        atlas = gpu::Texture(device, glm::ivec3(size), gpu::TexelFormat::r32f, gpu::Filter::linear);
        atlas.upload(values.data());
        pages =
            gpu::Texture(device, glm::ivec3(edge), gpu::TexelFormat::r32ui, gpu::Filter::nearest);
        pages.upload(table.data());
    }

    double megabytes(Store store) const {
        return 1e-6 * static_cast<double>(store == kDense   ? dense.bytes()
                                          : store == kPaged ? atlas.bytes() + pages.bytes()
                                                            : nano.bytes());
    }
};

/// Shaders are read from a folder in which NanoVDB's header lies beside the kernel.
class Folder {
public:
    explicit Folder(const std::string& work) {
        const auto folder = std::filesystem::absolute(work) / "shaders";
        std::filesystem::create_directories(folder / "bench");
        const auto take = [&](const char* from, const char* as) {
            std::ifstream in(from);
            std::ofstream out(folder / "bench" / as);
            for (std::string line; std::getline(in, line);)
                if (!line.starts_with("#include <")) out << line << "\n"; // C's, which GLSL has not
        };
        take(EIKONAL_SOURCE_DIR "/tests/bench/sparse.comp.glsl", "sparse.comp.glsl");
        take(EIKONAL_NANOVDB_HEADER, "PNanoVDB.h");
        ::setenv("EIKONAL_SHADERS", folder.c_str(), 1);
    }
    ~Folder() { ::unsetenv("EIKONAL_SHADERS"); }
};

/// Million steps a second, and the sums that they end in.
double march(gpu::Device& device, const Forms& forms, const gpu::Program& program,
             std::vector<float>& sums) {
    const glm::uvec4 values(192, 192, kVoxels, 0);
    const gpu::Buffer params(device, sizeof values, &values);
    sums.resize(size_t{values.x} * values.y);
    const gpu::Buffer result(device, static_cast<std::int64_t>(sums.size() * 4));
    params.bindUniform(0);
    result.bindStorage(0);
    forms.nano.bindStorage(1);
    forms.dense.bindSampler(0);
    forms.pages.bindSampler(1);
    forms.atlas.bindSampler(2);
    gpu::finish();
    const auto began = std::chrono::steady_clock::now();
    program.dispatch({values.x, values.y, 1});
    gpu::finish();
    const double ms = gpu::millisecondsSince(began);
    result.download(sums.data(), static_cast<std::int64_t>(sums.size() * 4));
    return 1e-3 * static_cast<double>(sums.size()) * kVoxels / ms;
}

struct Case {
    const char* name;
    Store store;
    Filtered filtered;
};
constexpr Case kCases[] = {
    {"dense texture, one value", kDense, kNearest}, {"page table, one value", kPaged, kNearest},
    {"NanoVDB, one value", kNano, kNearest},        {"dense texture, filtered", kDense, kByDevice},
    {"page table, filtered", kPaged, kByDevice},    {"page table, eight values", kPaged, kByHand},
    {"NanoVDB, eight values", kNano, kByHand}};

} // namespace

Json measureSparse(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    const Forms forms(device);
    const Folder folder(settings.work);
    Json rows = Json::array();
    std::array<std::vector<float>, 2> truth;
    for (const Case& one : kCases) {
        const gpu::Program program(device, "bench/sparse.comp.glsl",
                                   {{"STORE", one.store}, {"FILTERED", one.filtered}});
        std::vector<float> sums;
        std::vector<double> rates;
        for (int i = 0; i <= settings.repeats; ++i) {
            const double rate = march(device, forms, program, sums);
            if (i > 0) rates.push_back(rate); // the first compiles
        }
        std::vector<float>& first = truth[one.filtered == kNearest ? 0 : 1];
        if (first.empty()) first = sums;
        double off = 0;
        for (size_t i = 0; i < sums.size(); ++i)
            off = std::max(off, std::abs(double{sums[i]} - double{first[i]}));
        rows.push_back({{"look-up", one.name},
                        {"million a second", median(rates)},
                        {"MB", forms.megabytes(one.store)},
                        {"sums off by", off / kVoxels}});
    }
    return rows;
}

} // namespace bench
