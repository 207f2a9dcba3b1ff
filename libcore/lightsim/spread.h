// How kernels are told where a source shines (shaders/lightsim/spread.glsl).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/shared.h"
#include "lightsim/sources.h"

namespace eikonal::lightsim {

inline vec4 axisOf(const Source& source) {
    const bool cosine = source.spread == Source::Spread::cosine;
    const bool cone = source.spread == Source::Spread::cone;
    return {source.axis, cosine ? 1 : cone ? 2 : 0};
}

inline vec4 coneOf(const Source& source) {
    return {source.inner, source.outer, 0, 0};
}

} // namespace eikonal::lightsim
