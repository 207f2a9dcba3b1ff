// A kernel as optimised SPIR-V: how many instructions it has, and what it reads and writes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace effects {

namespace {

bool runs(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

/// The first two words of what it prints.
std::string versionOf(const std::string& command) {
    FILE* const pipe = ::popen((command + " --version 2>&1").c_str(), "r");
    char line[256] = "";
    const bool read = pipe && std::fgets(line, sizeof line, pipe);
    if (pipe) ::pclose(pipe);
    std::istringstream words(read ? line : "");
    std::string first, second, third;
    words >> first >> second >> third;
    return second == "Version:" ? first + " " + third : first + " " + second;
}

/// `%id = OpName operands`, or without the id.
struct Line {
    std::string id, op;
    std::vector<std::string> operands;
};

Line parse(const std::string& text) {
    Line line;
    std::istringstream words(text);
    std::string word;
    words >> word;
    if (!word.empty() && word[0] == '%') {
        line.id = word;
        words >> word >> word; // "="
    }
    line.op = word;
    while (words >> word) line.operands.push_back(word);
    return line;
}

/// What the module says of its ids.
struct Declared {
    std::map<std::string, Line> lines;  ///< types, constants, variables
    std::map<std::string, int> binding; ///< of variables
    std::map<std::string, std::string> name;
    std::set<std::string> storage; ///< structs of storage buffers
};

/// All that a variable binds: as many as it has elements, if it is an array.
Bindings bindingsOf(const std::string& variable, const Declared& declared) {
    const auto lineOf = [&](const std::string& id) { return declared.lines.at(id); };
    Line type = lineOf(lineOf(lineOf(variable).operands[0]).operands[1]);
    const std::string storageClass = lineOf(variable).operands[1];
    int count = 1;
    if (type.op == "OpTypeArray") {
        count = std::stoi(lineOf(type.operands[1]).operands[1]);
        type = lineOf(type.operands[0]);
    }
    using Kind = Binding::Kind;
    const bool isBuffer = storageClass == "StorageBuffer" || declared.storage.count(type.id) > 0;
    const Kind kind = type.op == "OpTypeSampledImage" ? Kind::texture
                      : type.op == "OpTypeImage"      ? Kind::image
                      : isBuffer                      ? Kind::buffer
                                                      : Kind::block;
    const bool isBlock = kind == Kind::buffer || kind == Kind::block;
    const auto name = declared.name.find(isBlock ? type.id : variable);
    Bindings bindings;
    for (int i = 0; i < count; ++i)
        bindings.insert({kind, declared.binding.at(variable) + i,
                         name == declared.name.end() ? "" : name->second});
    return bindings;
}

Module parse(std::istream& text) {
    Module module;
    Declared declared;
    std::set<std::string> used;
    bool inFunction = false;
    for (std::string row; std::getline(text, row);) {
        const Line line = parse(row);
        if (line.op == "OpFunctionEnd") inFunction = false;
        if (inFunction) {
            const bool does = line.op != "OpLabel" && line.op != "OpFunctionParameter";
            module.instructions += does ? 1 : 0;
            used.insert(line.operands.begin(), line.operands.end());
        }
        if (line.op == "OpFunction") inFunction = true;
        if (inFunction) continue;
        if (!line.id.empty()) declared.lines[line.id] = line;
        if (line.op == "OpName")
            declared.name[line.operands[0]] =
                line.operands[1].substr(1, line.operands[1].size() - 2); // in quotes
        if (line.op == "OpDecorate" && line.operands[1] == "Binding")
            declared.binding[line.operands[0]] = std::stoi(line.operands[2]);
        if (line.op == "OpDecorate" && line.operands[1] == "BufferBlock")
            declared.storage.insert(line.operands[0]);
    }
    for (const auto& [variable, number] : declared.binding)
        if (used.count(variable)) module.bindings.merge(bindingsOf(variable, declared));
    return module;
}

} // namespace

std::optional<Module> moduleOf(const Variant& variant, const std::string& work) {
    static const bool installed = runs("glslangValidator --version") &&
                                  runs("spirv-opt --version") && runs("spirv-dis --version");
    if (!installed) return std::nullopt;
    static std::map<std::string, Module> known;
    if (const auto found = known.find(variant.text); found != known.end()) return found->second;
    std::filesystem::create_directories(work);
    const std::string base = "'" + work + "/kernel";
    std::ofstream(work + "/kernel.comp") << variant.text;
    if (!runs("glslangValidator -G -S comp -o " + base + ".spv' " + base + ".comp'") ||
        !runs("spirv-opt -O " + base + ".spv' -o " + base + ".opt.spv'") ||
        !runs("spirv-dis " + base + ".opt.spv' -o " + base + ".txt'"))
        throw std::runtime_error("no SPIR-V from " + work + "/kernel.comp");
    std::ifstream text(work + "/kernel.txt");
    return known[variant.text] = parse(text);
}

std::string compilerName() {
    static const std::string name = versionOf("glslangValidator") + ", " + versionOf("spirv-opt");
    return name;
}

std::string textOf(const Bindings& bindings) {
    std::string text;
    for (const Binding& one : bindings) {
        const char* const kinds[] = {"block", "buffer", "texture", "image"};
        text += (text.empty() ? "" : ", ") + std::string(kinds[static_cast<int>(one.kind)]) + " " +
                std::to_string(one.number);
    }
    return text;
}

} // namespace effects
