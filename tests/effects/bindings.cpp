// What each effect binds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

namespace effects {

namespace {

#include "shared/bindings.h"

Bindings of(const std::vector<int>& blocks, const std::vector<int>& buffers,
            const std::vector<int>& textures, const std::vector<int>& images = {}) {
    Bindings bindings;
    for (const int number : blocks) bindings.insert({Binding::Kind::block, number});
    for (const int number : buffers) bindings.insert({Binding::Kind::buffer, number});
    for (const int number : textures) bindings.insert({Binding::Kind::texture, number});
    for (const int number : images) bindings.insert({Binding::Kind::image, number});
    return bindings;
}

std::vector<Owned> viewBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kFieldBlock}, {kColoursBuffer, kCountersBuffer},
                    {})},
            {"refraction", of({}, {}, {kFieldUnit})},
            {"medium", of({}, {}, {kExtinctionUnit})},
            {"lobes", of({}, {}, {kDirectionUnit, kFluenceUnit})},
            {"emission beside lobes", of({}, {}, {kEmissionUnit})},
            {"dispersion", of({kSpectrumBlock}, {}, {kDispersedFieldUnit})},
            {"environment map", of({}, {}, {kEnvironmentUnit})},
            {"plate", of({kPlateBlock}, {}, {kPlateUnit})},
            // What light falls on a surface is looked up there.
            {"opaque surface",
             of({kSurfaceBlock}, {},
                {kOpacityUnit, kIrradianceUnit, kSurfaceTableUnit, kSurfaceRecordsUnit})},
            {"points", of({}, {}, {kPointPlacesUnit, kPointLightsUnit})},
            {"paths", of({}, {kPixelPathsBuffer}, {})}};
}

std::vector<Owned> sharpViewBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kSceneBlock},
                    {kColoursBuffer, kCountersBuffer, kRestsBuffer},
                    {kDistancesUnit, kClearanceUnit, kBlocksUnit})},
            {"index that varies", of({kFieldBlock}, {}, {kFieldUnit})},
            {"dispersion", of({kSpectrumBlock}, {}, {})},
            {"scattering", of({}, {}, {kFluenceUnit})},
            {"lobes", of({}, {}, {kDirectionUnit})},
            {"absorption that varies", of({}, {}, {kAbsorptionsUnit, kScatteringsUnit})},
            {"crystals that vary", of({}, {}, {kCrystalsUnit, kMixedCrystalsUnit})},
            {"environment map", of({}, {}, {kEnvironmentUnit})},
            {"several objects", of({}, {}, {kNearbyUnit})},
            {"many objects", of({}, {}, {kSetsUnit})},
            {"opaque object",
             of({kSurfaceBlock}, {}, {kIrradianceUnit, kSurfaceTableUnit, kSurfaceRecordsUnit})},
            {"points", of({}, {}, {kPointPlacesUnit, kPointLightsUnit})},
            {"ground", of({kGroundBlock}, {}, {})},
            {"paths", of({}, {kPixelPathsBuffer}, {})}};
}

const std::vector<int> kPhotonBuffers{kCountBuffer, kPhotonsBuffer, kListBuffer, kNextListBuffer};

std::vector<Owned> photonBindings() {
    return {
        {"", of({kParamsBlock, kTransportBlock, kFieldBlock}, kPhotonBuffers, {}, {kPlanesImage})},
        {"refraction", of({}, {}, {kFieldUnit, kLeavesUnit})},
        {"medium", of({}, {}, {kAbsorptionUnit, kLeavesUnit})},
        {"colour", of({}, {}, {kScatteringUnit})},
        {"dispersion", of({kSpectrumBlock}, {}, {kDispersedFieldUnit})},
        {"direction", {}},
        {"opaque surface", of({}, {}, {kOpaqueUnit})},
        {"lit surface", of({kSurfaceBlock}, {kSurfaceSumsBuffer},
                           {kOpacityFieldUnit, kSurfaceTableUnit, kSurfaceRecordsUnit})}};
}

std::vector<Owned> sharpPhotonBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kSceneBlock}, kPhotonBuffers,
                    {kDistancesUnit, kClearanceUnit, kBlocksUnit}, {kPlanesImage})},
            {"index that varies", of({kFieldBlock}, {}, {kLeavesUnit, kFieldUnit})},
            {"colour", {}},
            {"dispersion", of({kSpectrumBlock}, {}, {})},
            {"direction", {}},
            {"absorption that varies", of({}, {}, {kAbsorptionsUnit, kScatteringsUnit})},
            {"crystals", of({}, {kPolarisationsBuffer}, {})},
            {"crystals that vary", of({}, {}, {kCrystalsUnit, kMixedCrystalsUnit})},
            {"several objects", of({}, {}, {kNearbyUnit})},
            {"lit surface",
             of({kSurfaceBlock}, {kSurfaceSumsBuffer}, {kSurfaceTableUnit, kSurfaceRecordsUnit})},
            {"many objects", of({}, {kObjectsBuffer}, {kSetsUnit})}};
}

std::vector<Owned> beamBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kSceneBlock},
                    {kPointsBuffer, kParentsBuffer, kWantedBuffer},
                    {kDistancesUnit, kClearanceUnit, kBlocksUnit, kNearbyUnit})},
            {"index that varies", of({kFieldBlock}, {}, {kLeavesUnit, kFieldUnit})},
            {"colour", {}},
            {"dispersion", of({kSpectrumBlock}, {}, {})},
            {"absorption that varies", of({}, {}, {kAbsorptionsUnit, kScatteringsUnit})},
            {"crystals", {}},
            {"crystals that vary", of({}, {}, {kCrystalsUnit, kMixedCrystalsUnit})},
            {"many objects", of({}, {kObjectsBuffer, kParentObjectsBuffer}, {kSetsUnit})}};
}

} // namespace

std::vector<Owned> bindingsOf(Family family) {
    switch (family) {
    case Family::view:
        return viewBindings();
    case Family::sharpView:
        return sharpViewBindings();
    case Family::photons:
        return photonBindings();
    case Family::sharpPhotons:
        return sharpPhotonBindings();
    default:
        return beamBindings();
    }
}

} // namespace effects
