// VDB files written: grids that were made go through OpenVDB, those copied as they lay.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_write.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <openvdb/version.h>
#include <sstream>
#include <tbb/parallel_for.h>
#include <type_traits>
#include <vector>

namespace eikonal::volume {

namespace {

constexpr size_t kIdentifierLength = 36;

/// The archive's stream functions are protected; this opens them to this file.
class StreamArchive : public openvdb::io::Archive {
public:
    using Archive::write;
};

/// Two rounds of 64-bit FNV-1a from different starts, in the shape of a UUID.
std::string identifier(const std::string& identity) {
    const auto hash = [&identity](std::uint64_t value) {
        for (unsigned char c : identity) value = (value ^ c) * 0x100000001b3ull;
        return value;
    };
    const std::uint64_t high = hash(0xcbf29ce484222325ull), low = hash(0x9ae16a3b2f90404full);
    char text[kIdentifierLength + 1];
    std::snprintf(text, sizeof text, "%08x-%04x-%04x-%04x-%012llx",
                  static_cast<unsigned>(high >> 32), static_cast<unsigned>(high >> 16 & 0xffff),
                  static_cast<unsigned>(high & 0xffff), static_cast<unsigned>(low >> 48),
                  static_cast<unsigned long long>(low & 0xffffffffffffull));
    return text;
}

template<typename T> void append(std::string& bytes, const T& value) {
    const char* begin = reinterpret_cast<const char*>(&value);
    bytes.append(begin, begin + sizeof value);
}

void appendText(std::string& bytes, const std::string& text) {
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
}

std::string bytesOf(const openvdb::MetaMap& metadata) {
    std::ostringstream out;
    out.exceptions(std::ios_base::badbit);
    metadata.writeMeta(out);
    return out.str();
}

/// A grid of which all threads compress the leaves' values, which OpenVDB does one by one: the
/// bytes are the same.
template<typename GridT> class Quick : public GridT {
public:
    explicit Quick(const GridT& grid) : GridT(const_cast<GridT&>(grid), openvdb::ShallowCopy()) {}

    void writeBuffers(std::ostream& out) const override {
        std::vector<const typename GridT::TreeType::LeafNodeType*> leaves;
        this->tree().getNodes(leaves);
        constexpr size_t kPart = 64, kParts = 64; // leaves, and what is held of them at a time
        for (size_t begin = 0; begin < leaves.size(); begin += kPart * kParts) {
            const size_t end = std::min(begin + kPart * kParts, leaves.size());
            std::vector<std::string> parts((end - begin + kPart - 1) / kPart);
            tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
                std::ostringstream part;
                part.copyfmt(out); // how it is compressed, and the background
                const size_t first = begin + kPart * i, last = std::min(first + kPart, end);
                for (size_t leaf = first; leaf < last; ++leaf)
                    leaves[leaf]->writeBuffers(part, this->saveFloatAsHalf());
                parts[i] = std::move(part).str();
            });
            for (const std::string& part : parts)
                out.write(part.data(), static_cast<std::streamsize>(part.size()));
        }
    }
};

openvdb::GridBase::ConstPtr quick(const openvdb::GridBase::ConstPtr& grid) {
    openvdb::GridBase::ConstPtr made = grid;
    using Grids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Vec3SGrid,
                                    openvdb::Vec3DGrid>;
    grid->apply<Grids>([&](const auto& typed) {
        made = std::make_shared<Quick<std::decay_t<decltype(typed)>>>(typed);
    });
    return made;
}

} // namespace

VdbBody bodyOf(const openvdb::GridBase::ConstPtr& grid) {
    std::stringstream out;
    out.exceptions(std::ios_base::badbit | std::ios_base::failbit);
    StreamArchive().write(out, openvdb::GridCPtrVec{quick(grid)}, true);
    const VdbFile file(std::make_shared<const std::string>(std::move(out).str()));
    if (file.index().grids.size() != 1) throw VdbDamage("OpenVDB wrote no grid");
    const VdbRecord& record = file.index().grids.front();
    file.checkedBox(record);
    return file.body(record);
}

VdbWriter::VdbWriter(std::ostream& out, const openvdb::MetaMap& metadata, size_t grids,
                     const std::string& identity)
    : mOut(out) {
    std::string header;
    append(header, std::int64_t{openvdb::OPENVDB_MAGIC});
    append(header, std::uint32_t{openvdb::OPENVDB_FILE_VERSION});
    append(header, std::uint32_t{openvdb::OPENVDB_LIBRARY_MAJOR_VERSION});
    append(header, std::uint32_t{openvdb::OPENVDB_LIBRARY_MINOR_VERSION});
    append(header, true); // it has offsets
    header += identifier(identity);
    header += bytesOf(metadata);
    append(header, static_cast<std::int32_t>(grids));
    write(header);
}

void VdbWriter::write(const std::string& bytes) {
    mOut.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    mPosition += bytes.size();
}

void VdbWriter::add(const VdbBody& body) {
    using openvdb::io::GridDescriptor;
    std::string name = body.uniqueName;
    for (int i = 1; !mNames.insert(name).second; ++i)
        name = GridDescriptor::addSuffix(GridDescriptor::stripSuffix(body.uniqueName), i);
    std::string descriptor;
    appendText(descriptor, name);
    appendText(descriptor, body.type + (body.half ? kHalfSuffix : ""));
    appendText(descriptor, ""); // its tree is its own
    const std::uint64_t begin = mPosition + descriptor.size() + 3 * sizeof(std::uint64_t);
    append(descriptor, begin);
    append(descriptor, begin + body.buffers);
    append(descriptor, begin + body.bytes.size());
    write(descriptor);
    write(body.bytes);
}

} // namespace eikonal::volume
