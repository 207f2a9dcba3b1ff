// Writing OpenEXR: the last step of a render.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <new>
#include <sstream>
#include <thread>

namespace eikonal::image {

namespace {

/// OpenEXR's way to a std::ostream. It remembers a failure, since the destructor of
/// Imf::OutputFile, which writes the table of line offsets, swallows exceptions.
class StreamOutput : public Imf::OStream {
public:
    StreamOutput(std::ostream& stream, const std::string& path)
        : Imf::OStream(path.c_str()), mStream(stream) {}

    void write(const char bytes[], int count) override {
        mStream.write(bytes, count);
        mPosition += static_cast<uint64_t>(count);
        check();
    }
    uint64_t tellp() override { return mPosition; }
    void seekp(uint64_t position) override {
        mStream.seekp(static_cast<std::streamoff>(position));
        mPosition = position;
        check();
    }
    bool failed() const { return mFailed; }

private:
    void check() {
        if (mStream) return;
        mFailed = true;
        throw std::runtime_error("write failed");
    }
    std::ostream& mStream;
    uint64_t mPosition = 0; // the outputs start empty
    bool mFailed = false;
};

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
    // The pool is OpenEXR's and the process's own. Blocks are compressed in any order and written
    // in theirs; 0 means that the caller's thread does the work.
    if (threads == 0) threads = static_cast<int>(std::thread::hardware_concurrency());
    const int workers = threads > 1 ? threads : 0;
    if (Imf::globalThreadCount() != workers) Imf::setGlobalThreadCount(workers);

    StreamOutput output(stream, path);
    {
        Imf::OutputFile file(output, headerOf(image, attributes), workers);
        file.setFrameBuffer(frameBufferOf(image));
        file.writePixels(image.height);
    }
    if (output.failed()) throw std::runtime_error("write failed");
}

} // namespace

void writeExr(const Image& image, const ImageAttributes& attributes, AtomicFile& out, int threads) {
    checkFinite(image, out.path());
    try {
        if (out.seekable()) {
            encode(image, attributes, out.stream(), out.path(), threads);
        } else {
            std::ostringstream whole;
            encode(image, attributes, whole, out.path(), threads);
            const std::string_view bytes = whole.view();
            out.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        }
    } catch (const std::bad_alloc&) {
        throw MemoryError(out.path() + ": not enough memory to write the picture");
    } catch (const std::exception& error) {
        out.finish(); // knows the system's reason, if that is what went wrong
        throw IoError(out.path() + ": " + error.what());
    }
    out.finish();
}

} // namespace eikonal::image
