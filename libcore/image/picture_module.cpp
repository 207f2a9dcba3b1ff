// Finding and loading the module that knows OpenImageIO, when a picture calls for it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture_module.h"

#include "base/error.h"
#include "image/input.h"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <string>

namespace eikonal::image {

namespace {

std::string modulePath() {
    const char* const folder = std::getenv("EIKONAL_MODULES");
    if (folder != nullptr && *folder != '\0')
        return (std::filesystem::path(folder) / kPictureModuleFile).string();
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const auto prefix = program.parent_path().parent_path();
    return (prefix / "lib" / "eikonal" / kPictureModuleFile).string();
}

std::string loaderReason() {
    const char* const reason = ::dlerror();
    return reason == nullptr ? "unknown reason" : oneLine(reason);
}

} // namespace

const PictureModule& pictureModule() {
    const std::string path = modulePath();
    // The loader counts the references and hands back what is loaded already.
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        throw MissingError("the picture module can't be loaded: " + loaderReason() +
                           " (EIKONAL_MODULES names the folder it is in)");
    void* const symbol = ::dlsym(library, kPictureModuleSymbol);
    if (symbol == nullptr) throw MissingError(path + ": is no picture module: " + loaderReason());
    const PictureModule* const module = reinterpret_cast<PictureModuleEntry>(symbol)();
    if (module == nullptr || module->version != kPictureModuleVersion)
        throw MissingError(path + ": is a picture module of another version of this program");
    return *module;
}

} // namespace eikonal::image
