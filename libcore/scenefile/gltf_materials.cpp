// What a glTF material means to light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/gltf_materials.h"

#include "base/text.h"
#include "scenefile/appearance.h"

#include <algorithm>

namespace eikonal::scenefile {

namespace {

const char* const kVolume = "KHR_materials_volume";

double within(const Gltf& file, double number, double low, double high, const std::string& what) {
    if (!(number >= low && number <= high))
        file.fail(what + ": found " + toText(number) + ", expected " + toText(low) + " to " +
                  toText(high));
    return number;
}

glm::dvec3 attenuationOf(const Gltf& file, const tinygltf::Material& given) {
    const tinygltf::Value* colour = member(given.extensions, kVolume, "attenuationColor");
    const tinygltf::Value* distance = member(given.extensions, kVolume, "attenuationDistance");
    if (colour == nullptr || distance == nullptr) return glm::dvec3(0); // infinitely far
    std::vector<double> numbers;
    for (size_t i = 0; colour->IsArray() && i < colour->ArrayLen(); ++i) {
        const tinygltf::Value& number = colour->Get(static_cast<int>(i));
        numbers.push_back(number.IsNumber() ? number.GetNumberAsDouble() : -1);
    }
    const glm::dvec3 share = colourOf(file, numbers, glm::dvec3(1), "attenuationColor");
    const double far = numberIn(file, given.extensions, kVolume, "attenuationDistance", 0);
    if (!(far > 0)) file.fail("attenuationDistance: found " + toText(far) + ", expected above 0");
    return absorptionBy(share, far);
}

bool hasTexture(const tinygltf::Material& m) {
    return m.pbrMetallicRoughness.baseColorTexture.index >= 0 ||
           m.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0 ||
           m.normalTexture.index >= 0 || m.occlusionTexture.index >= 0 ||
           m.emissiveTexture.index >= 0 ||
           member(m.extensions, "KHR_materials_transmission", "transmissionTexture") != nullptr ||
           member(m.extensions, kVolume, "thicknessTexture") != nullptr;
}

} // namespace

Material readMaterial(const Gltf& file, int index, Objects& objects) {
    const tinygltf::Material& given = file.at(file.model.materials, index, "material");
    const std::string what =
        "material " + (given.name.empty() ? std::to_string(index) : "'" + given.name + "'");
    const tinygltf::PbrMetallicRoughness& base = given.pbrMetallicRoughness;
    if (hasTexture(given)) addOnce(objects.unknown, "textures");
    if (!given.alphaMode.empty() && given.alphaMode != "OPAQUE")
        addOnce(objects.unknown, "alphaMode " + given.alphaMode);

    Material material;
    material.name = given.name.empty() ? "material " + std::to_string(index) : given.name;
    material.colour = colourOf(file, base.baseColorFactor, glm::dvec3(1), what);
    for (int i = 0; i < 3; ++i) within(file, material.colour[i], 0, 1, what + ": baseColorFactor");
    const double metallic = within(file, base.metallicFactor, 0, 1, what + ": metallicFactor");
    const double rough = within(file, base.roughnessFactor, 0, 1, what + ": roughnessFactor");
    material.roughness = alphaOf(rough);
    const double ior = numberIn(file, given.extensions, "KHR_materials_ior", "ior", 1.5);
    if (ior == 0)
        addOnce(objects.unknown, "ior 0"); // a mirror at all angles, of older materials
    else
        material.ior = within(file, ior, 1, 100, what + ": ior");
    const double dispersion =
        numberIn(file, given.extensions, "KHR_materials_dispersion", "dispersion", 0);
    within(file, dispersion, 0, 20, what + ": dispersion");
    const double transmission =
        numberIn(file, given.extensions, "KHR_materials_transmission", "transmissionFactor", 0);
    const bool hasVolume = given.extensions.contains(kVolume);

    const glm::dvec3 glow =
        colourOf(file, given.emissiveFactor, glm::dvec3(0), what + ": emissiveFactor") *
        numberIn(file, given.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    if (metallic >= 0.5) {
        material.kind = Material::Kind::metal;
    } else if (transmission > 0.5 || hasVolume) {
        material.kind = Material::Kind::glass;
        if (dispersion > 0) material.abbe = std::min(20 / dispersion, 1000.0);
        material.absorption = attenuationOf(file, given);
        if (numberIn(file, given.extensions, kVolume, "thicknessFactor", 0) == 0)
            objects.thinGlass = true;
    }
    if (takeGlow(material, glow)) return material;
    if (glow != glm::dvec3(0)) addOnce(objects.unknown, "emission that is weaker than the colour");
    return material;
}

} // namespace eikonal::scenefile
