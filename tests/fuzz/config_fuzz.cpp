// Any text as a --config file, for options of every kind that the tools have: refused with one line
// as wrong usage, or read into values that stay within what the options allow.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "common/command_line.h"

#include <cstdint>
#include <cstdlib>
#include <sys/mman.h>
#include <unistd.h>

using namespace eikonal;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

struct Values {
    std::string eye, size = "1x1", tone = "clip";
    std::vector<std::string> lights, inputs;
    double fov = 50, height = 0;
    int depth = 32;
    bool quiet = false;
};

void addOptions(CLI::App& app, Values& v) {
    app.add_option("input", v.inputs)->required();
    app.add_option("--eye", v.eye)->required();
    app.add_option("--size", v.size);
    app.add_option("--tone", v.tone)->check(CLI::IsMember({"clip", "filmic"}));
    app.add_option("--light", v.lights);
    auto* fov = app.add_option("--fov", v.fov);
    fov->excludes(app.add_option("--ortho", v.height));
    app.add_option("--max-depth", v.depth)->check(CLI::Range(1, 64));
    app.add_flag("-q,--quiet", v.quiet);
    app.set_config("--config");
    app.allow_extras();
    tool::acceptPlainLists(app);
}

/// A file in memory, whose name the parser can open.
class MemoryFile {
public:
    MemoryFile(const std::uint8_t* bytes, size_t size) : mFile(memfd_create("config", 0)) {
        require(mFile >= 0 && write(mFile, bytes, size) == static_cast<ssize_t>(size));
    }
    ~MemoryFile() { close(mFile); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string path() const { return "/proc/self/fd/" + std::to_string(mFile); }

private:
    int mFile;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, size_t size) {
    const MemoryFile file(bytes, size);
    std::string name = "tool", option = "--config", path = file.path(), input = "in.vdb";
    char* arguments[] = {name.data(), option.data(), path.data(), input.data()};
    CLI::App app;
    Values values;
    addOptions(app, values);
    try {
        if (!tool::parseCommandLine(app, 4, arguments, {{"--fov", "--ortho"}})) return 0;
    } catch (const Error& error) {
        const std::string line = error.what();
        require(!line.empty() && line.find('\n') == std::string::npos);
        return 0;
    }
    require(!values.eye.empty() || app.count("--eye") > 0);
    require(app.count("--fov") + app.count("--ortho") == 1);
    require(values.depth >= 1 && values.depth <= 64);
    require(values.tone == "clip" || values.tone == "filmic");
    return 0;
}
