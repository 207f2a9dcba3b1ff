// The line between the library and the module that knows OpenImageIO: plain C data, no exceptions.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace eikonal::image {

/// Bumped whenever anything below changes; a module of another number is refused.
inline constexpr int kPictureModuleVersion = 1;

/// Called once with the picture's size before pixels arrive. `channels` is 1 (Y), 2 (Y A), 3 (R G
/// B) or 4 (R G B A). Returns where the module puts width * height * channels interleaved floats,
/// or null to stop.
using PictureAllocator = float* (*)(void* context, int width, int height, int channels);

/// Called with the encoded file piece by piece, in order. Returns whether to go on.
using PictureSink = bool (*)(void* context, const void* bytes, size_t size);

/// The functions of a module, returned by its one symbol, kPictureModuleSymbol. They return whether
/// they succeeded; if not, a message of at most messageSize - 1 characters is in `message`. They
/// are called from one thread at a time.
struct PictureModule {
    int version; ///< kPictureModuleVersion as the module was built with

    /// Reads the file at `path`, in any format, as linear values with premultiplied alpha. Stated
    /// sRGB, or 8 and 16 bits with nothing stated, is decoded by the sRGB curve.
    bool (*decode)(const char* path, PictureAllocator allocate, void* context, char* message,
                   size_t messageSize);

    /// Encodes sRGB bytes, interleaved, 3 (R G B) or 4 (R G B A, A not multiplied in) a pixel, into
    /// the format of the extension, "png".
    bool (*encode)(const char* extension, int width, int height, int channels,
                   const unsigned char* pixels, PictureSink sink, void* context, char* message,
                   size_t messageSize);
};

inline constexpr const char* kPictureModuleSymbol = "eikonalPictureModule";
inline constexpr const char* kPictureModuleFile = "libeikonal_oiio.so";

using PictureModuleEntry = const PictureModule* (*)();

/// The module, from the folder that EIKONAL_MODULES names or else from ../lib/eikonal beside the
/// folder of the running program. Throws MissingError naming the file and the loader's reason.
/// It stays loaded: OpenImageIO leaves threads behind that must not lose their code.
const PictureModule& pictureModule();

} // namespace eikonal::image
