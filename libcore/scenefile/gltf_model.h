// A glTF file as the library parses it, and where its nodes are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace eikonal::scenefile {

/// Everything of a file but its images, which stay undecoded.
struct Gltf {
    std::string title; ///< in messages
    tinygltf::Model model;

    /// The item at `index` of a list of the model, `what` in messages. Throws DataError beyond.
    template<typename Item>
    const Item& at(const std::vector<Item>& items, int index, const std::string& what) const {
        if (index < 0 || static_cast<size_t>(index) >= items.size())
            fail("found " + what + " " + std::to_string(index) + ", expected one below " +
                 std::to_string(items.size()));
        return items[static_cast<size_t>(index)];
    }
    /// Throws DataError.
    [[noreturn]] void fail(const std::string& fault) const;
    /// Throws DataError unless the number is finite.
    double finite(double number, const std::string& what) const;
};

/// Throws as readGltfObjects() does.
Gltf loadGltf(const std::string& path, std::string_view bytes);

struct PlacedNode {
    int node; ///< of Model::nodes
    glm::dmat4 worldFromNode;
};

/// The nodes of the file's scene, parents before their children. Throws DataError where they are
/// no tree, or one's place is none.
std::vector<PlacedNode> placedNodes(const Gltf& file);

/// What a node is called: by itself, else by what it holds, else by its number.
std::string nameOfNode(const Gltf& file, int node, const std::string& held);

/// A member of an extension, or null.
const tinygltf::Value* member(const tinygltf::ExtensionMap& extensions,
                              const std::string& extension, const std::string& name);

/// A member that is a number, or `fallback`. Throws DataError where it is no finite number.
double numberIn(const Gltf& file, const tinygltf::ExtensionMap& extensions,
                const std::string& extension, const std::string& name, double fallback);

/// Three numbers, all at least 0. Throws DataError for others.
glm::dvec3 colourOf(const Gltf& file, const std::vector<double>& numbers,
                    const glm::dvec3& fallback, const std::string& what);

/// Adds what is not there yet.
void addOnce(std::vector<std::string>& list, const std::string& item);

} // namespace eikonal::scenefile
