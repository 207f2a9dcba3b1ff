// glTF scenes: where things are, what they are made of, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/gltf.h"

#include "base/error.h"
#include "scenefile/sample_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace eikonal::scenefile {
namespace {

constexpr double kRounding = 1e-6; // of what files hold in floats

void expectNear(const glm::dvec3& found, const glm::dvec3& wanted, double off = kRounding) {
    EXPECT_LE(glm::distance(found, wanted), off)
        << found.x << ", " << found.y << ", " << found.z << ", expected " << wanted.x << ", "
        << wanted.y << ", " << wanted.z;
}

Objects objectsOf(const SceneText& scene) {
    return readGltfObjects("a.gltf", scene.text());
}

double volumeOf(const Object& object) {
    double sixfold = 0;
    for (const glm::uvec3& t : object.triangles)
        sixfold += glm::dot(object.points[t.x], glm::cross(object.points[t.y], object.points[t.z]));
    return sixfold / 6;
}

Material materialOf(const std::string& json, Objects* all = nullptr) {
    SceneText scene;
    scene.materials = "[" + json + "]";
    const Objects objects = objectsOf(scene);
    if (all != nullptr) *all = objects;
    return objects.objects.at(0).material.value();
}

std::string withExtensions(const std::string& extensions) {
    return R"({"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {)" + extensions + "}}";
}

TEST(Gltf, PlacesNodesInTheirParents) {
    SceneText scene;
    scene.nodes = R"([{"translation": [10, 0, 0], "children": [1]},
                      {"name": "Thing", "mesh": 0, "translation": [0, 1, 0], "scale": [2, 2, 2],
                       "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]}])";
    const Object object = objectsOf(scene).objects.at(0);
    EXPECT_EQ(object.name, "Thing");
    ASSERT_EQ(object.points.size(), 4u);
    expectNear(object.points[0], {10, 1, 0}); // scaled, turned a quarter about Z, shifted
    expectNear(object.points[1], {10, 3, 0});
    expectNear(object.points[2], {8, 1, 0});
    expectNear(object.points[3], {10, 1, 2});
    EXPECT_NEAR(volumeOf(object), 8.0 / 6, kRounding);
}

TEST(Gltf, AMirroringNodeKeepsFacesOutward) {
    SceneText scene;
    scene.nodes = R"([{"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])";
    const Object object = objectsOf(scene).objects.at(0);
    expectNear(object.points[1], {-1, 0, 5});
    EXPECT_NEAR(volumeOf(object), 1.0 / 6, kRounding);
}

TEST(Gltf, EachInstanceAndMaterialIsAnObjectAndOneMaterialsPrimitivesAreOne) {
    SceneText scene;
    scene.scenes = R"([{"nodes": [0, 1]}])";
    scene.nodes =
        R"([{"name": "A", "mesh": 0}, {"name": "B", "mesh": 0, "translation": [2, 0, 0]}])";
    const std::string one = R"({"attributes": {"POSITION": 0}, "indices": 1, "material": )";
    scene.meshes = R"([{"primitives": [)" + one + "0}, " + one + "1}, " + one + "0}]}]";
    scene.materials = R"([{"name": "x"}, {"name": "y"}])";
    const Objects found = objectsOf(scene);
    ASSERT_EQ(found.objects.size(), 4u);
    EXPECT_EQ(found.objects[0].name, "A.x");
    EXPECT_EQ(found.objects[1].name, "A.y");
    EXPECT_EQ(found.objects[2].name, "B.x");
    EXPECT_EQ(found.objects[0].triangles.size(), 8u);
    EXPECT_EQ(found.objects[1].triangles.size(), 4u);
}

TEST(Gltf, BinaryAndTextAreTheSame) {
    const SceneText scene;
    EXPECT_TRUE(isGltf("-", scene.binary()));
    EXPECT_TRUE(isGltf("-", scene.text()));
    EXPECT_FALSE(isGltf("-", "v 0 0 0"));
    const Objects text = objectsOf(scene), binary = readGltfObjects("a.glb", scene.binary());
    EXPECT_EQ(text.objects.at(0).points, binary.objects.at(0).points);
    EXPECT_EQ(text.objects.at(0).triangles, binary.objects.at(0).triangles);
}

TEST(Gltf, SparseValuesReplaceOthers) {
    SceneText scene;
    const std::uint16_t place[2] = {2, 0};
    const float value[3] = {0, 7, 0};
    scene.bytes.append(reinterpret_cast<const char*>(place), 4);
    scene.bytes.append(reinterpret_cast<const char*>(value), 12);
    scene.uri = "data:application/octet-stream;base64," + base64(scene.bytes);
    scene.bufferViews = R"([{"buffer": 0, "byteLength": 48},
        {"buffer": 0, "byteOffset": 48, "byteLength": 24},
        {"buffer": 0, "byteOffset": 72, "byteLength": 4},
        {"buffer": 0, "byteOffset": 76, "byteLength": 12}])";
    scene.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
         "sparse": {"count": 1, "indices": {"bufferView": 2, "componentType": 5123},
                    "values": {"bufferView": 3}}},
        {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}])";
    EXPECT_EQ(objectsOf(scene).objects.at(0).points[2], glm::dvec3(0, 7, 0));
}

TEST(Gltf, AttenuationBecomesAbsorption) {
    const Material m = materialOf(withExtensions(
        R"("KHR_materials_transmission": {"transmissionFactor": 1},
           "KHR_materials_ior": {"ior": 1.7}, "KHR_materials_dispersion": {"dispersion": 0.4},
           "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2,
                                    "attenuationColor": [1, 0.5, 0.25]})"));
    EXPECT_EQ(m.kind, Material::Kind::glass);
    EXPECT_EQ(m.ior, 1.7);
    EXPECT_DOUBLE_EQ(m.abbe, 50); // 20 over the dispersion
    expectNear(m.absorption, {0, std::log(2.0) / 2, std::log(4.0) / 2}, 1e-12);
}

TEST(Gltf, WhatTransmitsWithoutAThicknessIsTold) {
    Objects all;
    const Material m = materialOf(
        R"({"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.3,
                                     "baseColorFactor": [0.2, 0.9, 0.4, 1]},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9}}})",
        &all);
    EXPECT_EQ(m.kind, Material::Kind::glass);
    EXPECT_EQ(m.ior, 1.5);
    EXPECT_EQ(m.absorption, glm::dvec3(0));
    EXPECT_NEAR(m.roughness, 0.09, 1e-12); // GGX's α
    expectNear(m.colour, {0.2, 0.9, 0.4});
    EXPECT_TRUE(all.thinGlass);
}

TEST(Gltf, KindsOfMatter) {
    EXPECT_EQ(materialOf("{}").kind, Material::Kind::metal); // glTF's defaults
    const Material matt = materialOf(
        R"({"pbrMetallicRoughness": {"metallicFactor": 0.4, "baseColorFactor": [0.1, 0.2, 0.3, 1]}})");
    EXPECT_EQ(matt.kind, Material::Kind::matt);
    expectNear(matt.colour, {0.1, 0.2, 0.3});
    const Material lamp = materialOf(
        R"({"pbrMetallicRoughness": {"metallicFactor": 0}, "emissiveFactor": [1, 0.5, 0],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 6}}})");
    EXPECT_EQ(lamp.kind, Material::Kind::glow);
    expectNear(lamp.radiance, {6, 3, 0});
}

TEST(Gltf, WhatIsNotUnderstoodIsNamedOnce) {
    SceneText scene;
    scene.scenes = R"([{"nodes": [0, 1]}])";
    scene.nodes = R"([{"mesh": 0}, {"mesh": 0}])";
    scene.materials = R"([{"alphaMode": "BLEND", "emissiveFactor": [0.1, 0, 0],
        "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}])";
    scene.more = R"(, "textures": [{"source": 0}], "images": [{"uri": "nowhere.png"}],
        "extensionsUsed": ["KHR_materials_sheen", "KHR_materials_ior"])";
    EXPECT_EQ(objectsOf(scene).unknown,
              (std::vector<std::string>{"textures", "alphaMode BLEND",
                                        "emission that is weaker than the colour",
                                        "KHR_materials_sheen"}));
}

TEST(Gltf, Cameras) {
    SceneText scene;
    scene.scenes = R"([{"nodes": [0, 1]}])";
    scene.nodes = R"([{"name": "Stand", "camera": 0, "translation": [1, 2, 3],
                       "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752]},
                      {"camera": 1}])";
    scene.more = R"(, "cameras": [
        {"type": "perspective", "name": "Lens",
         "perspective": {"yfov": 0.7853981633974483, "aspectRatio": 1.5, "znear": 0.1}},
        {"type": "orthographic", "name": "Flat",
         "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 9}}])";
    const std::vector<Camera> cameras = readGltfCameras("a.gltf", scene.text());
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].node, "Stand");
    EXPECT_EQ(cameras[0].name, "Lens");
    expectNear(cameras[0].eye, {1, 2, 3});
    expectNear(cameras[0].forward, {-1, 0, 0}); // -Z, turned a quarter about Y
    expectNear(cameras[0].up, {0, 1, 0});
    EXPECT_DOUBLE_EQ(cameras[0].fov, 45);
    EXPECT_EQ(cameras[0].aspect, 1.5);
    EXPECT_TRUE(cameras[1].parallel);
    EXPECT_EQ(cameras[1].height, 6);
    EXPECT_DOUBLE_EQ(cameras[1].aspect.value(), 4.0 / 3);
}

TEST(Gltf, LightsAreInWatts) {
    SceneText scene;
    scene.scenes = R"([{"nodes": [0, 1, 2]}])";
    const std::string light = R"("extensions": {"KHR_lights_punctual": {"light": )";
    scene.nodes = R"([{"name": "Sun", )" + light + R"(0}}}, {"name": "Lamp 1", "scale": [3, 3, 3],
        "translation": [0, 5, 0], )" +
                  light + R"(1}}}, {"name": "Lamp 1", )" + light + "2}}}]";
    scene.more = R"(, "extensionsRequired": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 1366, "color": [1, 0.5, 0]},
        {"type": "point", "intensity": 683},
        {"type": "spot", "intensity": 683,
         "spot": {"innerConeAngle": 0.17453292519943295, "outerConeAngle": 0.5235987755982988}}]}})";
    const Lights found = readGltfLights("a.gltf", scene.text());
    ASSERT_EQ(found.lights.size(), 3u);
    expectNear(found.lights[0].rgb, {2, 1, 0});
    expectNear(found.lights[0].direction, {0, 0, -1});
    EXPECT_EQ(found.lights[1].kind, Light::Kind::point);
    EXPECT_EQ(found.lights[1].name, "Lamp_1");
    expectNear(found.lights[1].place, {0, 5, 0});
    expectNear(found.lights[1].rgb, glm::dvec3(1)); // whatever its node is scaled by
    EXPECT_EQ(found.lights[2].name, "Lamp_1_2");
    EXPECT_NEAR(found.lights[2].angle, 20, 1e-9);
    EXPECT_NEAR(found.lights[2].soft, 10, 1e-9);
}

/// What a scene changed so is refused with.
template<typename Change> std::string refusal(const Change& change) {
    SceneText scene;
    change(scene);
    try {
        objectsOf(scene);
    } catch (const DataError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message;
    }
    return "(read without complaint)";
}

void expectIn(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(GltfRefusals, SizesBeyondTheBytes) {
    const auto accessor = [](const std::string& points) {
        return refusal([&](SceneText& s) {
            s.accessors = "[" + points + R"(,
                {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}])";
        });
    };
    const std::string head = R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", )";
    expectIn(accessor(head + R"("count": 5})"), "reach beyond");
    expectIn(accessor(head + R"("count": 4294967295})"), "reach beyond");
    expectIn(accessor(head + R"("count": 4, "byteOffset": 4})"), "reach beyond");
    expectIn(accessor(R"({"bufferView": 7, "componentType": 5126, "type": "VEC3", "count": 4})"),
             "bufferView 7");
    expectIn(accessor(R"({"componentType": 5126, "type": "VEC3", "count": 99999999})"),
             "without a bufferView");
    expectIn(refusal([](SceneText& s) {
                 s.bufferViews = R"([{"buffer": 0, "byteOffset": 4000000000, "byteLength": 48},
                                     {"buffer": 0, "byteOffset": 48, "byteLength": 24}])";
             }),
             "reach beyond");
    expectIn(refusal([](SceneText& s) { s.bytes += "abc"; }), "no sound glTF"); // byteLength lies
}

TEST(GltfRefusals, IndicesAndTypes) {
    expectIn(refusal([](SceneText& s) {
                 s.accessors.replace(s.accessors.find("\"count\": 4"), 10, "\"count\": 3");
             }),
             "found 3, expected less than 3");
    expectIn(
        refusal([](SceneText& s) { s.accessors.replace(s.accessors.find("VEC3"), 4, "VEC2"); }),
        "not of type VEC3");
    expectIn(refusal([](SceneText& s) { s.nodes = R"([{"mesh": 5}])"; }), "mesh 5");
    expectIn(refusal([](SceneText& s) { s.scenes = R"([{"nodes": [-3]}])"; }), "node -3");
    expectIn(refusal([](SceneText& s) { s.materials = "[]"; }), "material 0");
}

TEST(GltfRefusals, NodesThatAreNoTree) {
    expectIn(refusal([](SceneText& s) { s.nodes = R"([{"mesh": 0, "children": [0]}])"; }), "twice");
    expectIn(refusal([](SceneText& s) {
                 s.nodes = R"([{"children": [1, 2]}, {"children": [2]}, {"mesh": 0}])";
             }),
             "twice");
    expectIn(
        refusal([](SceneText& s) { s.nodes = R"([{"mesh": 0, "translation": [0, 1e400, 0]}])"; }),
        "no sound glTF");
    expectIn(refusal([](SceneText& s) { s.nodes = R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"; }),
             "rotation of 0");
    expectIn(refusal([](SceneText& s) { s.nodes = R"([{"mesh": 0, "scale": [1, 2]}])"; }),
             "scale has 2 numbers");
}

TEST(GltfRefusals, FilesOfAnotherKind) {
    expectIn(refusal([](SceneText& s) { s.asset = R"({"version": "1.0"})"; }), "version '1.0'");
    expectIn(refusal([](SceneText& s) {
                 s.more = R"(, "extensionsRequired": ["KHR_draco_mesh_compression"])";
             }),
             "KHR_draco_mesh_compression");
    expectIn(refusal([](SceneText& s) {
                 s.more = R"(, "extras": )" + std::string(100000, '[') + std::string(100000, ']');
             }),
             "brackets");
    expectIn(refusal([](SceneText& s) { s.nodes = R"([{"name": "nothing"}])"; }), "no triangles");
    for (const std::string& bytes :
         {std::string("{"), std::string("glTF"), std::string(), SceneText().binary().substr(0, 60)})
        EXPECT_THROW(readGltfObjects("a.gltf", bytes), DataError) << bytes;
}

TEST(GltfRefusals, AMissingBufferIsMissing) {
    SceneText scene;
    scene.uri = "nowhere.bin";
    EXPECT_THROW(objectsOf(scene), MissingError);
}

TEST(GltfRefusals, EveryTruncationAndByteEndsWell) {
    const std::string whole = SceneText().binary();
    for (size_t length = 0; length < whole.size(); length += 7)
        EXPECT_THROW(readGltfObjects("a.glb", whole.substr(0, length)), Error) << length;
    for (size_t at = 0; at < whole.size(); ++at)
        for (const char byte : {'\0', '9', '\xff', '-', '"'}) {
            std::string changed = whole;
            changed[at] = byte;
            try {
                readGltfObjects("a.glb", changed);
            } catch (const Error&) { // refused, which is fine; a crash is not
                continue;
            }
        }
}

} // namespace
} // namespace eikonal::scenefile
