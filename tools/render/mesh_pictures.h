// render's pictures of meshes: in image space, or traced exactly.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/session.h"
#include "render/options.h"

namespace eikonal {

void renderMeshes(tool::Session& session, Options& o);

} // namespace eikonal
