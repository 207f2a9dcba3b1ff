// Pictures in memory: named planes of floats, as they come from a file and go to one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace eikonal::image {

/// What an EXR header says of the directions in a picture ('envmap' attribute).
enum class Envmap {
    none,    ///< nothing: a lat-long map's pixel centres lie at (i + ½) / width
    latLong, ///< ENVMAP_LATLONG: the outer pixels lie on the poles and on the seam (ImfEnvmap.h)
    cube     ///< ENVMAP_CUBE, which nothing here reads as directions
};

/// A picture. Channels are named the EXR way ("R", "A", "AR", "exit_position.X", "Z"). Samples are
/// planar, one whole plane per channel: pixels[(channel * height + y) * width + x], row 0 on top.
struct Image {
    int width = 0;  ///< [pixel]
    int height = 0; ///< [pixel]
    std::vector<std::string> channels;
    std::vector<float> pixels;
    Envmap envmap = Envmap::none; ///< set by readers, ignored by writers
    /// Where the file's R, G, B and white lie in the CIE's x, y, in this order; nothing: Rec. 709.
    /// Set by readers, ignored by writers.
    std::optional<std::array<double, 8>> chromaticities;

    Image() = default;
    /// No channels yet. Sizes below 1 throw InternalError.
    Image(int width, int height);

    /// Samples in one plane.
    size_t area() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }

    /// The index of the channel of that name.
    std::optional<size_t> find(std::string_view name) const;

    std::span<float> plane(size_t channel) {
        return std::span(pixels).subspan(channel * area(), area());
    }
    std::span<const float> plane(size_t channel) const {
        return std::span(pixels).subspan(channel * area(), area());
    }

    /// Appends one plane per name from samples that are interleaved, `stride` floats a pixel (as a
    /// device hands them back), of which the first names.size() are taken. Rows go top to bottom.
    /// Throws InternalError if the sizes don't fit or a name is empty or taken.
    void addChannels(const std::vector<std::string>& names, std::span<const float> interleaved,
                     size_t stride);
};

/// The named channels interleaved, names.size() floats a pixel. Throws InternalError for a channel
/// that is not there.
std::vector<float> interleaved(const Image& image, const std::vector<std::string>& names);

/// Throws InternalError, naming channel and pixel, if a sample is NaN or infinite, and also if the
/// image contradicts itself (no pixels, no channels, a plane missing, a name twice). `path` is the
/// output's name for the message.
void checkFinite(const Image& image, const std::string& path);

/// Makes radiance of what pictures hold. Infinite samples (a sun beyond half floats) become 65504,
/// the largest half; R, G and B of other chromaticities become Rec. 709's, with Bradford's
/// adaptation of the white; what is negative then (resized edges, colours out of gamut) becomes 0.
/// Returns a warning for each that names how many samples and the worst. Throws DataError, naming
/// channel and pixel, if one is NaN, which means nothing. `path` is the input's name for the
/// messages.
std::vector<std::string> makeRadiance(Image& image, const std::string& path);

/// What a picture of this size costs in memory, checked before a reader asks for it. Throws
/// DataError for sizes below 1 or above 2^17 pixels on a side (no device holds such a texture; a
/// header that says so is damaged), MemoryError if the machine has less memory than it takes.
void checkSize(long long width, long long height, size_t channels, const std::string& path);

} // namespace eikonal::image
