// The light stage: photons through a scene volume, fluence and direction out (Sun et al. 2008).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/lightsim.h"

#include "base/error.h"
#include "gpu/program.h"
#include "lightsim/octree.h"
#include "lightsim/photon_map.h"
#include "lightsim/shared.h"
#include "lightsim/upload.h"
#include "medium/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;
using gpu::Buffer;
using gpu::Program;
using gpu::Texture;

// Steps a photon makes in one launch before the list is thinned: enough for the photons that meet
// no boundary to be through, few enough that those done do not hold up their neighbours for long.
constexpr unsigned kStepsPerLaunch = 48;

constexpr double kPi = 3.14159265358979323846;

// Work items that sum up a batch's books: enough to fill a device, few enough to read back.
constexpr int kAccounts = 1024;

// The same among sharp boundaries, where a look for one counts as a step: two or three pieces of
// way for most photons, then those that are reflected once more.
constexpr unsigned kSharpStepsPerLaunch = 48;

/// As in shaders/lightsim/account.comp.glsl.
struct Account {
    glm::vec4 remaining, absorbed, scattered, escaped;
    glm::uvec4 count;
};

/// A batch's books, in weights and numbers.
struct Books {
    dvec3 remaining{0}, absorbed{0}, scattered{0}, escaped{0};
    std::array<double, 4> counts{}; // photons, steps, deposits, trapped
    double tooDeep = 0;             // photons that met too many boundaries
    double error = 0;               // the largest, estimated [voxel]
};

/// The light with its position or direction in voxel space.
Light toVoxels(const Light& light, const glm::dmat4& voxelFromWorld) {
    Light out = light;
    const bool point = light.kind == Light::Kind::point;
    out.vector = dvec3(voxelFromWorld * glm::dvec4(light.vector, point ? 1.0 : 0.0));
    if (!point) out.vector = glm::normalize(out.vector);
    return out;
}

/// The largest fixed-point unit, a power of two, with which every photon of a batch may cross one
/// voxel from corner to corner and still leave an eighth of the range free (kNearFull in
/// shaders/lightsim/march.comp.glsl). Not above 2^24, the digits of a float: a deposit then fits an
/// int, too.
double unitFor(double photons) {
    const double kRange = 3758096384.0; // 0xE0000000
    return std::exp2(std::min(24.0, std::floor(std::log2(kRange / (std::sqrt(3.0) * photons)))));
}

/// One simulation: what is on the device for its duration, and the loop over lights and batches.
class Simulation {
public:
    Simulation(gpu::Device& device, const volume::Volume& volume, const Plan& plan,
               const Params& params, Stats& stats);
    Result run(const Progress& progress);

private:
    void compile();
    void uploadMedium();
    void uploadEmitter();
    void makeBuffers();
    void traceLight(const Light& light, const Progress& progress);
    void traceBatch(const Window& window, const Light& light, double power,
                    const Progress& progress);
    bool traceOnce(const Window& window, const Light& light, double power,
                   const Progress& progress);
    void makeLists(const ivec2& pixels);
    void bindMedium();
    std::uint32_t bear(const Window& window);
    std::uint32_t march(std::uint32_t count);
    Books closeBooks(const ivec2& pixels);
    void resolve(const Light& light, double power);
    void book(const Light& light, double power, const Books& born, const Books& done);
    void smooth();
    Result download();

    gpu::Device& mDevice;
    const volume::Volume& mVolume;
    const Plan& mPlan;
    const Params& mParams;
    Stats& mStats;
    gpu::Profiler mProfiler;

    glm::dmat4 mVoxelFromWorld;
    VoxelBox mDomain, mTarget;
    medium::Field mField;
    medium::Surfaces mSurfaces;
    Texture mLeaves, mAbsorption, mScattering, mOpaque, mMap;
    Buffer mEmitter, mCount, mParamsBlock, mBirthBlock, mResolveBlock, mPhotons, mPassages,
        mLists[2], mAccounts;
    std::vector<Buffer> mPlanes, mResults; // results: channels of fluence, then of direction
    std::int64_t mEmitterVertices = 0;
    PhotonParams mTracing{};
    ivec4 mBatch{0, 0, 1, 0}; // BirthParams::batch
    Program mBirthMap, mBirth, mMarch, mAccount, mResolve, mSmooth;
};

Simulation::Simulation(gpu::Device& device, const volume::Volume& volume, const Plan& plan,
                       const Params& params, Stats& stats)
    : mDevice(device), mVolume(volume), mPlan(plan), mParams(params), mStats(stats),
      mProfiler(stats), mVoxelFromWorld(volume.frame().indexFromWorld()) {
    // Voxel space has its origin at the domain's first voxel.
    mVoxelFromWorld[3] -= glm::dvec4(dvec3(volume.domain().min), 0.0);
    mDomain = {dvec3(-0.5), dvec3(plan.size) - 0.5};
    compile();
    uploadMedium();
    uploadEmitter();
    makeBuffers();
    mTracing.size = ivec4(plan.size, static_cast<int>(plan.voxels()));
    mTracing.list = uvec4(0, 0, params.maxSteps, 0);
    mTracing.limits = vec4(params.stepMin, params.dropBelow, 0, 0);
    const optics::Tracing& tracing = params.tracing;
    const double crossing = glm::length(dvec3(plan.size));
    mTracing.tracing =
        vec4(tracing.step > 0 ? tracing.step : 1e6, tracing.tolerance / crossing, crossing, 0);
    mTracing.scale = vec4(1.0f / glm::vec3(plan.size + 2), 0);
    mTracing.sharp = uvec4(params.maxDepth, params.seed << 16u, 0, 0);
}

void Simulation::compile() {
    mProfiler.begin("shaders");
    const int channels = mPlan.tracedChannels();
    const int field = medium::fieldSwitch(mPlan.bends, mParams.tracing.sampling());
    const bool direction = mPlan.wants(Output::direction);
    mBirthMap = Program(mDevice, "lightsim/birth.vert.glsl", "lightsim/birth.frag.glsl", {});
    gpu::Switches born{{"FIELD", field}};
    gpu::Switches traced{{"PATH", mParams.tracing.pathSwitch(mPlan.bends)},
                         {"FIELD", field},
                         {"CHANNELS", channels},
                         {"MEDIUM", !mPlan.attenuates ? 0
                                    : mPlan.dense     ? 2
                                                      : 1},
                         {"DIRECTION", direction},
                         {"OPAQUE", mPlan.opaque}};
    if (mPlan.sharp)
        for (const auto& [name, value] : medium::surfaceSwitches(mPlan.objects)) {
            traced.emplace_back(name, value);
            if (name == "SOLIDS") born.emplace_back(name, value);
        }
    mBirth = Program(
        mDevice, mPlan.sharp ? "lightsim/sharp_birth.comp.glsl" : "lightsim/birth.comp.glsl", born);
    mMarch = Program(mDevice, mPlan.sharp ? "lightsim/sharp.comp.glsl" : "lightsim/march.comp.glsl",
                     traced);
    mAccount = Program(mDevice, "lightsim/account.comp.glsl", {});
    mResolve = Program(
        mDevice, "lightsim/resolve.comp.glsl",
        {{"CHANNELS", channels}, {"FLUENCE", mPlan.fluenceChannels()}, {"DIRECTION", direction}});
    if (mParams.smoothing > 0)
        mSmooth = Program(mDevice, "lightsim/smooth.comp.glsl",
                          {{"FLUENCE", mPlan.fluenceChannels()}, {"DIRECTION", direction}});
    mProfiler.end();
}

void Simulation::uploadMedium() {
    mProfiler.begin("medium");
    mField = mPlan.bends ? medium::Field(mDevice, mPlan.index.grid,
                                         {mParams.tracing.sampling(), mParams.tracing.unbiased()})
                         : medium::Field(mDevice, mPlan.index.least);
    if (mPlan.sharp) {
        mSurfaces = medium::Surfaces(mDevice, mPlan.objects, mPlan.voxelSize);
    } else if (mPlan.attenuates) {
        mAbsorption = makeAbsorption(mDevice, mPlan);
        if (mPlan.colour) mScattering = makeScattering(mDevice, mPlan);
    }
    if (mPlan.opaque && !mPlan.sharp) mOpaque = makeOpaque(mDevice, mPlan);
    mProfiler.end();
    if (mPlan.sharp && !mPlan.bends) return; // from boundary to boundary in one go
    mProfiler.begin("octree");
    mLeaves = makeOctree(mDevice, mPlan, mParams);
    mProfiler.end();
}

void Simulation::uploadEmitter() {
    std::vector<glm::vec4> corners;
    mTarget = mDomain;
    if (mParams.proxy.empty()) {
        corners = triangles(mDomain);
    } else {
        mTarget = {dvec3(1e300), dvec3(-1e300)};
        for (const dvec3& corner : mParams.proxy) {
            const dvec3 p(mVoxelFromWorld * glm::dvec4(corner, 1.0));
            mTarget.low = glm::min(mTarget.low, p);
            mTarget.high = glm::max(mTarget.high, p);
            corners.emplace_back(p, 1.0);
        }
    }
    mEmitterVertices = static_cast<std::int64_t>(corners.size());
    mEmitter = Buffer(mDevice, mEmitterVertices * 16, corners.data());
}

void Simulation::makeBuffers() {
    const std::int64_t bytes = mPlan.voxels() * 4;
    const int results = mPlan.fluenceChannels() + (mPlan.wants(Output::direction) ? 3 : 0);
    for (int i = 0; i < mPlan.planes(); ++i) mPlanes.emplace_back(mDevice, bytes);
    for (int i = 0; i < results; ++i) mResults.emplace_back(mDevice, bytes);
    for (auto* buffers : {&mPlanes, &mResults})
        for (Buffer& buffer : *buffers) buffer.clear();
    mCount = Buffer(mDevice, 16);
    mAccounts = Buffer(mDevice, kAccounts * static_cast<std::int64_t>(sizeof(Account)));
    mParamsBlock = Buffer(mDevice, sizeof(PhotonParams));
    mBirthBlock = Buffer(mDevice, sizeof(BirthParams));
    mResolveBlock = Buffer(mDevice, sizeof(ResolveParams));
}

Result Simulation::run(const Progress& progress) {
    const double count = static_cast<double>(mParams.lights.size());
    for (size_t i = 0; i < mParams.lights.size(); ++i)
        traceLight(toVoxels(mParams.lights[i], mVoxelFromWorld),
                   partOf(progress, 0.95 * static_cast<double>(i) / count,
                          0.95 * static_cast<double>(i + 1) / count));
    smooth();
    Result result = download();
    mProfiler.collect();
    report(progress, 1.0);
    return result;
}

void Simulation::traceLight(const Light& light, const Progress& progress) {
    mStats.hasEnergy = true;
    const double total = light.rgb.x + light.rgb.y + light.rgb.z;
    if (total <= 0) return;
    mTracing.colour = vec4(light.rgb / total, 0);
    if (light.kind == Light::Kind::point)
        for (size_t c = 0; c < 3; ++c)
            mStats.energy.emitted[c] += 4 * kPi * light.rgb[static_cast<int>(c)];
    // The plastic number's powers spread successive seeds evenly over a pixel.
    const dvec2 shift = glm::fract(static_cast<double>(mParams.seed) *
                                   dvec2(0.7548776662466927, 0.5698402909980532));
    const std::vector<Window> windows =
        windowsOf(light, mTarget, mDomain, mParams.photons, shift, !mParams.proxy.empty());
    const double all = static_cast<double>(windows.size());
    for (size_t w = 0; w < windows.size(); ++w) {
        const Window& window = windows[w];
        const double h = mPlan.voxelSize;
        // Radiant power per unit of the light's RGB in a photon of weight 1 [m² or sr].
        const double power = window.pixelArea() * (window.point ? 1.0 : h * h);
        const double pixels = static_cast<double>(window.pixels.x) * window.pixels.y;
        const int b = std::max(
            1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(kBatchPixels)))));
        for (int batch = 0; batch < b * b; ++batch) {
            const double part = 1.0 / (b * b);
            const double begun = static_cast<double>(w) + batch * part;
            mBatch = ivec4(batch % b, batch / b, b, 0);
            ++mTracing.sharp.y;
            traceBatch(window.batch(mBatch.x, mBatch.y, b), light, power,
                       partOf(progress, begun / all, (begun + part) / all));
        }
    }
}

void Simulation::traceBatch(const Window& window, const Light& light, double power,
                            const Progress& progress) {
    const double pixels = static_cast<double>(window.pixels.x) * window.pixels.y;
    if (pixels == 0) return;
    makeLists(window.pixels);
    const double kLeast = 1.0 / 1024; // 2^32 voxel lengths of every photon: beyond any path
    for (double unit = unitFor(pixels); unit >= kLeast; unit /= 16) {
        mTracing.limits.z = static_cast<float>(unit);
        if (traceOnce(window, light, power, progress)) return;
        mStats.count("batches_run_again", 1);
        for (Buffer& plane : mPlanes) plane.clear();
    }
    throw InternalError("photons overflow a voxel's sum");
}

bool Simulation::traceOnce(const Window& window, const Light& light, double power,
                           const Progress& progress) {
    std::uint32_t count = bear(window);
    const std::uint32_t born = count;
    const Books birth = closeBooks(window.pixels);
    const auto few = static_cast<std::uint32_t>(mParams.thinTo * born);
    mProfiler.begin("photons");
    while (count > few) {
        count = march(count);
        report(progress, 1.0 - static_cast<double>(count) / born);
    }
    mProfiler.end();
    std::uint32_t overflowed = 0;
    mCount.download(&overflowed, 4, 4);
    if (overflowed != 0) return false;
    const Books done = closeBooks(window.pixels);
    book(light, power, birth, done);
    if (count > 0) mStats.count("photons_left_by_thinning", count);
    resolve(light, power);
    report(progress, 1.0);
    return true;
}

void Simulation::makeLists(const ivec2& pixels) {
    if (mMap.name() != 0 && mMap.size() == ivec3(pixels, 0)) return;
    const std::int64_t count = std::int64_t{pixels.x} * pixels.y;
    mMap = Texture(); // freed before the next is allocated
    for (Buffer* buffer : {&mPhotons, &mPassages, &mLists[0], &mLists[1]}) *buffer = Buffer();
    mMap = Texture(mDevice, ivec3(pixels, 0), gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    mPhotons = Buffer(mDevice, count * static_cast<std::int64_t>(sizeof(Photon)));
    if (mPlan.sharp) mPassages = Buffer(mDevice, count * 16);
    for (Buffer& list : mLists) list = Buffer(mDevice, count * 4);
}

std::uint32_t Simulation::bear(const Window& window) {
    mProfiler.begin("photon birth");
    BirthParams birth{};
    birth.clipFromVoxel = mat4(window.clipFromVoxel());
    birth.right = vec4(window.right, 0);
    birth.up = vec4(window.up, 0);
    birth.forward = vec4(window.forward, 0);
    birth.window = vec4(window.low, window.extent);
    birth.origin = vec4(window.origin, window.startsAtLight ? 1 : 0);
    birth.low = vec4(mDomain.low, 0);
    birth.high = vec4(mDomain.high, 0);
    birth.weight = vec4(window.point ? 1 : 0, 0, 0, 0);
    birth.map = ivec4(window.pixels, static_cast<int>(mParams.seed), 0);
    birth.batch = mBatch;
    mBirthBlock.upload(&birth, sizeof birth);
    mBirthBlock.bindUniform(0);
    mMap.clear();
    if (!window.startsAtLight) {
        mEmitter.bindStorage(0);
        gpu::drawTriangles(mBirthMap, mEmitterVertices, window.pixels.x, window.pixels.y, &mMap);
        gpu::barrier();
    }
    mCount.clear();
    mCount.bindStorage(0);
    mPhotons.bindStorage(1);
    mLists[0].bindStorage(2);
    mMap.bindSampler(0);
    bindMedium();
    mBirth.dispatch({window.pixels, 1});
    gpu::barrier();
    mDevice.check("photon birth");
    std::uint32_t born = 0;
    mCount.download(&born, sizeof born);
    mProfiler.end();
    return born;
}

void Simulation::bindMedium() {
    mField.bind();
    if (!mPlan.sharp) return;
    mSurfaces.bind();
    mPassages.bindStorage(10);
}

std::uint32_t Simulation::march(std::uint32_t count) {
    const std::uint32_t zero = 0;
    mCount.upload(&zero, sizeof zero);
    mTracing.list.x = count;
    mTracing.list.y = mPlan.sharp ? kSharpStepsPerLaunch : kStepsPerLaunch;
    mParamsBlock.upload(&mTracing, sizeof mTracing);
    mParamsBlock.bindUniform(0);
    mCount.bindStorage(0);
    mPhotons.bindStorage(1);
    mLists[0].bindStorage(2);
    mLists[1].bindStorage(3);
    for (size_t i = 0; i < mPlanes.size(); ++i)
        mPlanes[i].bindStorage(4 + static_cast<unsigned>(i));
    bindMedium();
    const Texture* textures[] = {&mLeaves, &mAbsorption, &mScattering, &mOpaque};
    for (unsigned unit = 0; unit < 4; ++unit)
        if (textures[unit]->name() != 0) textures[unit]->bindSampler(2 + unit);
    mMarch.dispatch({static_cast<int>(count), 1, 1});
    gpu::barrier();
    mDevice.check("photons");
    std::uint32_t left = 0;
    mCount.download(&left, sizeof left);
    std::swap(mLists[0], mLists[1]);
    return left;
}

Books Simulation::closeBooks(const ivec2& pixels) {
    mProfiler.begin("books");
    mTracing.list.y = kAccounts;
    mTracing.list.w = static_cast<unsigned>(pixels.x) * static_cast<unsigned>(pixels.y);
    mParamsBlock.upload(&mTracing, sizeof mTracing);
    mParamsBlock.bindUniform(0);
    mPhotons.bindStorage(1);
    mAccounts.bindStorage(2);
    mAccount.dispatch({kAccounts, 1, 1});
    gpu::barrier();
    std::vector<Account> accounts(kAccounts);
    mAccounts.download(accounts.data(), mAccounts.bytes());
    Books books;
    for (const Account& account : accounts) {
        books.remaining += dvec3(account.remaining);
        books.error = std::max(books.error, static_cast<double>(account.remaining.w));
        books.absorbed += dvec3(account.absorbed);
        books.scattered += dvec3(account.scattered);
        books.escaped += dvec3(account.escaped);
        books.tooDeep += static_cast<double>(account.escaped.w);
        for (int i = 0; i < 4; ++i) books.counts[static_cast<size_t>(i)] += account.count[i];
    }
    mProfiler.end();
    return books;
}

void Simulation::book(const Light& light, double power, const Books& born, const Books& done) {
    Energy& energy = mStats.energy;
    for (int c = 0; c < 3; ++c) {
        const double watts = light.rgb[c] * power;
        const auto i = static_cast<size_t>(c);
        const int channel = mPlan.colour ? c : 0;
        // A point light shines all round; what it emits is booked once, in traceLight().
        if (light.kind == Light::Kind::directional)
            energy.emitted[i] += born.remaining[channel] * watts;
        energy.entered[i] += born.remaining[channel] * watts;
        energy.absorbed[i] += done.absorbed[channel] * watts;
        energy.scattered[i] += done.scattered[channel] * watts;
        energy.escaped[i] += done.escaped[channel] * watts;
        energy.lost[i] += (done.remaining[channel] - done.escaped[channel]) * watts;
    }
    const char* names[] = {"photons", "steps", "deposits", "trapped"};
    for (size_t i = 0; i < 4; ++i) mStats.count(names[i], done.counts[i]);
    if (mPlan.sharp) mStats.count("photons_too_deep", done.tooDeep);
    if (mPlan.bends && mParams.tracing.integrator == optics::Integrator::adaptive)
        mStats.raise("position_error_voxels", done.error);
    mStats.count("atomic_adds", done.counts[2] * static_cast<double>(mPlanes.size()));
}

void Simulation::resolve(const Light& light, double power) {
    mProfiler.begin("resolve");
    const double h = mPlan.voxelSize;
    // Track-length estimate: power × path length / voxel volume. [1/m² per unit of fixed point]
    const double unit = power / (h * h) / static_cast<double>(mTracing.limits.z);
    ResolveParams values{};
    values.size = mTracing.size;
    values.fluence = vec4(unit * light.rgb, 0);
    values.colour = mTracing.colour;
    values.colour.w = static_cast<float>(unit * (light.rgb.x + light.rgb.y + light.rgb.z));
    mResolveBlock.upload(&values, sizeof values);
    mResolveBlock.bindUniform(0);
    for (size_t i = 0; i < mPlanes.size(); ++i) mPlanes[i].bindStorage(static_cast<unsigned>(i));
    for (size_t i = 0; i < mResults.size(); ++i)
        mResults[i].bindStorage(6 + static_cast<unsigned>(i));
    // Rows of 2^20 voxels: a device takes 65,535 groups along one dimension, maybe not more.
    const std::int64_t row = 1 << 20, voxels = mPlan.voxels();
    mResolve.dispatch(
        {static_cast<int>(std::min(voxels, row)), static_cast<int>((voxels + row - 1) / row), 1});
    gpu::barrier();
    mDevice.check("resolve");
    mProfiler.end();
}

void Simulation::smooth() {
    if (mParams.smoothing == 0) return;
    mProfiler.begin("smooth");
    mPlanes.clear(); // traced to the end: their memory serves the other buffers
    std::vector<Buffer> others;
    for (const Buffer& result : mResults) others.emplace_back(mDevice, result.bytes());
    ResolveParams values{};
    values.size = mTracing.size;
    for (int pass = 0; pass < 3 * mParams.smoothing; ++pass) {
        values.planes.z = pass % 3;
        mResolveBlock.upload(&values, sizeof values);
        mResolveBlock.bindUniform(0);
        for (size_t i = 0; i < mResults.size(); ++i) {
            mResults[i].bindStorage(static_cast<unsigned>(i));
            others[i].bindStorage(6 + static_cast<unsigned>(i));
        }
        mSmooth.dispatch(mPlan.size);
        gpu::barrier();
        std::swap(mResults, others);
    }
    mDevice.check("smooth");
    mProfiler.end();
}

Result Simulation::download() {
    mProfiler.begin("download");
    const auto voxels = static_cast<size_t>(mPlan.voxels());
    std::vector<std::vector<float>> values;
    for (const Buffer& buffer : mResults) {
        values.emplace_back(voxels);
        buffer.download(values.back().data(), buffer.bytes());
    }
    const auto channels = static_cast<size_t>(mPlan.fluenceChannels());
    const auto fluence = [&](size_t c) -> const std::vector<float>& {
        return values[std::min(c, channels - 1)];
    };
    Result result;
    if (mPlan.wants(Output::fluence)) {
        result.fluence = {mPlan.size, 3, std::vector<float>(voxels * 3)};
        for (size_t i = 0; i < voxels; ++i)
            for (size_t c = 0; c < 3; ++c) result.fluence.values[3 * i + c] = fluence(c)[i];
    }
    if (mPlan.wants(Output::direction)) {
        result.direction = {mPlan.size, 3, std::vector<float>(voxels * 3, 0.0f)};
        const glm::mat3 turn(glm::dmat3(mVolume.frame().worldFromIndex) / mPlan.voxelSize);
        for (size_t i = 0; i < voxels; ++i) {
            const float power = fluence(0)[i] + fluence(1)[i] + fluence(2)[i];
            if (!(power > 0)) continue;
            glm::vec3 mean(values[channels][i], values[channels + 1][i], values[channels + 2][i]);
            mean /= power;
            const float length = glm::length(mean);
            if (length > 1) mean /= length; // rounding of the fixed-point sums
            mean = turn * mean;
            for (int c = 0; c < 3; ++c) result.direction.values[3 * i + c] = mean[c];
        }
    }
    mProfiler.end();
    return result;
}

} // namespace

Result simulate(gpu::Device& device, const volume::Volume& volume, const Plan& plan,
                const Params& params, Stats& stats, const Progress& progress) {
    device.requireFit(needsOf(plan, params));
    Simulation simulation(device, volume, plan, params, stats);
    Result result = simulation.run(progress);
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return result;
}

} // namespace eikonal::lightsim
