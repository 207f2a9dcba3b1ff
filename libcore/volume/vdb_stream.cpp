// OpenVDB's archive on a stream of ours: cut-off files are noticed, repeated runs repeat bytes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_stream.h"

#include <algorithm>
#include <cstdio>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/Stream.h>
#include <streambuf>

namespace eikonal::volume {

namespace {

// Where the identifier stands: magic (8), file version (4), library version (8), offsets flag (1).
constexpr std::streamoff kIdentifierAt = 21;
constexpr std::streamsize kIdentifierLength = 36;

/// The archive's stream functions are protected; this opens them to this file.
class StreamArchive : public openvdb::io::Archive {
public:
    using Archive::write;

    VdbHeader header(std::istream& in) {
        VdbHeader result;
        readHeader(in);
        setFormatVersion(in); // what follows is read by the stream's version
        setLibraryVersion(in);
        result.hasOffsets = inputHasGridOffsets();
        if (!result.hasOffsets) return result;
        openvdb::MetaMap metadata;
        metadata.readMeta(in);
        const int count = readGridCount(in);
        std::streamoff end = 0;
        for (int i = 0; i < count; ++i) {
            openvdb::io::GridDescriptor descriptor;
            descriptor.read(in);
            end = std::max<std::streamoff>(end, descriptor.getEndPos());
            descriptor.seekToEnd(in);
        }
        in.seekg(0, std::ios_base::end);
        result.truncated = in.tellg() < end;
        return result;
    }
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

/// Passes bytes on, replacing the identifier on its way; for outputs that can't seek back.
class IdentifierFilter : public std::streambuf {
public:
    IdentifierFilter(std::ostream& out, std::string identity)
        : mOut(out), mIdentity(std::move(identity)) {}

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        std::streamsize at = 0;
        for (; at < count && mPosition < kIdentifierAt + kIdentifierLength; ++at)
            overflow(static_cast<unsigned char>(bytes[at]));
        mOut.write(bytes + at, count - at);
        mPosition += count - at;
        return mOut ? count : 0;
    }
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        const std::streamoff inside = mPosition++ - kIdentifierAt;
        const bool replace = inside >= 0 && inside < kIdentifierLength;
        mOut.put(replace ? mIdentity[static_cast<size_t>(inside)] : traits_type::to_char_type(c));
        return mOut ? c : traits_type::eof();
    }
    pos_type seekoff(off_type, std::ios_base::seekdir, std::ios_base::openmode) override {
        return pos_type(mPosition); // tellp() alone is asked for
    }

private:
    std::ostream& mOut;
    std::string mIdentity;
    std::streamoff mPosition = 0;
};

} // namespace

VdbHeader readVdbHeader(std::istream& in) {
    return StreamArchive().header(in);
}

void writeVdb(std::ostream& out, bool seekable, const openvdb::GridCPtrVec& grids,
              const openvdb::MetaMap& metadata, const std::string& identity) {
    StreamArchive archive;
    const std::string id = identifier(identity);
    if (seekable) {
        archive.write(out, grids, true, metadata);
        out.seekp(kIdentifierAt);
        out.write(id.data(), kIdentifierLength);
        out.seekp(0, std::ios_base::end);
    } else {
        IdentifierFilter filter(out, id);
        std::ostream filtered(&filter);
        archive.write(filtered, grids, false, metadata);
        if (!filtered) out.setstate(std::ios_base::badbit);
    }
}

} // namespace eikonal::volume
