// Which kernels the engines make.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <sstream>
#include <stdexcept>

namespace effects {

namespace {

// The engines keep their programs to themselves. What the driver is given is seen by standing in
// for two of its functions, so nothing about variants is written down here a second time. libepoxy
// looks a function up on its first call and changes the pointer then: so the call goes by the old
// pointer, and ours is put back after it.
PFNGLSHADERSOURCEPROC driverSource = nullptr;
PFNGLLINKPROGRAMPROC driverLink = nullptr;
std::string lastSource;
std::optional<Variant> lastVariant;

/// The switches stand in front of the first line that is no #define, after the version.
eikonal::gpu::Switches switchesOf(const std::string& text) {
    eikonal::gpu::Switches switches;
    std::istringstream lines(text);
    std::string line, word, name;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        int value = 0;
        if (!(words >> word >> name >> value) || word != "#define") break;
        switches.emplace_back(name, value);
    }
    return switches;
}

void noteProgram(GLuint program) {
    const eikonal::gpu::Switches switches = switchesOf(lastSource);
    const bool traces = std::any_of(std::begin(kKernels), std::end(kKernels), [&](auto* kernel) {
        return eikonal::gpu::loadShader(kernel, switches).text == lastSource;
    });
    if (!traces) return;
    GLint bytes = 0;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &bytes);
    lastVariant = Variant{lastSource, switches, bytes};
}

void watchPrograms();

void EPOXY_CALLSPEC sourceSeen(GLuint shader, GLsizei count, const GLchar* const* strings,
                               const GLint* lengths) {
    lastSource = strings[0];
    epoxy_glShaderSource = driverSource;
    epoxy_glShaderSource(shader, count, strings, lengths);
    watchPrograms();
}

void EPOXY_CALLSPEC linkSeen(GLuint program) {
    epoxy_glLinkProgram = driverLink;
    epoxy_glLinkProgram(program);
    watchPrograms();
    noteProgram(program);
}

/// From now on every program that is made is noted.
void watchPrograms() {
    if (epoxy_glShaderSource != sourceSeen) driverSource = epoxy_glShaderSource;
    if (epoxy_glLinkProgram != linkSeen) driverLink = epoxy_glLinkProgram;
    epoxy_glShaderSource = sourceSeen;
    epoxy_glLinkProgram = linkSeen;
}

} // namespace

Run run(const Case& one, eikonal::gpu::Device& device) {
    watchPrograms();
    lastVariant.reset();
    Run result;
    result.outcome = one.run(device);
    if (!lastVariant) throw std::runtime_error("no kernel that traces was made for " + one.name);
    result.variant = *lastVariant;
    return result;
}

std::uint64_t peakBytesOf(const Case& one) {
    eikonal::gpu::Device device(eikonal::gpu::DeviceChoice{});
    one.run(device);
    return device.peakBytes();
}

} // namespace effects
