// A headless OpenGL 4.5 context on the device the user chose: the ground every engine stands on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/device.h"

#include "base/error.h"
#include "base/resources.h"
#include "base/text.h"

#include <algorithm>
#include <cstdlib>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fstream>

namespace eikonal::gpu {

namespace {

/// A place to get a display from.
struct Candidate {
    EGLDeviceEXT device = nullptr; ///< null: Mesa's surfaceless platform
    bool software = false;
};

bool hasWord(const char* list, const std::string& word) {
    return list && (" " + std::string(list) + " ").find(" " + word + " ") != std::string::npos;
}

std::vector<Candidate> candidates() {
    std::vector<Candidate> found;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (hasWord(client, "EGL_EXT_platform_device") &&
        (hasWord(client, "EGL_EXT_device_enumeration") || hasWord(client, "EGL_EXT_device_base"))) {
        EGLint count = 0;
        eglQueryDevicesEXT(0, nullptr, &count);
        std::vector<EGLDeviceEXT> devices(static_cast<size_t>(std::max(count, 0)));
        if (count > 0 && eglQueryDevicesEXT(count, devices.data(), &count)) {
            for (EGLint i = 0; i < count; ++i) {
                const char* words = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
                found.push_back({devices[i], hasWord(words, "EGL_MESA_device_software")});
            }
        }
    }
    if (found.empty() && hasWord(client, "EGL_MESA_platform_surfaceless"))
        found.push_back({nullptr, true});
    return found;
}

/// Display and context together; made current on construction.
class Context {
public:
    explicit Context(const Candidate& candidate) {
        mDisplay = candidate.device ? eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                                               candidate.device, nullptr)
                                    : eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                               EGL_DEFAULT_DISPLAY, nullptr);
        EGLint major = 0, minor = 0;
        if (mDisplay == EGL_NO_DISPLAY || !eglInitialize(mDisplay, &major, &minor)) return;
        const char* words = eglQueryString(mDisplay, EGL_EXTENSIONS);
        if (!hasWord(words, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API)) return;
        EGLConfig config = EGL_NO_CONFIG_KHR;
        if (!hasWord(words, "EGL_KHR_no_config_context") &&
            !hasWord(words, "EGL_MESA_configless_context")) {
            const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                     EGL_PBUFFER_BIT, EGL_NONE};
            EGLint count = 0;
            if (!eglChooseConfig(mDisplay, wanted, &config, 1, &count) || count == 0) return;
        }
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
        mContext = eglCreateContext(mDisplay, config, EGL_NO_CONTEXT, version);
        mCurrent = mContext != EGL_NO_CONTEXT &&
                   eglMakeCurrent(mDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, mContext);
    }
    ~Context() {
        if (mDisplay == EGL_NO_DISPLAY) return;
        eglMakeCurrent(mDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (mContext != EGL_NO_CONTEXT) eglDestroyContext(mDisplay, mContext);
        eglTerminate(mDisplay);
    }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    bool current() const { return mCurrent; }

private:
    EGLDisplay mDisplay = EGL_NO_DISPLAY;
    EGLContext mContext = EGL_NO_CONTEXT;
    bool mCurrent = false;
};

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

DeviceInfo describe() {
    DeviceInfo info{glText(GL_VENDOR), glText(GL_RENDERER), glText(GL_VERSION), false};
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"})
        if (info.renderer.find(name) != std::string::npos) info.software = true;
    return info;
}

std::int64_t availableHostBytes() {
    std::ifstream meminfo("/proc/meminfo");
    for (std::string line; std::getline(meminfo, line);)
        if (line.rfind("MemAvailable:", 0) == 0)
            return std::strtoll(line.c_str() + 13, nullptr, 10) * 1024;
    return 0;
}

GLint glInteger(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

Limits readLimits(bool software) {
    Limits limits;
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    limits.storageBufferBytes = bytes;
    limits.texture3d = glInteger(GL_MAX_3D_TEXTURE_SIZE);
    limits.texture2d = glInteger(GL_MAX_TEXTURE_SIZE);
    limits.framebuffer =
        std::min(glInteger(GL_MAX_FRAMEBUFFER_WIDTH), glInteger(GL_MAX_FRAMEBUFFER_HEIGHT));
    if (software) {
        limits.memoryBytes = availableHostBytes();
    } else if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
        limits.memoryBytes =
            std::int64_t{glInteger(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX)} * 1024;
    }
    return limits;
}

void setSoftwareThreads(int threads) {
    // llvmpipe reads its thread count once, when its screen is made; 0 means the caller's alone.
    if (threads > 0)
        ::setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
}

// Compiling a kernel takes Mesa and LLVM this much at their peak, and they crash where they get
// less. Drivers for GPUs ask for more by themselves and say so.
constexpr std::size_t kSoftwareDeviceBytes = std::size_t{256} << 20;

} // namespace

DeviceChoice parseDeviceChoice(const std::string& text) {
    DeviceChoice choice;
    if (text == "auto") return choice;
    if (text == "software") {
        choice.kind = DeviceChoice::Kind::software;
        return choice;
    }
    if (text.empty() || text.size() > 4 || text.find_first_not_of("0123456789") != text.npos)
        throw UsageError("--device: found '" + text +
                         "', expected auto, software, list or a number");
    choice.kind = DeviceChoice::Kind::index;
    choice.index = std::stoi(text);
    return choice;
}

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> devices;
    for (const Candidate& candidate : candidates()) {
        const Context context(candidate);
        if (context.current()) devices.push_back(describe());
    }
    return devices;
}

struct Device::Impl {
    std::unique_ptr<Context> context;
    DeviceInfo info;
    Limits limits;
    std::int64_t bytes = 0, peak = 0;

    bool open(const Candidate& candidate) {
        context = std::make_unique<Context>(candidate);
        if (!context->current()) {
            context.reset();
            return false;
        }
        info = describe();
        return true;
    }
};

Device::Device(const DeviceChoice& choice) : mImpl(new Impl) {
    requireMemory("the device", kSoftwareDeviceBytes);
    setSoftwareThreads(choice.threads);
    std::vector<Candidate> all = candidates();
    if (choice.kind == DeviceChoice::Kind::index) {
        int index = choice.index;
        for (const Candidate& candidate : all)
            if (mImpl->open(candidate) && index-- == 0)
                break;
            else
                mImpl->context.reset();
        if (!mImpl->context)
            throw DeviceError("--device " + std::to_string(choice.index) +
                              ": no such device (--device list names them)");
    } else {
        std::stable_partition(all.begin(), all.end(),
                              [](const Candidate& candidate) { return !candidate.software; });
        const bool softwareOnly = choice.kind == DeviceChoice::Kind::software;
        for (const Candidate& candidate : all) {
            if (softwareOnly && !candidate.software) continue;
            if (mImpl->open(candidate)) break;
        }
        if (!mImpl->context)
            throw DeviceError(std::string("no ") + (softwareOnly ? "software " : "") +
                              "device gives an OpenGL 4.5 core context through EGL (looked at " +
                              std::to_string(all.size()) +
                              "); libegl-mesa0 and libgl1-mesa-dri "
                              "bring a software one");
    }
    if (choice.requireGpu && mImpl->info.software)
        throw DeviceError("--require-gpu: the device is a software one (" + mImpl->info.renderer +
                          ")");
    mImpl->limits = readLimits(mImpl->info.software);
}

Device::~Device() = default;

const DeviceInfo& Device::info() const {
    return mImpl->info;
}

const Limits& Device::limits() const {
    return mImpl->limits;
}

void Device::requireFit(const std::vector<Need>& needs) const {
    const Limits& limits = mImpl->limits;
    double total = 0;
    for (const Need& need : needs) {
        total += static_cast<double>(need.bytes);
        if (need.storageBuffer && need.bytes > limits.storageBufferBytes)
            throw MemoryError(need.what + " needs " + bytesText(static_cast<double>(need.bytes)) +
                              " in one buffer, the device allows " +
                              bytesText(static_cast<double>(limits.storageBufferBytes)));
        for (const auto& [edge, most] :
             {std::pair(need.edge3d, limits.texture3d), std::pair(need.edge2d, limits.texture2d)})
            if (edge > most)
                throw MemoryError(need.what + " needs " +
                                  bytesText(static_cast<double>(need.bytes)) + " in a texture " +
                                  std::to_string(edge) + " texels long, the device allows " +
                                  std::to_string(most));
    }
    if (limits.memoryBytes > 0 && total > static_cast<double>(limits.memoryBytes))
        throw MemoryError("the device needs " + bytesText(total) + ", has " +
                          bytesText(static_cast<double>(limits.memoryBytes)));
}

void Device::check(const std::string& where) const {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    if (error == GL_OUT_OF_MEMORY)
        throw MemoryError(where + ": the device is out of memory, " +
                          bytesText(static_cast<double>(mImpl->bytes)) + " were held");
    throw InternalError(where + ": OpenGL error " + std::to_string(error));
}

void Device::account(std::int64_t bytes) {
    mImpl->bytes += bytes;
    mImpl->peak = std::max(mImpl->peak, mImpl->bytes);
}

std::uint64_t Device::peakBytes() const {
    return static_cast<std::uint64_t>(mImpl->peak);
}

} // namespace eikonal::gpu
