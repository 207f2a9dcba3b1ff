// Shader programs: sources with #include expanded, one variant per set of switches.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"

#include "base/error.h"
#include "gpu/embedded_shaders.h"

#include <cstdlib>
#include <epoxy/gl.h>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace eikonal::gpu {

namespace {

std::string readSource(const std::string& path, const std::string& where) {
    if (const char* folder = std::getenv("EIKONAL_SHADERS")) {
        std::ifstream file(std::string(folder) + "/" + path);
        std::stringstream text;
        if (file && text << file.rdbuf()) return text.str();
    }
    for (const EmbeddedShader* shader = kEmbeddedShaders; shader->path; ++shader)
        if (path == shader->path) return shader->text;
    throw InternalError(where + ": no shader '" + path + "'");
}

class Expander {
public:
    explicit Expander(ShaderText& out) : mOut(out) {}

    void addLine(const std::string& line, const std::string& file, int number) {
        mOut.text += line + "\n";
        mOut.lines.push_back({file, number});
    }

    void addFile(const std::string& path, const std::string& where) {
        if (!mSeen.insert(path).second) return;
        std::istringstream source(readSource(path, where));
        int number = 0;
        for (std::string line; std::getline(source, line);) {
            ++number;
            const std::string here = path + ":" + std::to_string(number);
            const size_t open = line.find('"'), close = line.rfind('"');
            if (line.rfind("#include", 0) != 0)
                addLine(line, path, number);
            else if (open == std::string::npos || close <= open)
                throw InternalError(here + ": expected #include \"room/file\"");
            else
                addFile(line.substr(open + 1, close - open - 1), here);
        }
    }

private:
    ShaderText& mOut;
    std::set<std::string> mSeen;
};

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    if (length > 0) glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log.c_str();
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    if (length > 0) glGetProgramInfoLog(program, length, nullptr, log.data());
    return log.c_str();
}

/// Attaches the compiled stage to the program.
void attachStage(GLuint program, GLenum stage, const std::string& path, const Switches& switches) {
    const ShaderText source = loadShader(path, switches);
    const GLuint shader = glCreateShader(stage);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    const std::string log = compiled ? "" : explainLog(shaderLog(shader), source);
    if (compiled) glAttachShader(program, shader);
    glDeleteShader(shader);
    if (!compiled) throw InternalError("shader " + path + " does not compile: " + log);
}

} // namespace

ShaderText loadShader(const std::string& path, const Switches& switches) {
    ShaderText out;
    Expander expander(out);
    expander.addLine("#version 450 core", "(start)", 1);
    for (const auto& [name, value] : switches)
        expander.addLine("#define " + name + " " + std::to_string(value), "(switches)", 1);
    expander.addFile(path, "program");
    return out;
}

std::string explainLog(const std::string& log, const ShaderText& text) {
    // Mesa writes 0:LINE(COLUMN), NVIDIA 0(LINE), others 0:LINE:.
    static const std::regex place(R"(\b0[:(](\d+)(\(\d+\)|\)|:)?)");
    std::string out;
    auto at = log.cbegin();
    for (std::sregex_iterator match(log.begin(), log.end(), place), end; match != end; ++match) {
        out.append(at, log.cbegin() + match->position());
        const size_t line = std::stoul((*match)[1]);
        if (line >= 1 && line <= text.lines.size()) {
            const ShaderText::Origin& origin = text.lines[line - 1];
            out += origin.file + ":" + std::to_string(origin.line);
        } else {
            out += match->str();
        }
        at = log.cbegin() + match->position() + match->length();
    }
    return out.append(at, log.cend());
}

Program::Program(Device&, const std::string& compute, const Switches& switches) {
    link({{GL_COMPUTE_SHADER, compute}}, switches);
    glGetProgramiv(mName, GL_COMPUTE_WORK_GROUP_SIZE, &mGroup.x);
}

Program::Program(Device&, const std::string& vertex, const std::string& fragment,
                 const Switches& switches) {
    link({{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}, switches);
}

Program::~Program() {
    if (mName != 0) glDeleteProgram(mName);
}

Program::Program(Program&& other) noexcept
    : mName(std::exchange(other.mName, 0)), mGroup(other.mGroup) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(mName, other.mName);
    std::swap(mGroup, other.mGroup);
    return *this;
}

void Program::link(const std::vector<std::pair<unsigned, std::string>>& stages,
                   const Switches& switches) {
    mName = glCreateProgram();
    try {
        for (const auto& [stage, path] : stages) attachStage(mName, stage, path, switches);
        glLinkProgram(mName);
        GLint linked = 0;
        glGetProgramiv(mName, GL_LINK_STATUS, &linked);
        if (!linked)
            throw InternalError("shader " + stages.front().second +
                                " does not link: " + programLog(mName));
    } catch (...) {
        glDeleteProgram(mName); // the destructor of a half-made object does not run
        mName = 0;
        throw;
    }
}

void Program::use() const {
    glUseProgram(mName);
}

void Program::dispatch(glm::ivec3 items) const {
    if (items.x <= 0 || items.y <= 0 || items.z <= 0) return;
    use();
    const glm::ivec3 groups = (items + mGroup - 1) / mGroup;
    glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                      static_cast<GLuint>(groups.z));
}

void drawTriangles(const Program& program, std::int64_t vertices, int width, int height,
                   const Texture* target) {
    GLuint framebuffer = 0, vertexArray = 0, depth = 0;
    glCreateFramebuffers(1, &framebuffer);
    glCreateVertexArrays(1, &vertexArray);
    if (target) {
        glCreateRenderbuffers(1, &depth);
        glNamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT32F, width, height);
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target->name(), 0);
        glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    } else {
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    if (target) {
        const float far = 1.0f;
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
    }
    glBindVertexArray(vertexArray);
    program.use();
    // Bounded pieces, since a draw counts its vertices in 32 bits.
    const std::int64_t piece = 3 * (std::int64_t{1} << 26);
    for (std::int64_t first = 0; first < vertices; first += piece)
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first),
                     static_cast<GLsizei>(std::min(piece, vertices - first)));
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteRenderbuffers(1, &depth);
    glDeleteVertexArrays(1, &vertexArray);
    glDeleteFramebuffers(1, &framebuffer);
}

} // namespace eikonal::gpu
