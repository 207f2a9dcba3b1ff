// What each effect binds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

namespace effects {

namespace {

#include "shared/bindings.h"

Bindings of(const std::vector<int>& blocks, const std::vector<int>& buffers,
            const std::vector<int>& textures) {
    Bindings bindings;
    for (const int number : blocks) bindings.insert({Binding::Kind::block, number});
    for (const int number : buffers) bindings.insert({Binding::Kind::buffer, number});
    for (const int number : textures) bindings.insert({Binding::Kind::texture, number});
    return bindings;
}

std::vector<Owned> viewBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kFieldBlock}, {kColoursBuffer, kCountersBuffer},
                    {})},
            {"refraction", of({}, {}, {kFieldUnit})},
            {"medium", of({}, {}, {kExtinctionUnit})},
            {"lobes", of({}, {}, {kDirectionUnit, kFluenceUnit})},
            {"emission beside lobes", of({}, {}, {kEmissionUnit})},
            {"environment map", of({}, {}, {kEnvironmentUnit})},
            // What light falls on a surface, and where it comes from, is looked up there.
            {"opaque surface", of({}, {}, {kDirectionUnit, kOpacityUnit, kFluenceUnit})},
            {"paths", of({}, {kPixelPathsBuffer}, {})}};
}

std::vector<Owned> sharpViewBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kSceneBlock}, {kColoursBuffer, kCountersBuffer},
                    {kDistancesUnit, kClearanceUnit, kBlocksUnit})},
            {"index that varies", of({kFieldBlock}, {}, {kFieldUnit})},
            {"scattering", of({}, {}, {kFluenceUnit})},
            {"lobes", of({}, {}, {kDirectionUnit})},
            {"absorption that varies", of({}, {}, {kAbsorptionsUnit, kScatteringsUnit})},
            {"environment map", of({}, {}, {kEnvironmentUnit})},
            {"several objects", of({}, {}, {kNearbyUnit})},
            {"many objects", of({}, {}, {kSetsUnit})},
            {"opaque object", of({}, {}, {kDirectionUnit, kFluenceUnit})},
            {"paths", of({}, {kPixelPathsBuffer}, {})}};
}

const std::vector<int> kPhotonBuffers{kCountBuffer, kPhotonsBuffer, kListBuffer, kNextListBuffer,
                                      kPlanesBuffer};

std::vector<Owned> photonBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kFieldBlock}, kPhotonBuffers, {})},
            {"refraction", of({}, {}, {kFieldUnit, kLeavesUnit})},
            {"medium", of({}, {}, {kAbsorptionUnit, kLeavesUnit})},
            // Sums of green and blue, or of the direction's components, are buffers of their own.
            {"colour", of({}, {kPlanesBuffer + 1, kPlanesBuffer + 2}, {kScatteringUnit})},
            {"direction", of({}, {kPlanesBuffer + 1, kPlanesBuffer + 2, kPlanesBuffer + 3}, {})},
            {"opaque surface", of({}, {}, {kOpaqueUnit})}};
}

std::vector<Owned> sharpPhotonBindings() {
    return {{"", of({kParamsBlock, kTransportBlock, kSceneBlock}, kPhotonBuffers,
                    {kDistancesUnit, kClearanceUnit, kBlocksUnit})},
            {"index that varies", of({kFieldBlock}, {}, {kLeavesUnit, kFieldUnit})},
            {"colour", of({}, {kPlanesBuffer + 1, kPlanesBuffer + 2}, {})},
            {"direction", of({}, {kPlanesBuffer + 1, kPlanesBuffer + 2, kPlanesBuffer + 3}, {})},
            {"absorption that varies", of({}, {}, {kAbsorptionsUnit, kScatteringsUnit})},
            {"several objects", of({}, {}, {kNearbyUnit})},
            {"many objects", of({}, {kObjectsBuffer}, {kSetsUnit})}};
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
    default:
        return sharpPhotonBindings();
    }
}

} // namespace effects
