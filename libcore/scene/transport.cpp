// A scene on the device, as shaders/transport reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/transport.h"

#include "scene/shared.h"
#include "scene/voxel_textures.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace eikonal::scene {

namespace {

/// dτ of a step that is no longer than that [voxel] where the index is highest.
double tauOf(const Scene& scene, double step) {
    return step / static_cast<double>(scene.index.most);
}

} // namespace

gpu::Switches transportSwitches(const Scene& scene, const optics::Tracing& tracing,
                                bool polarised) {
    const int crystals = scene.anyVaryingCrystal() ? 2 : scene.anyCrystal() || polarised ? 1 : 0;
    const bool bends = scene.index.varies();
    return {{"INTEGRATOR", tracing.integratorSwitch(bends)},
            {"FIELD", fieldSwitch(bends, tracing.sampling())},
            {"FAINT", !scene.index.rest.page.empty()},
            {"DISPERSION", scene.disperses},
            {"PAGED", scene.layout.paged},
            {"OBJECTS", static_cast<int>(scene.objects.size())},
            {"NEAR", scene.sharp && areMany(scene.objects) ? mostNear(scene.objects) : 0},
            {"PACKED", scene.sharp && isPacked(scene.objects)},
            {"VARIES", scene.sharp && scene.coefficientPages() > 0},
            {"OPAQUE", scene.anyOpaque()},
            {"METALS", scene.anyMetal()},
            {"ROUGH", scene.anyRough()},
            {"COATS", scene.firstCoated() != nullptr},
            {"CRYSTALS", crystals}};
}

std::vector<gpu::Need> transportNeeds(const Scene& scene, const optics::Tracing& tracing) {
    std::vector<gpu::Need> needs;
    if (scene.index.varies())
        needs.push_back(fieldNeed(scene.layout, tracing.sampling(), scene.disperses));
    needs.push_back(tableNeed(scene.layout));
    if (scene.sharp)
        for (const gpu::Need& need : boundaryNeeds(scene)) needs.push_back(need);
    return needs;
}

Transport::Transport(gpu::Device& device, const Scene& scene, const optics::Tracing& tracing,
                     const StepLengths& steps)
    : mSharp(scene.sharp) {
    const bool fitted =
        steps.equal && tracing.integrator == optics::Integrator::verlet && tracing.unbiased();
    const Index& index = scene.index;
    mField = index.varies() ? Field(device, index, scene.layout,
                                    {tracing.sampling(), tracing.unbiased(),
                                     fitted ? tauOf(scene, steps.longest) : 0})
                            : Field(device, index.least, scene.regions.front().dispersion.value.x);
    if (scene.disperses) mSpectrum = gpu::Buffer(device, sizeof(SpectrumParams));
    if (scene.sharp) mBoundaries = Boundaries(device, scene);
    if (scene.layout.paged) mVoxelTable = makeVoxelTable(device, scene.layout);
    TransportParams values{};
    values.halfSize = vec4(0.5f * glm::vec3(scene.size()), 0);
    values.scale = vec4(1.0f / glm::vec3(scene.layout.texels()), 0);
    values.steps = vec4(tauOf(scene, steps.longest), tauOf(scene, steps.shortest),
                        tauOf(scene, steps.first), steps.longest);
    values.tolerance = vec4(tracing.tolerance, glm::length(glm::dvec3(scene.size())),
                            2e6 * std::numbers::pi * scene.voxelSize() * steps.unit, 0);
    mParams = gpu::Buffer(device, sizeof values, &values);
}

void Transport::setLines(const std::vector<optics::Line>& lines) {
    if (mSpectrum.bytes() == 0) return;
    SpectrumParams values{};
    for (size_t i = 0; i < static_cast<size_t>(kLines); ++i)
        values.lines[i] = vec4(lines[i].weight, optics::cauchyTerm(lines[i].wavelength));
    mSpectrum.upload(&values, sizeof values);
}

void Transport::bind() const {
    if (mSpectrum.bytes() > 0) mSpectrum.bindUniform(kSpectrumBlock);
    mParams.bindUniform(kTransportBlock);
    mField.bind();
    if (mVoxelTable.name() != 0) mVoxelTable.bindSampler(kVoxelBlocksUnit);
    if (mSharp) mBoundaries.bind();
}

} // namespace eikonal::scene
