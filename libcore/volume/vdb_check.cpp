// The structure of VDB files, held against the bytes there are before OpenVDB reads them. Knows
// nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_check.h"

#include "volume/vdb_tree.h"

#include <optional>
#include <set>

namespace eikonal::volume {

namespace {

constexpr std::uint64_t kMagic = 0x56444220;
// Before, nodes were stored otherwise; later ones don't exist.
constexpr std::uint32_t kOldest = 222, kNewest = 224;
constexpr std::uint64_t kIdentifierBytes = 36;
constexpr char kNameSeparator = '\x1e'; // between a grid's name and its number

/// The length of a metadata item of a type, or nothing if it is free or the type not known.
std::optional<std::uint64_t> lengthOf(const std::string& type) {
    struct Known {
        const char* type;
        std::uint64_t bytes;
    };
    constexpr Known kKnown[] = {{"bool", 1},   {"int32", 4},  {"int64", 8},  {"float", 4},
                                {"double", 8}, {"vec2i", 8},  {"vec2s", 8},  {"vec2d", 16},
                                {"vec3i", 12}, {"vec3s", 12}, {"vec3d", 24}, {"vec4i", 16},
                                {"vec4s", 16}, {"vec4d", 32}, {"mat4s", 64}, {"mat4d", 128}};
    for (const Known& known : kKnown)
        if (type == known.type) return known.bytes;
    return std::nullopt;
}

/// The bytes of a map's numbers, by its type; nothing if it is not a linear one.
std::optional<std::uint64_t> mapBytes(const std::string& type) {
    constexpr std::uint64_t kVector = 24, kMatrix = 128;
    if (type == "AffineMap" || type == "UnitaryMap") return kMatrix;
    if (type == "TranslationMap") return kVector;
    // A scale stands there with what is computed from it: five vectors.
    if (type == "ScaleMap" || type == "UniformScaleMap") return 5 * kVector;
    if (type == "ScaleTranslateMap" || type == "UniformScaleTranslateMap") return 6 * kVector;
    return std::nullopt;
}

/// Walks through a transform; whether it is linear.
bool checkTransform(ByteReader& in) {
    const std::string type = in.text();
    if (const auto bytes = mapBytes(type)) {
        in.skip(*bytes);
        return true;
    }
    if (type != "NonlinearFrustumMap") throw VdbDamage("a transform is of no known kind");
    constexpr std::uint64_t kBoxTaperDepth = 64;
    in.skip(kBoxTaperDepth);
    const auto second = mapBytes(in.text());
    if (!second) throw VdbDamage("a transform is of no known kind");
    in.skip(*second);
    return false;
}

VdbRecord descriptor(ByteReader& in) {
    VdbRecord grid;
    grid.uniqueName = in.text();
    grid.type = in.text();
    const std::string suffix = kHalfSuffix;
    if (grid.type.ends_with(suffix)) {
        grid.half = true;
        grid.type.resize(grid.type.size() - suffix.size());
    }
    grid.sharesWith = in.text();
    return grid;
}

/// The flags, metadata and transform at the reader's place.
VdbParts head(ByteReader& in) {
    constexpr std::uint32_t kFlags = 7;
    VdbParts parts;
    parts.compression = in.value<std::uint32_t>();
    if (parts.compression > kFlags) throw VdbDamage("a grid is compressed in no known way");
    parts.metadata.begin = in.position();
    parts.unsafe = checkMetadata(in);
    parts.metadata.end = parts.transform.begin = in.position();
    parts.linear = checkTransform(in);
    parts.transform.end = in.position();
    return parts;
}

/// Finds where a grid without offsets ends.
void walkThrough(ByteReader& in, VdbRecord& grid) {
    const VdbParts parts = head(in);
    if (!grid.sharesWith.empty()) return;
    const auto layout = layoutOf(grid.type, grid.half, parts.compression);
    if (!layout)
        throw VdbDamage("without offsets, as a stream, it holds the " + grid.valueType() +
                        " grid '" + grid.name() + "', whose end can't be found; expected a file");
    grid.buffers = walkTree(in, *layout).buffers;
}

void readHeader(ByteReader& in, VdbIndex& index) {
    if (in.left() < sizeof kMagic || in.value<std::uint64_t>() != kMagic)
        throw VdbDamage("it does not begin as one");
    index.fileVersion = in.value<std::uint32_t>();
    if (index.fileVersion < kOldest || index.fileVersion > kNewest)
        throw VdbDamage("it is of file format " + std::to_string(index.fileVersion) +
                        ", expected " + std::to_string(kOldest) + " to " + std::to_string(kNewest));
    index.libraryMajor = in.value<std::uint32_t>();
    index.libraryMinor = in.value<std::uint32_t>();
    index.hasOffsets = in.value<std::uint8_t>() != 0;
    in.skip(kIdentifierBytes);
    index.metadataBegin = in.position();
    checkMetadata(in);
    index.metadataEnd = in.position();
}

} // namespace

std::string VdbRecord::name() const {
    return uniqueName.substr(0, uniqueName.find(kNameSeparator));
}

std::string VdbRecord::valueType() const {
    const std::string prefix = "Tree_";
    const size_t from = type.starts_with(prefix) ? prefix.size() : 0;
    return type.substr(from, type.find('_', from) - from);
}

VdbIndex indexOf(const ByteSource& file) {
    ByteReader start(file, 0, file.size());
    VdbIndex index;
    readHeader(start, index);
    const auto count = start.value<std::int32_t>();
    std::uint64_t next = start.position();
    std::set<std::string> names;
    for (std::int32_t i = 0; i < count; ++i) {
        ByteReader in(file, next, file.size());
        VdbRecord grid = descriptor(in);
        const auto begin = in.value<std::uint64_t>();
        grid.buffers = in.value<std::uint64_t>();
        const auto end = in.value<std::uint64_t>();
        grid.begin = in.position();
        if (index.hasOffsets && (begin != grid.begin || end < begin || end > file.size()))
            throw VdbDamage("it is cut short, or an offset in it is wrong");
        if (!index.hasOffsets) walkThrough(in, grid);
        grid.end = next = index.hasOffsets ? end : in.position();
        if (!names.insert(grid.uniqueName).second)
            throw VdbDamage("two grids have one number of one name");
        index.grids.push_back(std::move(grid));
    }
    return index;
}

std::vector<VdbSpan> checkMetadata(ByteReader& in) {
    std::vector<VdbSpan> unsafe;
    const auto count = in.value<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t begin = in.position();
        const std::string name = in.text(), type = in.text();
        const auto bytes = in.value<std::uint32_t>();
        const auto wanted = lengthOf(type);
        if (wanted && *wanted != bytes)
            throw VdbDamage("metadata '" + name + "' are of the wrong length");
        if (type == "bool") {
            if (in.value<std::uint8_t>() > 1)
                throw VdbDamage("metadata '" + name + "' are neither true nor false");
        } else {
            in.skip(bytes);
        }
        if (type == "__delayedload") unsafe.push_back({begin, in.position()});
    }
    return unsafe;
}

VdbParts partsOf(const ByteSource& file, const VdbRecord& grid) {
    ByteReader in(file, grid.begin, grid.end);
    VdbParts parts = head(in);
    parts.tree = {in.position(), grid.end};
    return parts;
}

IndexBox checkTree(const ByteSource& file, const VdbRecord& grid, const VdbParts& parts) {
    const auto layout = layoutOf(grid.type, grid.half, parts.compression);
    if (!layout) throw VdbDamage("its values are of no known type");
    ByteReader in(file, parts.tree.begin, parts.tree.end);
    const IndexBox active = walkTree(in, *layout).active;
    if (in.left() > 0) throw VdbDamage("a tree ends before its place does");
    return active;
}

} // namespace eikonal::volume
