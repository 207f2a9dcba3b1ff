// OpenEXR files: what a render leaves behind, and environment maps as they come in.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "image/image.h"

#include <glm/mat4x4.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eikonal::image {

/// What an EXR header says besides size and channels. Every header also states Rec. 709
/// chromaticities, and nothing that differs between two runs, such as a date.
struct ImageAttributes {
    /// Text attributes in any order: eikonal:tool, eikonal:version, eikonal:command, comments.
    std::vector<std::pair<std::string, std::string>> strings;

    /// Whether the matrices below mean something and are written.
    bool hasCamera = false;
    /// Both act on column vectors, as everywhere in this project: p_camera = worldToCamera * p.
    /// OpenEXR's M44f act on row vectors, p_camera = p * M, so the file holds the transposes.
    /// The spaces are OpenEXR's (ImfStandardAttributes.h): camera space is left-handed, x to the
    /// right, y up, z along the view; NDC is (0, 0) at the picture's upper left corner and (1, 1)
    /// at its lower right, after division by w.
    glm::dmat4 worldToCamera{1.0};
    glm::dmat4 worldToNDC{1.0};

    float pixelAspectRatio = 1; ///< width / height of a pixel
};

/// Writes all channels as 32-bit floats into a scanline EXR with ZIP compression, and finishes
/// `out`; committing it is the caller's. Same input, same bytes, whatever `threads` says (0: one
/// per core). An output that can't seek gets the file in one piece, built in memory.
/// Throws InternalError for a sample that is NaN or infinite, IoError if writing fails,
/// MemoryError.
void writeExr(const Image& image, const ImageAttributes& attributes, AtomicFile& out,
              int threads = 0);

/// Reads a flat picture, scanline or tiled (of a tiled one the finest level), as floats: every
/// full-resolution channel, in the file's alphabetical order. Of several parts it is the first with
/// colours, of several layers the unnamed one (R, G, B or Y), or else the only one, whose channels
/// lose its name; `layer` names another layer or part. The picture is the display window, 0 where
/// the data window does not reach; of an environment map ('envmap' attribute) it is the data
/// window, which is what ImfEnvmap.h maps to directions. Messages call the file `name`, or else
/// `path`. Throws MissingError if the file can't be opened; DataError if it is no EXR, is damaged
/// or incomplete, is deep or luminance/chroma, has no colours or several layers to choose from;
/// MemoryError.
Image readExr(const std::string& path, const std::string& layer = "", const std::string& name = "");

/// Reads these channels, in this order, of the first flat part that has them all; otherwise as
/// above. Throws DataError naming the first that the file lacks.
Image readExrChannels(const std::string& path, const std::vector<std::string>& channels);

} // namespace eikonal::image
