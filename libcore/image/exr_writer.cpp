// Writing OpenEXR: the last step of a render.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/exr.h"
#include "image/exr_stream.h"
#include "image/exr_workers.h"
#include "image/input.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <algorithm>
#include <cstring>
#include <new>
#include <sstream>
#include <thread>

namespace eikonal::image {

namespace {

/// For row vectors: M[i][j] takes input i to output j. GLM's m[column][row] has the same meaning
/// in the same order, so that the transposed matrix is an element-by-element copy.
Imath::M44f rowVectorMatrix(const glm::dmat4& m) {
    Imath::M44f out;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) out[i][j] = static_cast<float>(m[i][j]);
    return out;
}

Imf::Header headerOf(const Image& image, const ImageAttributes& attributes) {
    Imf::Header header(image.width, image.height, attributes.pixelAspectRatio);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // whose default is Rec. 709
    if (attributes.hasCamera) {
        Imf::addWorldToCamera(header, rowVectorMatrix(attributes.worldToCamera));
        Imf::addWorldToNDC(header, rowVectorMatrix(attributes.worldToNDC));
    }
    for (const auto& [name, text] : attributes.strings)
        header.insert(name, Imf::StringAttribute(text));
    for (const std::string& channel : image.channels)
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    return header;
}

Imf::FrameBuffer frameBufferOf(const Image& image) {
    Imf::FrameBuffer planes;
    for (size_t k = 0; k < image.channels.size(); ++k) {
        // OpenEXR has one slice type for reading and writing, hence the cast.
        char* const plane =
            reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + k * image.area()));
        planes.insert(image.channels[k],
                      Imf::Slice(Imf::FLOAT, plane, sizeof(float),
                                 sizeof(float) * static_cast<size_t>(image.width)));
    }
    return planes;
}

void encode(const Image& image, const ImageAttributes& attributes, std::ostream& stream,
            const std::string& path, int threads) {
    // Blocks are compressed in any order and written in theirs.
    if (threads == 0) threads = static_cast<int>(std::thread::hardware_concurrency());
    const ExrWorkers workers(threads);
    StreamOutput output(stream, path);
    {
        Imf::OutputFile file(output, headerOf(image, attributes), workers.count());
        file.setFrameBuffer(frameBufferOf(image));
        file.writePixels(image.height);
    }
    if (output.failed() || !stream.flush()) throw std::runtime_error("write failed");
}

/// Reads back what was written and compares it bit by bit. OpenEXR does not tell of a block of
/// lines that it could not compress (for want of memory, say): the file ends before it.
void verify(const Image& image, Imf::InputFile& file) {
    const auto incomplete = [](const std::string& what) {
        return std::runtime_error("was not written whole: " + what);
    };
    if (!file.isComplete()) throw incomplete("lines are missing");
    constexpr int kLines = 16; // a block of ZIP compression
    const auto width = static_cast<size_t>(image.width);
    std::vector<float> lines(width * kLines * image.channels.size());
    for (int y = 0; y < image.height; y += kLines) {
        const int rows = std::min(kLines, image.height - y);
        const Imath::Box2i part({0, y}, {image.width - 1, y + rows - 1});
        const size_t samples = width * static_cast<size_t>(rows);
        Imf::FrameBuffer planes;
        for (size_t k = 0; k < image.channels.size(); ++k)
            planes.insert(image.channels[k],
                          Imf::Slice::Make(Imf::FLOAT, lines.data() + k * samples, part,
                                           sizeof(float), sizeof(float) * width));
        file.setFrameBuffer(planes);
        file.readPixels(y, y + rows - 1);
        for (size_t k = 0; k < image.channels.size(); ++k)
            if (std::memcmp(lines.data() + k * samples,
                            image.plane(k).data() + width * static_cast<size_t>(y),
                            samples * sizeof(float)) != 0)
                throw incomplete("channel '" + image.channels[k] + "' reads back otherwise");
    }
}

} // namespace

void writeExr(const Image& image, const ImageAttributes& attributes, AtomicFile& out, int threads) {
    checkFinite(image, out.path());
    try {
        if (out.seekable()) {
            encode(image, attributes, out.stream(), out.path(), threads);
            Imf::InputFile file(out.temporaryPath().c_str(), 0);
            verify(image, file);
        } else {
            std::ostringstream whole;
            encode(image, attributes, whole, out.path(), threads);
            const std::string_view bytes = whole.view();
            MemoryInput input(bytes, out.path());
            Imf::InputFile file(input, 0);
            verify(image, file);
            out.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        }
    } catch (const std::bad_alloc&) {
        throw MemoryError(out.path() + ": not enough memory to write the picture");
    } catch (const std::exception& error) {
        out.finish(); // knows the system's reason, if that is what went wrong
        throw IoError(out.path() + ": " + oneLine(error.what()));
    }
    out.finish();
}

} // namespace eikonal::image
