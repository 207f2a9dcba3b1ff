// A glTF file as the library parses it, and where its nodes are.
// SPDX-License-Identifier: GPL-3.0-or-later
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
// With TINYGLTF_NO_FS the library uses it all the same, and does not include it.
#include <fstream>

#include "scenefile/gltf_model.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <sstream>

namespace eikonal::scenefile {

namespace {

// The library goes down into `extras` and extensions by recursion.
constexpr int kDeepest = 100;

/// What a file may require: the rest would make another scene of it.
bool isKnownToRequire(const std::string& extension) {
    static const std::set<std::string> kKnown{
        "KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume",
        "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_lights_punctual",
        "KHR_mesh_quantization",
        // Of textures, which are not read:
        "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp"};
    return kKnown.contains(extension);
}

/// One line of what may be many, or one with a file in it.
std::string shortened(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    constexpr size_t kLongest = 200;
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

/// How deep a text's brackets lie in each other, outside strings.
int depthOf(std::string_view json) {
    int depth = 0, deepest = 0;
    bool quoted = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (quoted) {
            if (c == '\\') ++i;
            if (c == '"') quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

bool isBinary(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

/// The JSON of a .glb: its first chunk. What is wrong with it the library tells.
std::string_view jsonOf(std::string_view bytes) {
    constexpr size_t kHead = 20;
    if (!isBinary(bytes)) return bytes;
    if (bytes.size() < kHead) return {};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return bytes.substr(kHead, length);
}

/// Finds the files of buffers: beside the scene, and nowhere else.
struct Files {
    std::string folder;
    std::string missing{}; ///< the first that there is not

    bool has(const std::string& path) {
        std::error_code none;
        const bool there = path.starts_with(folder) && std::filesystem::is_regular_file(path, none);
        if (!there && missing.empty()) missing = path;
        return there;
    }
};

bool keepImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
               int, void*) {
    return true;
}

glm::dmat4 placeOf(const Gltf& file, int index, const tinygltf::Node& node) {
    const std::string what = "node " + std::to_string(index);
    const auto numbers = [&](const std::vector<double>& given, size_t count,
                             const std::string& name) {
        if (given.size() != count)
            file.fail(what + ": " + name + " has " + std::to_string(given.size()) +
                      " numbers, expected " + std::to_string(count));
        for (const double number : given) file.finite(number, what + ": " + name);
    };
    glm::dmat4 place(1);
    if (!node.matrix.empty()) {
        numbers(node.matrix, 16, "matrix");
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) place[c][r] = node.matrix[static_cast<size_t>(4 * c + r)];
        if (place[0][3] != 0 || place[1][3] != 0 || place[2][3] != 0 || place[3][3] != 1)
            file.fail(what + ": found a matrix whose last row is not 0, 0, 0, 1");
        return place;
    }
    if (!node.translation.empty()) {
        numbers(node.translation, 3, "translation");
        place = glm::translate(
            place, glm::dvec3(node.translation[0], node.translation[1], node.translation[2]));
    }
    if (!node.rotation.empty()) {
        numbers(node.rotation, 4, "rotation");
        const std::vector<double>& q = node.rotation; // x, y, z, w
        const glm::dquat turn(q[3], q[0], q[1], q[2]);
        const double length = glm::length(turn);
        if (!(length > 0) || !std::isfinite(length)) file.fail(what + ": found a rotation of 0");
        place *= glm::mat4_cast(turn / length);
    }
    if (!node.scale.empty()) {
        numbers(node.scale, 3, "scale");
        place = glm::scale(place, glm::dvec3(node.scale[0], node.scale[1], node.scale[2]));
    }
    return place;
}

/// Where the scene's trees begin.
std::vector<int> rootsOf(const Gltf& file) {
    const tinygltf::Model& model = file.model;
    if (!model.scenes.empty()) {
        const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
        return file.at(model.scenes, scene, "scene").nodes;
    }
    std::vector<char> isChild(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<size_t>(child) < isChild.size())
                isChild[static_cast<size_t>(child)] = 1;
    std::vector<int> roots;
    for (size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

} // namespace

void Gltf::fail(const std::string& fault) const {
    throw DataError(title + ": " + fault);
}

double Gltf::finite(double number, const std::string& what) const {
    if (!std::isfinite(number)) fail(what + ": found " + toText(number) + ", expected a number");
    return number;
}

Gltf loadGltf(const std::string& path, std::string_view bytes) {
    Gltf file;
    file.title = path == "-" ? "standard input" : path;
    if (bytes.size() > UINT32_MAX)
        file.fail("found " + std::to_string(bytes.size()) + " bytes, expected less than 4 GiB");
    if (depthOf(jsonOf(bytes)) > kDeepest)
        file.fail("found brackets in more than " + std::to_string(kDeepest) + " others");
    std::string folder = std::filesystem::path(path).parent_path().string();
    if (folder.empty()) folder = ".";
    Files files{folder.ends_with('/') ? folder : folder + "/"};
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string& name, void* known) {
        return static_cast<Files*>(known)->has(name);
    };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error,
                                 const std::string& name, void*) {
        try {
            const std::string read = readWhole(name);
            out->assign(read.begin(), read.end());
            return true;
        } catch (const Error& fault) {
            *error = fault.what();
            return false;
        }
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    callbacks.user_data = &files;
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(callbacks);
    parser.SetImageLoader(keepImage, nullptr);
    std::string error, warning;
    bool good = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        good = isBinary(bytes)
                   ? parser.LoadBinaryFromMemory(
                         &file.model, &error, &warning,
                         reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                   : parser.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size,
                                                folder);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& fault) {
        error = fault.what();
    }
    if (!good && !files.missing.empty())
        throw MissingError(file.title + ": can't open its buffer " + shortened(files.missing));
    if (!good) file.fail("found no sound glTF (" + shortened(error) + ")");
    const std::string& version = file.model.asset.version;
    if (!version.starts_with("2."))
        file.fail("found glTF version '" + shortened(version) + "', expected 2.0");
    for (const std::string& extension : file.model.extensionsRequired)
        if (!isKnownToRequire(extension))
            file.fail("it requires the extension '" + shortened(extension) +
                      "', which is not known");
    return file;
}

std::vector<PlacedNode> placedNodes(const Gltf& file) {
    const std::vector<tinygltf::Node>& nodes = file.model.nodes;
    std::vector<PlacedNode> placed, waiting;
    std::vector<char> seen(nodes.size());
    const auto wait = [&](const std::vector<int>& list, const glm::dmat4& parent) {
        for (auto node = list.rbegin(); node != list.rend(); ++node)
            waiting.push_back({*node, parent});
    };
    wait(rootsOf(file), glm::dmat4(1));
    while (!waiting.empty()) {
        const PlacedNode next = waiting.back();
        waiting.pop_back();
        const tinygltf::Node& node = file.at(nodes, next.node, "node");
        if (seen[static_cast<size_t>(next.node)]++)
            file.fail("node " + std::to_string(next.node) +
                      " is in the scene twice, expected a tree");
        const glm::dmat4 place = next.worldFromNode * placeOf(file, next.node, node);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                file.finite(place[c][r], "node " + std::to_string(next.node));
        placed.push_back({next.node, place});
        wait(node.children, place);
    }
    return placed;
}

std::string nameOfNode(const Gltf& file, int node, const std::string& held) {
    const std::string& own = file.at(file.model.nodes, node, "node").name;
    if (!own.empty()) return own;
    return held.empty() ? "node " + std::to_string(node) : held;
}

const tinygltf::Value* member(const tinygltf::ExtensionMap& extensions,
                              const std::string& extension, const std::string& name) {
    const auto found = extensions.find(extension);
    if (found == extensions.end() || !found->second.IsObject() || !found->second.Has(name))
        return nullptr;
    return &found->second.Get(name);
}

double numberIn(const Gltf& file, const tinygltf::ExtensionMap& extensions,
                const std::string& extension, const std::string& name, double fallback) {
    const tinygltf::Value* value = member(extensions, extension, name);
    if (value == nullptr) return fallback;
    if (!value->IsNumber()) file.fail(extension + ": " + name + " is no number");
    return file.finite(value->GetNumberAsDouble(), extension + ": " + name);
}

glm::dvec3 colourOf(const Gltf& file, const std::vector<double>& numbers,
                    const glm::dvec3& fallback, const std::string& what) {
    if (numbers.empty()) return fallback;
    if (numbers.size() < 3) file.fail(what + ": found less than three numbers");
    for (int i = 0; i < 3; ++i)
        if (!(file.finite(numbers[static_cast<size_t>(i)], what) >= 0))
            file.fail(what + ": found " + toText(numbers[static_cast<size_t>(i)]) +
                      ", expected 0 or more");
    return {numbers[0], numbers[1], numbers[2]};
}

void addOnce(std::vector<std::string>& list, const std::string& item) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

} // namespace eikonal::scenefile
