// A VDB file open for reading: its structure is checked by ours before OpenVDB reads any of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_file.h"

#include "base/input_file.h"

#include <cstring>
#include <istream>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>
#include <streambuf>

namespace eikonal::volume {

namespace {

/// A stream buffer over bytes that are somebody else's.
class ViewBuffer : public std::streambuf {
public:
    explicit ViewBuffer(std::string_view bytes) {
        char* begin = const_cast<char*>(bytes.data());
        setg(begin, begin, begin + bytes.size());
    }
};

/// A stream that OpenVDB reads parts of a file from, and that throws where it ends.
class PartStream {
public:
    PartStream(std::string_view bytes, const VdbIndex& file, std::uint32_t compression)
        : mBuffer(bytes), mStream(&mBuffer) {
        mStream.exceptions(std::ios_base::failbit | std::ios_base::badbit);
        openvdb::io::setStreamMetadataPtr(mStream, mAbout, false);
        openvdb::io::setVersion(mStream, {file.libraryMajor, file.libraryMinor}, file.fileVersion);
        openvdb::io::setDataCompression(mStream, compression);
    }
    std::istream& stream() { return mStream; }

private:
    openvdb::io::StreamMetadata::Ptr mAbout{new openvdb::io::StreamMetadata}; // by its address
    ViewBuffer mBuffer;
    std::istream mStream;
};

/// The metadata of a part without the items that are unsafe to hand on.
std::string safeMetadata(std::string bytes, std::uint64_t begin,
                         const std::vector<VdbSpan>& unsafe) {
    for (auto item = unsafe.rbegin(); item != unsafe.rend(); ++item)
        bytes.erase(item->begin - begin, item->end - item->begin);
    std::uint32_t count;
    std::memcpy(&count, bytes.data(), sizeof count);
    count -= static_cast<std::uint32_t>(unsafe.size());
    std::memcpy(bytes.data(), &count, sizeof count);
    return bytes;
}

std::string bytesOf(const ByteSource& source, const VdbSpan& span) {
    return ByteReader(source, span.begin, span.end).bytes(span.end - span.begin);
}

/// OpenVDB's own faults, of what no structure shows: damaged compressed values.
template<typename Act> auto asDamage(const Act& act) {
    try {
        return act();
    } catch (const std::ios_base::failure&) {
        throw VdbDamage("it ends within a value");
    } catch (const openvdb::Exception& error) {
        const std::string what = error.what();
        throw VdbDamage(what.substr(0, what.find('\n')));
    }
}

openvdb::GridBase::Ptr headOf(const ByteSource& source, const VdbIndex& file, const VdbRecord& grid,
                              const VdbParts& parts) {
    if (!parts.linear) throw VdbDamage("its transform is not linear, expected uniform voxels");
    return asDamage([&] {
        const openvdb::GridBase::Ptr made = openvdb::GridBase::createGrid(grid.type);
        const std::string metadata =
            safeMetadata(bytesOf(source, parts.metadata), parts.metadata.begin, parts.unsafe);
        made->readMeta(PartStream(metadata, file, 0).stream());
        const std::string transform = bytesOf(source, parts.transform);
        made->readTransform(PartStream(transform, file, 0).stream());
        made->setName(grid.name());
        made->setSaveFloatAsHalf(grid.half);
        return made;
    });
}

} // namespace

VdbFile VdbFile::open(const std::string& path) {
    if (isStream(path)) return VdbFile(std::make_shared<const std::string>(readWhole(path)));
    return VdbFile(fileSource(path));
}

VdbFile::VdbFile(std::shared_ptr<const std::string> bytes)
    : VdbFile(memorySource(std::move(bytes))) {}

VdbFile::VdbFile(std::unique_ptr<ByteSource> source)
    : mSource(std::move(source)), mIndex(indexOf(*mSource)) {}

openvdb::MetaMap VdbFile::metadata() const {
    ByteReader in(*mSource, mIndex.metadataBegin, mIndex.metadataEnd);
    const std::vector<VdbSpan> unsafe = checkMetadata(in);
    const std::string bytes =
        safeMetadata(bytesOf(*mSource, {mIndex.metadataBegin, mIndex.metadataEnd}),
                     mIndex.metadataBegin, unsafe);
    return asDamage([&] {
        openvdb::MetaMap map;
        map.readMeta(PartStream(bytes, mIndex, 0).stream());
        return map;
    });
}

openvdb::GridBase::Ptr VdbFile::readHead(const VdbRecord& grid) const {
    return headOf(*mSource, mIndex, grid, partsOf(*mSource, grid));
}

const VdbRecord& VdbFile::treeOwner(const VdbRecord& grid) const {
    if (grid.sharesWith.empty()) return grid;
    for (const VdbRecord& other : mIndex.grids)
        if (other.uniqueName == grid.sharesWith && other.sharesWith.empty() &&
            other.type == grid.type && other.half == grid.half)
            return other;
    throw VdbDamage("the grid that it shares its tree with is not there");
}

IndexBox VdbFile::checkedBox(const VdbRecord& grid) const {
    const VdbRecord& owner = treeOwner(grid);
    return checkTree(*mSource, owner, partsOf(*mSource, owner));
}

VdbBody VdbFile::body(const VdbRecord& grid) const {
    constexpr std::uint32_t kPointsInPasses = 224;
    if (grid.valueType() == "ptdataidx32" && mIndex.fileVersion < kPointsInPasses)
        throw VdbDamage("points of a file format before " + std::to_string(kPointsInPasses) +
                        " can't be copied");
    VdbBody body{grid.uniqueName, grid.type, grid.half, {}, 0};
    if (grid.sharesWith.empty()) {
        body.bytes = bytesOf(*mSource, {grid.begin, grid.end});
        body.buffers = grid.buffers - grid.begin;
        return body;
    }
    const VdbRecord& owner = treeOwner(grid);
    const VdbParts own = partsOf(*mSource, grid), shared = partsOf(*mSource, owner);
    body.bytes = bytesOf(*mSource, {owner.begin, shared.metadata.begin}) + // compression
                 bytesOf(*mSource, {own.metadata.begin, own.transform.end}) +
                 bytesOf(*mSource, shared.tree);
    body.buffers = body.bytes.size() - (owner.end - owner.buffers);
    return body;
}

openvdb::GridBase::Ptr VdbFile::read(const VdbRecord& grid) const {
    const auto bytes = std::make_shared<const std::string>(body(grid).bytes);
    const auto source = memorySource(bytes);
    VdbRecord whole = grid;
    whole.begin = 0;
    whole.end = bytes->size();
    const VdbParts parts = partsOf(*source, whole);
    checkTree(*source, whole, parts);
    const openvdb::GridBase::Ptr made = headOf(*source, mIndex, whole, parts);
    asDamage([&] {
        PartStream in(std::string_view(*bytes).substr(parts.tree.begin), mIndex, parts.compression);
        made->readTopology(in.stream());
        made->readBuffers(in.stream());
        return true;
    });
    return made;
}

} // namespace eikonal::volume
