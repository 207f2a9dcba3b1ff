// Pictures in any format: environment maps in, tone-mapped pictures for the eye out.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace eikonal::image {

/// How scene radiance becomes a value of the display in [0, 1], before the sRGB curve.
enum class ToneCurve {
    /// Linear up to 1, clipped there. The default, as in exrtopng, oiiotool and most renderers: the
    /// picture can be compared number for number, and a photograph seen straight through a scene
    /// comes out as it went in.
    clip,
    /// Narkowicz's fit of the ACES film curve ("ACES Filmic Tone Mapping Curve", 2016), each
    /// channel for itself: caustics roll off instead of burning out, midtones get contrast.
    filmic
};

struct ToneMap {
    double exposure = 0; ///< [stops]; radiance is multiplied by 2^exposure first
    ToneCurve curve = ToneCurve::clip;
    /// Whether alpha is written, the colours then divided by it, as PNG wants. Without it the
    /// picture stands over black. JPEG has no alpha and drops it.
    bool alpha = false;
};

/// The value in [0, 1] the display shows, before the sRGB curve; negative radiance gives 0.
double toneMapped(double radiance, const ToneMap& toneMap);

/// Interleaved sRGB bytes, 3 a pixel, or 4 with ToneMap::alpha, rounded to nearest and not
/// dithered. Without a channel A alpha is 1. Throws InternalError if R, G or B is missing.
std::vector<std::uint8_t> displayBytes(const Image& linear, const ToneMap& toneMap);

/// Whether an output of this name gets a picture for the eye: .png .jpg .jpeg .tga, in any case.
/// TIFF is not among them, since OpenImageIO puts a date into it.
bool isDisplayPicture(const std::string& path);

/// Throws MissingError if the module for formats other than EXR can't be loaded. Called before the
/// work by who will need it after the work.
void requirePictureModule();

/// Writes a tone-mapped sRGB picture in the format of the name's extension from the premultiplied
/// linear channels R G B and A, and finishes `out`. Same input, same bytes.
/// Throws InternalError for a sample, in any channel, that is NaN or infinite; UsageError if the
/// name is none of isDisplayPicture(); MissingError without the module; IoError if encoding or
/// writing fails.
void writePicture(const Image& linear, AtomicFile& out, const ToneMap& toneMap);

/// Reads a picture as linear floats: an EXR, known by its first bytes, through readExr(); any other
/// format through OpenImageIO, with channels Y, Y A, R G B or R G B A, alpha premultiplied, and
/// sRGB decoded. `layer` is an EXR's. Throws MissingError if the file or the module is missing,
/// DataError if it is no picture, MemoryError.
Image readPicture(const std::string& path, const std::string& layer = "");

/// What FILE:LAYER names; a file that has the whole name comes first.
struct PictureName {
    std::string path, layer;
};
PictureName parsePictureName(const std::string& text);

/// An environment map or a plate, and what was changed to make it one.
struct Environment {
    Image map; ///< exactly R, G and B, finite and not negative, in Rec. 709; no cube map
    std::vector<std::string> warnings;
};

/// Reads a picture as radiance, in any format; Y is spread. Throws as readPicture() and
/// makeRadiance().
Environment readPlate(const PictureName& name);

/// The same of a lat-long map; warns where it is not twice as wide as high.
Environment readEnvironment(const PictureName& name);

} // namespace eikonal::image
