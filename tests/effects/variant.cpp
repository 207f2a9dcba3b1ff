// Which kernels the engines make, and how many instructions they have.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include "tokens.h"

#include <cstdlib>
#include <epoxy/gl.h>
#include <filesystem>
#include <fstream>
#include <map>
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
std::map<std::string, Variant>& variants() {
    static std::map<std::string, Variant> known;
    return known;
}

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
    for (const char* kernel : {kViewKernel, kSharpKernel, kPhotonKernel}) {
        if (eikonal::gpu::loadShader(kernel, switches).text != lastSource) continue;
        GLint bytes = 0;
        glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &bytes);
        variants()[kernel] = {kernel, lastSource, switches, bytes};
    }
}

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

bool runs(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

} // namespace

void watchPrograms() {
    if (epoxy_glShaderSource != sourceSeen) driverSource = epoxy_glShaderSource;
    if (epoxy_glLinkProgram != linkSeen) driverLink = epoxy_glLinkProgram;
    epoxy_glShaderSource = sourceSeen;
    epoxy_glLinkProgram = linkSeen;
}

const Variant& lastVariant(const std::string& kernel) {
    const auto found = variants().find(kernel);
    if (found == variants().end()) throw std::runtime_error("no program was made of " + kernel);
    return found->second;
}

std::optional<Instructions> instructionsOf(const std::string& text, const std::string& work) {
    static const bool installed = runs("glslangValidator --version") &&
                                  runs("spirv-opt --version") && runs("spirv-dis --version");
    if (!installed) return std::nullopt;
    static std::map<std::string, Instructions> counted;
    if (const auto known = counted.find(text); known != counted.end()) return known->second;
    std::filesystem::create_directories(work);
    const std::string base = "'" + work + "/kernel";
    std::ofstream(work + "/kernel.comp") << text;
    if (!runs("glslangValidator -G -S comp -o " + base + ".spv' " + base + ".comp'") ||
        !runs("spirv-opt -O " + base + ".spv' -o " + base + ".opt.spv'") ||
        !runs("spirv-dis " + base + ".opt.spv' -o " + base + ".txt'"))
        throw std::runtime_error("no SPIR-V from " + work + "/kernel.comp");
    std::ifstream lines(work + "/kernel.txt");
    Instructions instructions;
    bool inFunction = false;
    for (std::string line; std::getline(lines, line);) {
        const size_t begin = line.find("Op");
        if (begin == line.npos) continue;
        const std::string name = line.substr(begin, line.find(' ', begin) - begin);
        if (name == "OpFunctionEnd") inFunction = false;
        const bool does = name != "OpLabel" && name != "OpFunctionParameter";
        if (inFunction && does) instructions.push_back(name);
        if (name == "OpFunction") inFunction = true;
    }
    return counted[text] = instructions;
}

ShaderFolder::ShaderFolder(const std::string& folder) {
    if (!folder.empty()) ::setenv("EIKONAL_SHADERS", folder.c_str(), 1);
}

ShaderFolder::~ShaderFolder() {
    ::unsetenv("EIKONAL_SHADERS");
}

void writeWithout(const std::vector<Cut>& cuts, const std::string& folder) {
    const std::string kernel = cuts.front().kernel;
    std::string text = eikonal::gpu::loadShader(kernel, {}).text;
    text.erase(0, text.find('\n') + 1); // the version comes before the switches, when it is loaded
    const std::filesystem::path path = std::filesystem::path(folder) / kernel;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << cut(text, cuts);
}

} // namespace effects
