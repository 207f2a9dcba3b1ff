// The light stage: photons through a scene volume, fluence and direction out (Sun et al. 2008).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/lightsim.h"

#include "gpu/program.h"
#include "lightsim/octree.h"
#include "lightsim/photon_map.h"
#include "lightsim/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
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

// As in shaders/lightsim/ledger.glsl.
constexpr double kFixedOne = 4194304.0;
constexpr size_t kLedgerSlots = 256, kAccounts = 16;
enum Account : size_t {
    emitted = 0,
    absorbed = 1,
    scattered = 4,
    escaped = 7,
    lost = 10,
    steps = 13,
    deposits = 14,
    trapped = 15
};

// Steps a photon makes in one launch before the list is thinned: enough for the photons that meet
// no boundary to be through, few enough that those done do not hold up their neighbours for long.
constexpr unsigned kStepsPerLaunch = 48;

// Resolved before more than this could have met in one voxel; see the planes in march.comp.glsl.
constexpr std::int64_t kPhotonsPerResolve = 1 << 24;

/// Voxel space has its origin at the domain's first voxel.
glm::dmat4 voxelFromWorld(const volume::Volume& volume) {
    glm::dmat4 matrix = volume.frame().indexFromWorld();
    matrix[3] -= glm::dvec4(dvec3(volume.domain().min), 0.0);
    return matrix;
}

/// The light with its position or direction in voxel space.
Light toVoxels(const Light& light, const glm::dmat4& voxelFromWorld) {
    Light out = light;
    const bool point = light.kind == Light::Kind::point;
    out.vector = dvec3(voxelFromWorld * glm::dvec4(light.vector, point ? 1.0 : 0.0));
    if (!point) out.vector = glm::normalize(out.vector);
    return out;
}

std::vector<glm::vec4> boxTriangles(const VoxelBox& box) {
    const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<glm::vec4> corners;
    for (const auto& face : faces)
        for (int i : {0, 1, 2, 0, 2, 3}) {
            const int c = face[i];
            corners.emplace_back(c & 1 ? box.high.x : box.low.x, c & 2 ? box.high.y : box.low.y,
                                 c & 4 ? box.high.z : box.low.z, 1.0);
        }
    return corners;
}

/// One simulation: what is on the device for its duration, and the loop over lights and batches.
class Simulation {
public:
    Simulation(gpu::Device& device, const volume::Volume& volume, const Plan& plan,
               const Params& params, Stats& stats);
    Result run(const Progress& progress);

private:
    void uploadMedium();
    void uploadEmitter();
    void traceLight(const Light& light, const Progress& progress);
    void traceBatch(const Window& window, double weightScale, const Progress& progress);
    std::uint32_t bear(const Window& window, double weight);
    std::uint32_t march(std::uint32_t count, const Progress& progress, std::uint32_t born);
    void dropRest(std::uint32_t count);
    std::uint32_t takeCount();
    void resolve(const Light& light, double powerPerWeight);
    void bookEnergy(const Light& light, double powerPerWeight);
    void smooth();
    Result download();
    void dispatchVoxels(const Program& program) const;

    gpu::Device& mDevice;
    const volume::Volume& mVolume;
    const Plan& mPlan;
    const Params& mParams;
    Stats& mStats;
    gpu::Profiler mProfiler;

    glm::dmat4 mVoxelFromWorld;
    VoxelBox mDomain, mTarget;
    Texture mField, mLeaves, mAbsorption, mScattering, mOpaque, mMap;
    Buffer mEmitter, mLedger, mParamsBlock, mBirthBlock, mResolveBlock;
    Buffer mPhotons[2];
    std::vector<Buffer> mPlanes, mFluence, mDirection;
    std::int64_t mEmitterVertices = 0;
    std::int64_t mUnresolved = 0;
    PhotonParams mTracing{};
    Program mBirthMap, mBirth, mMarch, mResolve, mSmooth;
    double mLostWeights[3] = {0, 0, 0}; // of photons that thinning left over
};

Simulation::Simulation(gpu::Device& device, const volume::Volume& volume, const Plan& plan,
                       const Params& params, Stats& stats)
    : mDevice(device), mVolume(volume), mPlan(plan), mParams(params), mStats(stats),
      mProfiler(stats), mVoxelFromWorld(voxelFromWorld(volume)) {
    mDomain = {dvec3(-0.5), dvec3(plan.size) - 0.5};
    const bool direction = plan.wants(Output::direction);
    mBirthMap = Program(device, "lightsim/birth.vert.glsl", "lightsim/birth.frag.glsl", {});
    mBirth = Program(device, "lightsim/birth.comp.glsl", {{"BEND", plan.bends}});
    mMarch = Program(device, "lightsim/march.comp.glsl",
                     {{"BEND", plan.bends},
                      {"CHANNELS", plan.tracedChannels()},
                      {"MEDIUM", plan.attenuates},
                      {"DIRECTION", direction},
                      {"OPAQUE", plan.opaque}});
    mResolve = Program(device, "lightsim/resolve.comp.glsl", {});
    if (params.smoothing > 0) mSmooth = Program(device, "lightsim/smooth.comp.glsl", {});

    uploadMedium();
    uploadEmitter();
    const std::int64_t voxels = plan.voxels();
    for (int i = 0; i < plan.planes(); ++i) mPlanes.emplace_back(device, voxels * 8);
    for (int i = 0; i < plan.fluenceChannels(); ++i) mFluence.emplace_back(device, voxels * 4);
    for (int i = 0; i < (direction ? 3 : 0); ++i) mDirection.emplace_back(device, voxels * 4);
    for (auto* buffers : {&mPlanes, &mFluence, &mDirection})
        for (Buffer& buffer : *buffers) buffer.clear();
    mLedger = Buffer(device, 16 + kLedgerSlots * kAccounts * 8);
    mLedger.clear();
    mParamsBlock = Buffer(device, sizeof(PhotonParams));
    mBirthBlock = Buffer(device, sizeof(BirthParams));
    mResolveBlock = Buffer(device, sizeof(ResolveParams));

    mTracing.size = ivec4(plan.size, static_cast<int>(voxels));
    mTracing.list = uvec4(0, kStepsPerLaunch, params.maxSteps, 0);
    mTracing.limits = vec4(params.stepMin, params.dropBelow, 0, 0);
    mTracing.index = vec4(plan.index.least, 0, 0, 0);
}

void Simulation::uploadMedium() {
    mProfiler.begin("medium");
    const auto texture = [&](gpu::TexelFormat format, const void* data) {
        Texture made(mDevice, mPlan.size, format, gpu::Filter::nearest);
        made.upload(data);
        return made;
    };
    const auto voxels = static_cast<size_t>(mPlan.voxels());
    const auto perVoxel = static_cast<float>(mPlan.voxelSize); // 1/unit to 1/voxel
    if (mPlan.attenuates && !mPlan.colour) {
        std::vector<float> both(voxels * 2);
        for (size_t i = 0; i < voxels; ++i) {
            both[2 * i] = mPlan.absorption.at(i, 0) * perVoxel;
            both[2 * i + 1] = mPlan.scattering.at(i, 0) * perVoxel;
        }
        mAbsorption = texture(gpu::TexelFormat::rg32f, both.data());
    } else if (mPlan.attenuates) {
        std::vector<float> rgba(voxels * 4);
        for (auto [from, to] :
             {std::pair{&mPlan.absorption, &mAbsorption}, {&mPlan.scattering, &mScattering}}) {
            for (size_t i = 0; i < voxels; ++i)
                for (int c = 0; c < 3; ++c) rgba[4 * i + c] = from->at(i, c) * perVoxel;
            *to = texture(gpu::TexelFormat::rgba32f, rgba.data());
        }
    }
    if (mPlan.opaque) {
        std::vector<std::uint8_t> solid(voxels);
        for (size_t i = 0; i < voxels; ++i) solid[i] = mPlan.opacity.grid.values[i] > 0.5f;
        mOpaque = texture(gpu::TexelFormat::r8ui, solid.data());
    }
    if (mPlan.bends) mField = medium::makeField(mDevice, mPlan.index.grid);
    mProfiler.end();
    if (!mPlan.bends) return;
    mProfiler.begin("octree");
    mLeaves = makeOctree(mDevice, mPlan.index.grid, mParams);
    mProfiler.end();
}

void Simulation::uploadEmitter() {
    std::vector<glm::vec4> corners;
    mTarget = mDomain;
    if (mParams.proxy.empty()) {
        corners = boxTriangles(mDomain);
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
    const double total = light.rgb.x + light.rgb.y + light.rgb.z;
    if (total <= 0) return;
    mTracing.colour = vec4(light.rgb / total, 0);
    // The golden ratio's powers spread successive seeds evenly over a pixel.
    const dvec2 shift = glm::fract(static_cast<double>(mParams.seed) *
                                   dvec2(0.7548776662466927, 0.5698402909980532));
    const std::vector<Window> windows =
        windowsOf(light, mTarget, mDomain, mParams.photons, shift, !mParams.proxy.empty());
    for (size_t w = 0; w < windows.size(); ++w) {
        const Window& window = windows[w];
        const double h = mPlan.voxelSize;
        // Radiant power per unit of the light's RGB in a photon of weight 1 [m² or sr].
        const double power = window.pixelArea() * (window.point ? 1.0 : h * h);
        const double pixels = static_cast<double>(window.pixels.x) * window.pixels.y;
        const int b = std::max(
            1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(kBatchPixels)))));
        for (int batch = 0; batch < b * b; ++batch) {
            const double done = static_cast<double>(w) + batch / static_cast<double>(b * b);
            const double last = static_cast<double>(w) + (batch + 1) / static_cast<double>(b * b);
            const auto all = static_cast<double>(windows.size());
            traceBatch(window.batch(batch % b, batch / b, b), 1.0,
                       partOf(progress, done / all, last / all));
            if (mUnresolved + kBatchPixels > kPhotonsPerResolve) resolve(light, power);
        }
        // A window's photons have their own power.
        resolve(light, power);
        bookEnergy(light, power);
    }
}

void Simulation::traceBatch(const Window& window, double weight, const Progress& progress) {
    const std::uint32_t born = bear(window, weight);
    mStats.count("photons", born);
    mUnresolved += born;
    const auto few = static_cast<std::uint32_t>(mParams.thinTo * born);
    std::uint32_t count = born;
    while (count > few) count = march(count, progress, born);
    dropRest(count);
    report(progress, 1.0);
}

std::uint32_t Simulation::takeCount() {
    std::uint32_t count = 0;
    mLedger.download(&count, sizeof count);
    const std::uint32_t zero = 0;
    mLedger.upload(&zero, sizeof zero);
    return count;
}

std::uint32_t Simulation::bear(const Window& window, double weight) {
    mProfiler.begin("photon birth");
    if (mMap.name() == 0 || mMap.size() != ivec3(window.pixels, 0)) {
        mMap = Texture();
        mMap = Texture(mDevice, ivec3(window.pixels, 0), gpu::TexelFormat::rgba32f,
                       gpu::Filter::nearest);
        for (Buffer& list : mPhotons) {
            list = Buffer();
            list = Buffer(mDevice, std::int64_t{window.pixels.x} * window.pixels.y *
                                       static_cast<std::int64_t>(sizeof(Photon)));
        }
    }
    mMap.clear();
    BirthParams birth{};
    birth.clipFromVoxel = mat4(window.clipFromVoxel());
    birth.right = vec4(window.right, 0);
    birth.up = vec4(window.up, 0);
    birth.forward = vec4(window.forward, 0);
    birth.window = vec4(window.low, window.extent);
    birth.origin = vec4(window.origin, window.startsAtLight ? 1 : 0);
    birth.low = vec4(mDomain.low, 0);
    birth.high = vec4(mDomain.high, 0);
    birth.weight = vec4(weight, window.point ? 1 : 0, 0, 0);
    birth.map = ivec4(window.pixels, 0, 0);
    mBirthBlock.upload(&birth, sizeof birth);
    mParamsBlock.upload(&mTracing, sizeof mTracing);
    mBirthBlock.bindUniform(0);
    mParamsBlock.bindUniform(1);
    if (!window.startsAtLight) {
        mEmitter.bindStorage(0);
        gpu::drawTriangles(mBirthMap, mEmitterVertices, window.pixels.x, window.pixels.y, &mMap);
        gpu::barrier();
    }
    mLedger.bindStorage(0);
    mPhotons[0].bindStorage(1);
    mMap.bindSampler(0);
    if (mPlan.bends) mField.bindSampler(1);
    mBirth.dispatch({window.pixels, 1});
    gpu::barrier();
    mDevice.check("photon birth");
    const std::uint32_t born = takeCount();
    mProfiler.end();
    return born;
}

std::uint32_t Simulation::march(std::uint32_t count, const Progress& progress, std::uint32_t born) {
    mProfiler.begin("photons");
    mTracing.list.x = count;
    mParamsBlock.upload(&mTracing, sizeof mTracing);
    mParamsBlock.bindUniform(0);
    mLedger.bindStorage(0);
    mPhotons[0].bindStorage(1);
    mPhotons[1].bindStorage(2);
    for (size_t i = 0; i < mPlanes.size(); ++i)
        mPlanes[i].bindStorage(3 + static_cast<unsigned>(i));
    if (mPlan.bends) {
        mField.bindSampler(1);
        mLeaves.bindSampler(2);
    }
    if (mPlan.attenuates) mAbsorption.bindSampler(3);
    if (mPlan.attenuates && mPlan.colour) mScattering.bindSampler(4);
    if (mPlan.opaque) mOpaque.bindSampler(5);
    mMarch.dispatch({static_cast<int>(count), 1, 1});
    gpu::barrier();
    mDevice.check("photons");
    const std::uint32_t left = takeCount();
    mProfiler.end();
    std::swap(mPhotons[0], mPhotons[1]);
    report(progress, 1.0 - static_cast<double>(left) / born);
    return left;
}

void Simulation::dropRest(std::uint32_t count) {
    if (count == 0) return;
    std::vector<Photon> rest(count);
    mPhotons[0].download(rest.data(), static_cast<std::int64_t>(count * sizeof(Photon)));
    mStats.count("photons_left_by_thinning", count);
    // In order of weight, since the list's own order differs between runs.
    for (int c = 0; c < 3; ++c) {
        std::vector<float> weights;
        for (const Photon& photon : rest)
            weights.push_back(c == 0 || !mPlan.colour ? photon.place.w
                              : c == 1                ? photon.wave.w
                                                      : photon.state.x);
        std::sort(weights.begin(), weights.end());
        for (float weight : weights) mLostWeights[c] += static_cast<double>(weight);
    }
}

void Simulation::dispatchVoxels(const Program& program) const {
    // Rows of 2^20 voxels: one dimension alone holds 65,535 groups at least, not more.
    const std::int64_t row = 1 << 20;
    const std::int64_t voxels = mPlan.voxels();
    program.dispatch(
        {static_cast<int>(std::min(voxels, row)), static_cast<int>((voxels + row - 1) / row), 1});
}

void Simulation::resolve(const Light& light, double powerPerWeight) {
    mProfiler.begin("resolve");
    const double h = mPlan.voxelSize;
    // Track-length estimate: power × path length / voxel volume. [1/m² per unit of fixed point]
    const double unit = powerPerWeight / (h * h) / kFixedOne;
    const int traced = mPlan.tracedChannels(), fluence = mPlan.fluenceChannels();
    ResolveParams values{};
    values.size = mTracing.size;
    const auto resolvePlane = [&](size_t plane, int targets) {
        values.planes.y = targets;
        mResolveBlock.upload(&values, sizeof values);
        mResolveBlock.bindUniform(0);
        mPlanes[plane].bindStorage(0);
        dispatchVoxels(mResolve);
        gpu::barrier();
    };
    for (int c = 0; c < traced; ++c) {
        const bool spread = traced == 1 && fluence == 3;
        values.fluence = vec4(unit * (spread ? light.rgb : dvec3(light.rgb[c])), 0);
        mFluence[static_cast<size_t>(c)].bindStorage(1);
        if (spread) {
            mFluence[1].bindStorage(2);
            mFluence[2].bindStorage(3);
        }
        resolvePlane(static_cast<size_t>(c), spread ? 3 : 1);
    }
    const double total = light.rgb.x + light.rgb.y + light.rgb.z;
    for (size_t axis = 0; axis < mDirection.size(); ++axis) {
        values.fluence = vec4(unit * total, 0, 0, 0);
        mDirection[axis].bindStorage(1);
        resolvePlane(static_cast<size_t>(traced) + axis, 1);
    }
    mDevice.check("resolve");
    mProfiler.end();
    mUnresolved = 0;
}

void Simulation::bookEnergy(const Light& light, double powerPerWeight) {
    std::vector<std::uint64_t> ledger(kLedgerSlots * kAccounts);
    mLedger.download(ledger.data(), static_cast<std::int64_t>(ledger.size() * 8), 16);
    mLedger.clear();
    std::array<double, kAccounts> sums{};
    for (size_t slot = 0; slot < kLedgerSlots; ++slot)
        for (size_t account = 0; account < kAccounts; ++account)
            sums[account] += static_cast<double>(ledger[slot * kAccounts + account]);
    mStats.hasEnergy = true;
    Energy& energy = mStats.energy;
    for (int c = 0; c < 3; ++c) {
        const double watts = light.rgb[c] * powerPerWeight;
        const auto i = static_cast<size_t>(c);
        const size_t channel = mPlan.colour ? i : 0;
        energy.emitted[i] += sums[emitted] / kFixedOne * watts;
        energy.entered[i] += sums[emitted] / kFixedOne * watts;
        energy.absorbed[i] += sums[absorbed + channel] / kFixedOne * watts;
        energy.scattered[i] += sums[scattered + channel] / kFixedOne * watts;
        energy.escaped[i] += sums[escaped + channel] / kFixedOne * watts;
        energy.lost[i] += (sums[lost + channel] / kFixedOne + mLostWeights[channel]) * watts;
    }
    std::fill(std::begin(mLostWeights), std::end(mLostWeights), 0.0);
    mStats.count("steps", sums[steps]);
    mStats.count("deposits", sums[deposits]);
    mStats.count("atomic_adds", sums[deposits] * static_cast<double>(mPlanes.size()));
    mStats.count("trapped", sums[trapped]);
}

void Simulation::smooth() {
    if (mParams.smoothing == 0) return;
    mProfiler.begin("smooth");
    mPlanes.clear(); // traced to the end: their memory serves the scratch buffer
    Buffer scratch(mDevice, mPlan.voxels() * 4);
    ResolveParams values{};
    values.size = mTracing.size;
    for (auto* buffers : {&mFluence, &mDirection})
        for (Buffer& buffer : *buffers)
            for (int pass = 0; pass < 3 * mParams.smoothing; ++pass) {
                values.planes.z = pass % 3;
                mResolveBlock.upload(&values, sizeof values);
                mResolveBlock.bindUniform(0);
                buffer.bindStorage(0);
                scratch.bindStorage(1);
                mSmooth.dispatch(mPlan.size);
                gpu::barrier();
                std::swap(buffer, scratch);
            }
    mDevice.check("smooth");
    mProfiler.end();
}

Result Simulation::download() {
    mProfiler.begin("download");
    const auto voxels = static_cast<size_t>(mPlan.voxels());
    const auto fetch = [&](const Buffer& buffer) {
        std::vector<float> values(voxels);
        buffer.download(values.data(), buffer.bytes());
        return values;
    };
    Result result;
    std::vector<std::vector<float>> fluence, direction;
    for (const Buffer& buffer : mFluence) fluence.push_back(fetch(buffer));
    for (const Buffer& buffer : mDirection) direction.push_back(fetch(buffer));
    const auto channel = [&](size_t c) -> const std::vector<float>& {
        return fluence[std::min(c, fluence.size() - 1)];
    };
    if (mPlan.wants(Output::fluence)) {
        result.fluence = {mPlan.size, 3, std::vector<float>(voxels * 3)};
        for (size_t c = 0; c < 3; ++c)
            for (size_t i = 0; i < voxels; ++i) result.fluence.values[3 * i + c] = channel(c)[i];
    }
    if (mPlan.wants(Output::direction)) {
        result.direction = {mPlan.size, 3, std::vector<float>(voxels * 3, 0.0f)};
        const glm::dmat3 worldFromVoxel(mVolume.frame().worldFromIndex);
        const glm::mat3 turn(worldFromVoxel / mPlan.voxelSize);
        for (size_t i = 0; i < voxels; ++i) {
            const float power = channel(0)[i] + channel(1)[i] + channel(2)[i];
            if (!(power > 0)) continue;
            glm::vec3 mean = glm::vec3(direction[0][i], direction[1][i], direction[2][i]) / power;
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
