// Shader programs: sources with #include expanded, one variant per set of switches.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/device.h"
#include "gpu/resources.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace eikonal::gpu {

/// The closed list of switches of a variant; each becomes `#define NAME value`.
using Switches = std::vector<std::pair<std::string, int>>;

/// A source with its includes expanded, and where each of its lines came from.
struct ShaderText {
    struct Origin {
        std::string file;
        int line;
    };
    std::string text;
    std::vector<Origin> lines; ///< one per line of text, from line 1 on
};

/// Expands `#include "room/file"` (each file once) in shader `path`, relative to the shaders
/// folder: the one built in, or that in the environment variable EIKONAL_SHADERS. The version line
/// and the switches come first. Throws InternalError naming file and line of a missing include.
ShaderText loadShader(const std::string& path, const Switches& switches);

/// A compiler's log with its line numbers replaced by file and line. Compilers differ in what they
/// make of #line inside includes, so none is used: the text is one file to them.
std::string explainLog(const std::string& log, const ShaderText& text);

/// A compute, or vertex + fragment, program. Compile and link errors are InternalError with the
/// log. Uniform values go by uniform buffer; textures and images by the bindings in the text.
class Program {
public:
    Program() = default;
    Program(Device& device, const std::string& compute, const Switches& switches);
    Program(Device& device, const std::string& vertex, const std::string& fragment,
            const Switches& switches);
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;

    bool empty() const { return mName == 0; }
    void use() const;
    /// Runs enough work groups for `items` work items (x, y, z).
    void dispatch(glm::ivec3 items) const;

private:
    void link(const std::vector<std::pair<unsigned, std::string>>& stages,
              const Switches& switches);
    unsigned mName = 0;
    glm::ivec3 mGroup{1};
};

/// Draws the bound storage buffers' triangles with `program`, `vertices` in all, into a framebuffer
/// of `width` × `height` pixels that has no attachment: the fragment shader writes by itself.
/// With `target` it draws into that 2-D texture, nearest surface first, facing triangles only.
void drawTriangles(const Program& program, std::int64_t vertices, int width, int height,
                   const Texture* target = nullptr);

} // namespace eikonal::gpu
