// Where a batch's energy went.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/energy.h"

#include <algorithm>

namespace eikonal::lightsim {

namespace {

using glm::dvec3;

// Work items that sum up a batch: enough to fill a device, few enough to read back.
constexpr unsigned kItems = 1024;

constexpr const char* kDropped[] = {"light_dropped_by_depth", "light_dropped_by_steps",
                                    "light_dropped_by_thinning", "light_dropped_as_dim"};

double meanOf(const Energy::Rgb& rgb) {
    return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

double shareOf(const Stats& stats, double power) {
    const double entered = meanOf(stats.energy.entered);
    return entered > 0 ? power / entered : 0;
}

} // namespace

EnergyMeter::EnergyMeter(gpu::Device& device)
    : mProgram(device, "lightsim/energy.comp.glsl", {}), mBlock(device, sizeof(PhotonParams)),
      mSums(device, kItems * static_cast<std::int64_t>(sizeof(EnergySum))) {}

BatchEnergy EnergyMeter::sum(const scene::Transport& transport, const Photons& photons) {
    PhotonParams values{};
    values.list = uvec4(0, kItems, 0, static_cast<unsigned>(photons.pixels));
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    transport.bind();
    photons.slots.bindStorage(kPhotonsBuffer);
    mSums.bindStorage(kEnergyBuffer);
    mProgram.dispatch({static_cast<int>(kItems), 1, 1});
    gpu::barrier();
    std::vector<EnergySum> sums(kItems);
    mSums.download(sums.data(), mSums.bytes());
    BatchEnergy batch;
    for (const EnergySum& sum : sums) {
        batch.remaining += dvec3(sum.remaining);
        batch.error = std::max(batch.error, static_cast<double>(sum.remaining.w));
        batch.absorbed += dvec3(sum.absorbed);
        batch.left += static_cast<double>(sum.absorbed.w);
        batch.scattered += dvec3(sum.scattered);
        batch.escaped += dvec3(sum.escaped);
        batch.dropped += glm::dvec4(sum.dropped);
        for (int i = 0; i < 4; ++i) batch.counts[static_cast<size_t>(i)] += sum.count[i];
    }
    return batch;
}

void book(Stats& stats, const Plan& plan, const Unit& unit, const BatchEnergy& emitted,
          const BatchEnergy& done) {
    Energy& energy = stats.energy;
    for (int c = 0; c < 3; ++c) {
        const double watts = unit.rgb[c] * unit.power;
        const auto i = static_cast<size_t>(c);
        const int channel = plan.colour ? c : 0;
        // What meets nothing has gone all its way already.
        const double entered =
            emitted.remaining[channel] + emitted.absorbed[channel] + emitted.scattered[channel];
        // A light with a place shines elsewhere, too; what it emits is booked once, by the light.
        if (!unit.isPoint) energy.emitted[i] += entered * watts;
        energy.entered[i] += entered * watts;
        energy.absorbed[i] += done.absorbed[channel] * watts;
        energy.scattered[i] += done.scattered[channel] * watts;
        energy.escaped[i] += done.escaped[channel] * watts;
        energy.lost[i] += (done.remaining[channel] - done.escaped[channel]) * watts;
    }
    const char* names[] = {"photons", "steps", "deposits", "trapped"};
    for (size_t i = 0; i < 4; ++i) stats.count(names[i], done.counts[i]);
    stats.count("atomic_adds", done.counts[2] * plan.planes());
}

glm::dvec4 book(Stats& stats, const Plan& plan, const Unit& unit, const BeamEnergy& done) {
    Energy& energy = stats.energy;
    glm::dvec4 dropped(0);
    for (int c = 0; c < 3; ++c) {
        const double watts = unit.rgb[c] * unit.power;
        const auto i = static_cast<size_t>(c);
        const int channel = plan.colour ? c : 0;
        const double lost = done.deep[channel] + done.trapped[channel] + done.dim[channel];
        if (!unit.isPoint) energy.emitted[i] += done.entered[channel] * watts;
        energy.entered[i] += done.entered[channel] * watts;
        energy.escaped[i] += done.left[channel] * watts;
        energy.lost[i] += lost * watts;
        // What else has gone media and mirrors have taken.
        energy.absorbed[i] += (done.entered[channel] - done.left[channel] - lost) * watts;
        dropped += glm::dvec4(done.deep[channel], done.trapped[channel], 0, done.dim[channel]) *
                   (watts / 3);
    }
    return dropped;
}

glm::dvec4 droppedPower(const Unit& unit, const BatchEnergy& done) {
    return done.dropped * (unit.power * (unit.rgb.x + unit.rgb.y + unit.rgb.z) / 3);
}

double leftPower(const Unit& unit, const BatchEnergy& done) {
    return done.left * unit.power * (unit.rgb.x + unit.rgb.y + unit.rgb.z) / 3;
}

void tellDropped(Stats& stats, const glm::dvec4& power) {
    for (int i = 0; i < 4; ++i) stats.count(kDropped[i], shareOf(stats, power[i]));
}

void tellLeft(Stats& stats, double power) {
    stats.count("light_left_after_bounces", shareOf(stats, power));
}

} // namespace eikonal::lightsim
