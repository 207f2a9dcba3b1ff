// glTF 2.0 scenes, text (.gltf) and binary (.glb).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/gltf.h"

#include "base/text.h"
#include "scenefile/gltf_materials.h"
#include "scenefile/gltf_model.h"
#include "scenefile/gltf_primitives.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace eikonal::scenefile {

namespace {

const char* const kPunctual = "KHR_lights_punctual";

bool isKnown(const std::string& extension) {
    static const std::set<std::string> kKnown{
        "KHR_materials_ior",        "KHR_materials_transmission", "KHR_materials_volume",
        "KHR_materials_dispersion", "KHR_lights_punctual",        "KHR_materials_emissive_strength",
        "KHR_mesh_quantization"};
    return kKnown.contains(extension);
}

void tellUnknown(const Gltf& file, Objects& objects) {
    if (!file.model.animations.empty()) addOnce(objects.unknown, "animations");
    for (const std::string& extension : file.model.extensionsUsed)
        if (!isKnown(extension)) addOnce(objects.unknown, extension);
}

/// Adds a node's objects: one for each of its mesh's materials, in their order there.
void addObjects(const Gltf& file, const PlacedNode& placed, size_t& triangles, Objects& objects) {
    const tinygltf::Node& node = file.at(file.model.nodes, placed.node, "node");
    const tinygltf::Mesh& mesh = file.at(file.model.meshes, node.mesh, "mesh");
    const std::string name = nameOfNode(file, placed.node, mesh.name);
    if (node.skin >= 0) addOnce(objects.unknown, "skins");
    std::map<int, Object> byMaterial;
    std::vector<int> order;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (!isOfTriangles(primitive)) {
            addOnce(objects.unknown, "points and lines");
            continue;
        }
        if (!primitive.targets.empty()) addOnce(objects.unknown, "morph targets");
        if (primitive.attributes.contains("COLOR_0")) addOnce(objects.unknown, "vertex colours");
        const int material = std::max(primitive.material, -1);
        if (byMaterial.try_emplace(material).second) order.push_back(material);
        addTriangles(file, primitive, placed.worldFromNode, name, triangles, byMaterial[material]);
    }
    for (const int material : order) {
        Object& object = byMaterial[material];
        if (object.triangles.empty()) continue;
        object.name = name;
        if (material >= 0) object.material = readMaterial(file, material, objects);
        if (order.size() > 1)
            object.name += "." + (object.material ? object.material->name : "no material");
        objects.objects.push_back(std::move(object));
    }
}

Camera cameraOf(const Gltf& file, const PlacedNode& placed) {
    const tinygltf::Camera& given = file.at(
        file.model.cameras, file.model.nodes[static_cast<size_t>(placed.node)].camera, "camera");
    Camera camera;
    camera.name = given.name;
    camera.node = nameOfNode(file, placed.node, given.name);
    const auto along = [&](int axis) {
        const glm::dvec3 direction(placed.worldFromNode[axis]);
        const double length = glm::length(direction);
        if (!(length > 0)) file.fail("camera '" + camera.node + "' is scaled to nothing");
        return direction / length;
    };
    camera.eye = glm::dvec3(placed.worldFromNode[3]);
    camera.forward = -along(2);
    camera.up = along(1);
    camera.parallel = given.type == "orthographic";
    double aspect = given.perspective.aspectRatio;
    if (camera.parallel) {
        camera.height = 2 * given.orthographic.ymag;
        aspect = given.orthographic.xmag / given.orthographic.ymag;
    } else {
        camera.fov = glm::degrees(given.perspective.yfov);
    }
    if (camera.parallel ? !(camera.height > 0 && std::isfinite(camera.height))
                        : !(camera.fov > 0 && camera.fov < 180))
        file.fail("camera '" + camera.node + "' sees nothing: found " +
                  (camera.parallel ? "ymag " + toText(given.orthographic.ymag)
                                   : "yfov " + toText(given.perspective.yfov)));
    if (aspect >= 1e-3 && aspect <= 1e3) camera.aspect = aspect;
    return camera;
}

/// A name that none of `used` has, of letters, digits, '_' and '-'.
std::string lightName(std::string name, std::set<std::string>& used) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
    std::string free = name;
    for (int i = 2; !used.insert(free).second; ++i) free = name + "_" + std::to_string(i);
    return free;
}

Light lightOf(const Gltf& file, const PlacedNode& placed, int index, Lights& lights) {
    const tinygltf::Light& given = file.at(file.model.lights, index, "light");
    const std::string what = "light '" + given.name + "'";
    Light light;
    light.name = nameOfNode(file, placed.node, given.name);
    light.place = glm::dvec3(placed.worldFromNode[3]);
    const glm::dvec3 ahead = -glm::dvec3(placed.worldFromNode[2]);
    const double length = glm::length(ahead);
    if (!(length > 0)) file.fail(what + " is scaled to nothing");
    light.direction = ahead / length;
    constexpr double kLumensPerWatt = 683; // at 540 THz: the SI's K_cd
    const double intensity = file.finite(given.intensity, what + ": intensity");
    if (intensity < 0) file.fail(what + ": found intensity " + toText(intensity));
    light.rgb = colourOf(file, given.color, glm::dvec3(1), what) * intensity / kLumensPerWatt;
    if (given.range > 0) addOnce(lights.unknown, "range");
    if (given.type == "directional") {
        light.kind = Light::Kind::directional;
    } else if (given.type == "point") {
        light.kind = Light::Kind::point;
    } else if (given.type == "spot") {
        light.kind = Light::Kind::spot;
        const double inner = given.spot.innerConeAngle, outer = given.spot.outerConeAngle;
        if (!(inner >= 0 && outer > 0 && inner <= outer && outer <= glm::radians(90.0) + 1e-6))
            file.fail(what + ": found innerConeAngle " + toText(inner) + " and outerConeAngle " +
                      toText(outer) + ", expected 0 <= inner <= outer <= pi/2");
        light.angle = glm::degrees(0.5 * (outer + inner));
        light.soft = glm::degrees(0.5 * (outer - inner));
    } else {
        file.fail(what + ": found type '" + given.type + "', expected directional, point or spot");
    }
    return light;
}

} // namespace

bool isGltf(const std::string& path, std::string_view bytes) {
    std::string ending = baseName(path);
    ending = ending.substr(std::min(ending.rfind('.'), ending.size()));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == ".gltf" || ending == ".glb") return true;
    if (ending == ".obj" || ending == ".off" || ending == ".ply" || ending == ".stl") return false;
    const std::string_view text = withoutByteOrderMark(bytes.substr(0, 4096));
    const size_t first = text.find_first_not_of(" \t\r\n");
    return bytes.starts_with("glTF") || (first != std::string_view::npos && text[first] == '{');
}

Objects readGltfObjects(const std::string& path, std::string_view bytes) {
    const Gltf file = loadGltf(path, bytes);
    Objects objects;
    size_t triangles = 0;
    for (const PlacedNode& placed : placedNodes(file))
        if (file.model.nodes[static_cast<size_t>(placed.node)].mesh >= 0)
            addObjects(file, placed, triangles, objects);
    tellUnknown(file, objects);
    if (objects.objects.empty()) file.fail("its scene has no triangles, expected at least one");
    return objects;
}

std::vector<Camera> readGltfCameras(const std::string& path, std::string_view bytes) {
    const Gltf file = loadGltf(path, bytes);
    std::vector<Camera> cameras;
    for (const PlacedNode& placed : placedNodes(file))
        if (file.model.nodes[static_cast<size_t>(placed.node)].camera >= 0)
            cameras.push_back(cameraOf(file, placed));
    return cameras;
}

Lights readGltfLights(const std::string& path, std::string_view bytes) {
    const Gltf file = loadGltf(path, bytes);
    Lights lights;
    std::set<std::string> used;
    for (const PlacedNode& placed : placedNodes(file)) {
        const tinygltf::Node& node = file.model.nodes[static_cast<size_t>(placed.node)];
        const tinygltf::Value* held = member(node.extensions, kPunctual, "light");
        if (held == nullptr) continue;
        const int index = held->IsNumber() ? held->GetNumberAsInt() : -1;
        Light light = lightOf(file, placed, index, lights);
        light.name = lightName(light.name, used);
        lights.lights.push_back(std::move(light));
    }
    return lights;
}

} // namespace eikonal::scenefile
