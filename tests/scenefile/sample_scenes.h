// Small glTF scenes, made by hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace eikonal::scenefile {

inline std::string base64(const std::string& bytes) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (size_t k = 0; k < 3; ++k)
            three =
                three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
        for (int k = 3; k >= 0; --k) text += letters[three >> (6 * k) & 63];
    }
    const size_t over = (3 - bytes.size() % 3) % 3;
    return text.replace(text.size() - over, over, std::string(over, '='));
}

/// The bytes of a tetrahedron whose faces look outward: four points, then twelve 16-bit indices.
inline std::string tetrahedronBytes() {
    const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint16_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    std::string bytes(sizeof points + sizeof corners, '\0');
    std::memcpy(bytes.data(), points, sizeof points);
    std::memcpy(bytes.data() + sizeof points, corners, sizeof corners);
    return bytes;
}

/// A scene's text, a member each; what a test is after is changed.
struct SceneText {
    std::string asset = R"({"version": "2.0"})";
    std::string scenes = R"([{"nodes": [0]}])";
    std::string nodes = R"([{"name": "Thing", "mesh": 0}])";
    std::string meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}])";
    std::string materials = R"([{"name": "Stuff"}])";
    std::string accessors =
        R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}])";
    std::string bufferViews = R"([{"buffer": 0, "byteLength": 48},
                                 {"buffer": 0, "byteOffset": 48, "byteLength": 24}])";
    std::string bytes = tetrahedronBytes();
    std::string uri = "data:application/octet-stream;base64," + base64(bytes);
    std::string more; ///< further members, a comma before each

    std::string text() const {
        const std::string at = uri.empty() ? "" : R"(, "uri": ")" + uri + '"';
        return R"({"asset": )" + asset + R"(, "scene": 0, "scenes": )" + scenes + R"(, "nodes": )" +
               nodes + R"(, "meshes": )" + meshes + R"(, "materials": )" + materials +
               R"(, "accessors": )" + accessors + R"(, "bufferViews": )" + bufferViews +
               R"(, "buffers": [{"byteLength": )" + std::to_string(bytes.size()) + at + "}]" +
               more + "}";
    }
    /// The same as .glb.
    std::string binary() const {
        SceneText inside = *this;
        inside.uri.clear();
        std::string json = inside.text(), chunk = bytes;
        json.resize((json.size() + 3) / 4 * 4, ' ');
        chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
        const auto number = [](size_t value) {
            const auto little = static_cast<std::uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&little), 4);
        };
        return "glTF" + number(2) + number(28 + json.size() + chunk.size()) + number(json.size()) +
               "JSON" + json + number(chunk.size()) + std::string("BIN\0", 4) + chunk;
    }
};

} // namespace eikonal::scenefile
