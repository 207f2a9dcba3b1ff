// An environment map as a light: directions that stand for parts of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/sources.h"

namespace eikonal::lightsim {

/// At most `count` parallel sources of about equal worth (the median cut of Debevec 2005, SIGGRAPH
/// posters): the map is cut in two, the part of most power times extent first, along its longer
/// side where its power is halved. A part's source comes from the middle of it, and has the whole
/// of its power, or less by as much as gives a surface that sees all of the part what it gets from
/// it. Parts without light have none. In the world.
std::vector<Source> environmentSources(const Light& light, int count, Keep keep);

/// What falls on a plane that faces up (+Y) and sees all of the upper half [W/m²].
glm::dvec3 upwardIrradiance(const Light& environment);

} // namespace eikonal::lightsim
