// What a level set's metadata say of an object's boundary, for scenes made by formula.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optics/materials.h"
#include "volume/volume.h"

namespace eikonal {

/// The object whose level set is that grid gets another boundary.
inline void setBoundary(volume::Volume& volume, const std::string& sdf, float roughness,
                        const char* metal = nullptr) {
    const volume::IndexBox box = volume.domain();
    volume::ObjectFacts facts;
    for (const volume::ObjectFacts& object : volume.objects())
        if (object.sdf == sdf) facts = object;
    facts.roughness = roughness;
    if (metal) {
        const optics::NamedMetal& named = *optics::findMetal(metal);
        facts.metal = volume::Metal{named.index, named.extinction};
    }
    volume.putLevelSet(facts, box, volume.dense(sdf, box), 1e3);
}

} // namespace eikonal
