// glTF scenes, binary and text, as mesh2vol, lightsim and render read them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "scenefile/gltf.h"
#include "scenefile/mtl.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace eikonal;

template<typename Read> void attempt(const Read& read) {
    try {
        read();
    } catch (const Error&) { // refused, which is fine
        return;
    }
}

void checkObjects(std::string_view bytes) {
    for (const scenefile::Object& object : scenefile::readGltfObjects("scene.glb", bytes).objects) {
        for (const glm::dvec3& point : object.points)
            if (!std::isfinite(point.x + point.y + point.z)) std::abort();
        for (const glm::uvec3& t : object.triangles)
            if (t.x >= object.points.size() || t.y >= object.points.size() ||
                t.z >= object.points.size())
                std::abort();
        if (!object.normals.empty() && object.normals.size() != object.triangles.size())
            std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    attempt([&] { checkObjects(text); });
    attempt([&] { scenefile::readGltfCameras("scene.glb", text); });
    attempt([&] { scenefile::readGltfLights("scene.glb", text); });
    attempt([&] { scenefile::readMtl("scene.mtl", text); });
    return 0;
}
