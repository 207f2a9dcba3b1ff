// What render writes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/pictures.h"

#include "image/exr.h"
#include "image/picture.h"

#include <cctype>
#include <filesystem>

namespace eikonal {

void writePictures(tool::Session& session, std::span<const std::unique_ptr<AtomicFile>> outputs,
                   const Options& o, const std::string& before, const image::Image& picture) {
    const History history = session.history();
    image::ImageAttributes attributes;
    attributes.strings = {{"eikonal:tool", history.tool},
                          {"eikonal:version", history.version},
                          {"eikonal:command", appendHistory(before, history.command)}};
    camera::describeCamera(o.params.camera, attributes);
    for (const auto& out : outputs) {
        if (image::isDisplayPicture(out->path()))
            image::writePicture(picture, *out, o.toneMap);
        else
            image::writeExr(picture, attributes, *out, session.threads());
    }
}

void checkOutput(const std::string& path) {
    if (image::isDisplayPicture(path)) return image::requirePictureModule();
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!writtenInPlace(path) && extension != ".exr")
        throw UsageError("--output: found '" + path +
                         "', expected a name ending in .exr, .png, "
                         ".jpg or .tga");
}

} // namespace eikonal
