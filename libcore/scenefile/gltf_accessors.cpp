// The numbers that a glTF file's accessors name, checked against the bytes that there are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace eikonal::scenefile {

namespace {

/// Items of one size, one after the other.
struct Items {
    const unsigned char* first = nullptr;
    size_t count = 0, stride = 0;

    const unsigned char* at(size_t i) const { return first + i * stride; }
};

/// `count` items of `size` bytes from `offset` on in a view of a buffer.
Items itemsIn(const Gltf& file, int viewIndex, size_t offset, size_t count, size_t size,
              const std::string& what) {
    const tinygltf::BufferView& view =
        file.at(file.model.bufferViews, viewIndex, what + ": bufferView");
    const std::vector<unsigned char>& bytes =
        file.at(file.model.buffers, view.buffer, what + ": buffer").data;
    const size_t stride = view.byteStride == 0 ? size : view.byteStride;
    // What is subtracted was compared before, so that nothing wraps around.
    const bool holds = view.byteOffset <= bytes.size() &&
                       view.byteLength <= bytes.size() - view.byteOffset &&
                       offset <= view.byteLength && stride >= size &&
                       (count == 0 || (size <= view.byteLength - offset &&
                                       count - 1 <= (view.byteLength - offset - size) / stride));
    if (!holds)
        file.fail(what + ": " + std::to_string(count) +
                  " items reach beyond the bytes of bufferView " + std::to_string(viewIndex));
    return {bytes.data() + view.byteOffset + offset, count, stride};
}

template<typename T> T numberAt(const unsigned char* at) {
    T number;
    std::memcpy(&number, at, sizeof number);
    return number;
}

/// A whole number as it is, or as a share of its type's largest.
template<typename T> double wholeAt(const unsigned char* at, bool normalized) {
    const double number = numberAt<T>(at);
    if (!normalized) return number;
    return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

size_t sizeOf(const Gltf& file, int component, const std::string& what) {
    switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        file.fail(what + ": found component type " + std::to_string(component));
    }
}

double componentAt(const unsigned char* at, int component, bool normalized) {
    switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return wholeAt<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return wholeAt<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return wholeAt<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return wholeAt<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return wholeAt<std::uint32_t>(at, normalized);
    default:
        return numberAt<float>(at);
    }
}

std::uint32_t indexAt(const unsigned char* at, int component) {
    switch (component) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return numberAt<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return numberAt<std::uint16_t>(at);
    default:
        return numberAt<std::uint32_t>(at);
    }
}

std::vector<std::uint32_t> indicesIn(const Gltf& file, const Items& items, int component,
                                     size_t limit, const std::string& what) {
    if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        file.fail(what + ": found component type " + std::to_string(component) +
                  ", expected unsigned whole numbers");
    std::vector<std::uint32_t> indices(items.count);
    for (size_t i = 0; i < items.count; ++i) {
        indices[i] = indexAt(items.at(i), component);
        if (indices[i] >= limit)
            file.fail(what + ": found " + std::to_string(indices[i]) + ", expected less than " +
                      std::to_string(limit));
    }
    return indices;
}

/// Puts the values that replace others into their places.
void replaceSparse(const Gltf& file, const tinygltf::Accessor& accessor,
                   std::vector<glm::dvec3>& vectors, size_t component, const std::string& what) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        file.fail(what + ": found a sparse accessor of less than nothing");
    const auto count = static_cast<size_t>(sparse.count);
    const int type = sparse.indices.componentType;
    const Items places =
        itemsIn(file, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
                count, sizeOf(file, type, what), what);
    const std::vector<std::uint32_t> indices =
        indicesIn(file, places, type, vectors.size(), what + ": sparse index");
    const Items values =
        itemsIn(file, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                count, 3 * component, what);
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
            vectors[indices[i]][k] = componentAt(values.at(i) + static_cast<size_t>(k) * component,
                                                 accessor.componentType, accessor.normalized);
}

} // namespace

std::vector<glm::dvec3> readVectors(const Gltf& file, int index, const std::string& what) {
    const tinygltf::Accessor& accessor = file.at(file.model.accessors, index, what + ": accessor");
    if (accessor.type != TINYGLTF_TYPE_VEC3)
        file.fail(what + ": its accessor " + std::to_string(index) + " is not of type VEC3");
    const size_t component = sizeOf(file, accessor.componentType, what);
    std::vector<glm::dvec3> vectors;
    if (accessor.bufferView >= 0) {
        const Items items = itemsIn(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                                    3 * component, what);
        vectors.resize(items.count);
        for (size_t i = 0; i < items.count; ++i)
            for (int k = 0; k < 3; ++k)
                vectors[i][k] = componentAt(items.at(i) + static_cast<size_t>(k) * component,
                                            accessor.componentType, accessor.normalized);
    } else {
        // Zeros, but where sparse values replace them: no bytes stand behind their number.
        constexpr size_t kMostZeros = size_t{1} << 22;
        if (accessor.count > kMostZeros)
            file.fail(what + ": found " + std::to_string(accessor.count) +
                      " items without a bufferView, expected at most " +
                      std::to_string(kMostZeros));
        vectors.resize(accessor.count, glm::dvec3(0));
    }
    if (accessor.sparse.isSparse) replaceSparse(file, accessor, vectors, component, what);
    for (const glm::dvec3& vector : vectors)
        for (int k = 0; k < 3; ++k) file.finite(vector[k], what);
    return vectors;
}

std::vector<std::uint32_t> readIndices(const Gltf& file, int index, size_t limit,
                                       const std::string& what) {
    const tinygltf::Accessor& accessor = file.at(file.model.accessors, index, what + ": accessor");
    if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.sparse.isSparse)
        file.fail(what + ": its accessor " + std::to_string(index) +
                  " is not of type SCALAR, dense");
    const Items items = itemsIn(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                                sizeOf(file, accessor.componentType, what), what);
    return indicesIn(file, items, accessor.componentType, limit, what);
}

} // namespace eikonal::scenefile
