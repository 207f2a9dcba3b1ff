// The module that knows OpenImageIO: every picture format but EXR, loaded only when one is met.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture_module.h"
#include "image/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

using namespace eikonal::image;

bool fail(const std::string& reason, char* message, size_t messageSize) {
    const size_t length = std::min(reason.size(), messageSize - 1);
    std::copy_n(reason.begin(), length, message);
    message[length] = '\0';
    return false;
}

/// How stored values become linear: a power, the sRGB curve, or not at all.
struct Transfer {
    bool srgb = false;
    double gamma = 1;

    float linear(float stored) const {
        if (srgb) return static_cast<float>(linearFromSrgb(stored));
        // Only floating-point pictures are ever beyond [0, 1], and those are linear.
        return gamma == 1 ? stored : static_cast<float>(std::pow(std::max(stored, 0.f), gamma));
    }
};

/// OpenImageIO names the colour space in "oiio:ColorSpace": "sRGB", "Linear", "Rec709" (whose curve
/// as displayed is close to sRGB's), "GammaX" or "GammaCorrected" with the exponent beside it.
Transfer transferOf(const OIIO::ImageSpec& spec) {
    const std::string space = OIIO::Strutil::lower(spec.get_string_attribute("oiio:ColorSpace"));
    if (space == "linear" || space == "scene_linear" || space == "lin_srgb") return {false, 1};
    if (space.rfind("gamma", 0) == 0) return {false, spec.get_float_attribute("oiio:Gamma", 2.2f)};
    return {space == "srgb" || space == "rec709" || !spec.format.is_floating_point(), 1};
}

/// Points standard error nowhere for as long as it lives: libpng and libjpeg say there what
/// OpenImageIO also reports, and a tool's failure is one line. Readers run before a tool's work, on
/// its main thread, so that no other message falls into this.
class QuietStandardError {
public:
    QuietStandardError() : mKept(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (mKept >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
        if (nowhere >= 0) ::close(nowhere);
    }
    ~QuietStandardError() {
        if (mKept < 0) return;
        ::dup2(mKept, STDERR_FILENO);
        ::close(mKept);
    }
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;

private:
    int mKept;
};

bool decode(const char* path, PictureAllocator allocate, void* context, char* message,
            size_t messageSize) try {
    const QuietStandardError quiet;
    // Colours straight, as stored, since they are to be made linear before alpha is multiplied in.
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &wanted);
    if (!input) return fail(OIIO::geterror(), message, messageSize);
    const OIIO::ImageSpec spec = input->spec();
    if (spec.depth > 1) return fail("a volume, expected a picture", message, messageSize);
    if (spec.nchannels < 1 || spec.nchannels > 4)
        return fail(std::to_string(spec.nchannels) + " channels, expected 1 to 4", message,
                    messageSize);
    float* const pixels = allocate(context, spec.width, spec.height, spec.nchannels);
    if (pixels == nullptr) return fail("no memory was given", message, messageSize);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels))
        return fail(input->geterror(), message, messageSize);

    const Transfer transfer = transferOf(spec);
    const bool straight = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    const int colours =
        spec.nchannels == 2 || spec.nchannels == 4 ? spec.nchannels - 1 : spec.nchannels;
    const size_t area = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    for (size_t i = 0; i < area; ++i) {
        float* const pixel = pixels + i * static_cast<size_t>(spec.nchannels);
        for (int k = 0; k < colours; ++k) {
            pixel[k] = transfer.linear(pixel[k]);
            if (colours < spec.nchannels && straight) pixel[k] *= pixel[colours];
        }
    }
    return true;
} catch (const std::exception& error) {
    return fail(error.what(), message, messageSize);
}

/// Whether a file reads back as what was written; JPEG, which loses something, in size alone.
bool readsBack(const std::string& extension, const OIIO::ImageSpec& spec,
               const unsigned char* pixels, const std::vector<unsigned char>& file) {
    OIIO::Filesystem::IOMemReader memory(file.data(), file.size());
    OIIO::ImageSpec wanted, found;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::create(extension);
    if (!input || !input->set_ioproxy(&memory) ||
        !input->open("picture." + extension, found, wanted) || input->spec().width != spec.width ||
        input->spec().height != spec.height || input->spec().nchannels != spec.nchannels)
        return false;
    std::vector<unsigned char> back(spec.image_bytes());
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8, back.data())) return false;
    return input->format_name() == std::string("jpeg") ||
           std::equal(back.begin(), back.end(), pixels);
}

bool encode(const char* extension, int width, int height, int channels, const unsigned char* pixels,
            PictureSink sink, void* context, char* message, size_t messageSize) try {
    const std::string name = std::string("picture.") + extension; // chooses the format
    const auto output = OIIO::ImageOutput::create(name);
    if (!output) return fail(OIIO::geterror(), message, messageSize);
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOVecOutput file;
    if (!output->supports("ioproxy") || !output->set_ioproxy(&file))
        return fail("the format can't be written to memory", message, messageSize);
    if (!output->open(name, spec) || !output->write_image(OIIO::TypeUInt8, pixels) ||
        !output->close())
        return fail(output->geterror(), message, messageSize);
    if (!readsBack(extension, spec, pixels, file.buffer()))
        return fail("it does not read back as written", message, messageSize);
    if (!sink(context, file.buffer().data(), file.buffer().size()))
        return fail("write failed", message, messageSize);
    return true;
} catch (const std::exception& error) {
    return fail(error.what(), message, messageSize);
}

} // namespace

extern "C" __attribute__((visibility("default"))) const PictureModule* eikonalPictureModule() {
    static const PictureModule module{kPictureModuleVersion, decode, encode};
    return &module;
}
