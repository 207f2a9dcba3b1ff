// What render writes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "common/session.h"
#include "image/image.h"
#include "render/options.h"

#include <memory>
#include <span>
#include <string>

namespace eikonal {

/// One picture to each output, in the format of its name. `before` are the commands that made what
/// it shows, oldest first.
void writePictures(tool::Session& session, std::span<const std::unique_ptr<AtomicFile>> outputs,
                   const Options& o, const std::string& before, const image::Image& picture);

/// A name that promises a format we don't write is refused; devices and FIFOs get EXR. Throws
/// UsageError.
void checkOutput(const std::string& path);

} // namespace eikonal
