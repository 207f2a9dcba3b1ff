// A VDB file's bytes, read with every length held against what is left; knows nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_bytes.h"

#include "base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace eikonal::volume {

namespace {

constexpr const char* kCutShort = "it is cut short, or a length in it is wrong";

class MemorySource : public ByteSource {
public:
    explicit MemorySource(std::shared_ptr<const std::string> bytes) : mBytes(std::move(bytes)) {}

    std::uint64_t size() const override { return mBytes->size(); }
    void read(std::uint64_t position, char* to, std::uint64_t count) const override {
        if (position > size() || count > size() - position) throw VdbDamage(kCutShort);
        std::copy_n(mBytes->data() + position, count, to);
    }

private:
    std::shared_ptr<const std::string> mBytes;
};

class FileSource : public ByteSource {
public:
    explicit FileSource(const std::string& path)
        : mPath(path), mFile(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
        if (mFile < 0) throw MissingError(path + ": can't open: " + std::strerror(errno));
        struct stat status {};
        ::fstat(mFile, &status);
        mSize = static_cast<std::uint64_t>(status.st_size);
    }
    ~FileSource() override { ::close(mFile); }
    FileSource(const FileSource&) = delete;
    FileSource& operator=(const FileSource&) = delete;

    std::uint64_t size() const override { return mSize; }
    void read(std::uint64_t position, char* to, std::uint64_t count) const override {
        while (count > 0) {
            const ssize_t got = ::pread(mFile, to, count, static_cast<off_t>(position));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) throw MissingError(mPath + ": can't read: " + std::strerror(errno));
            if (got == 0) throw VdbDamage(kCutShort);
            to += got;
            position += static_cast<std::uint64_t>(got);
            count -= static_cast<std::uint64_t>(got);
        }
    }

private:
    std::string mPath;
    int mFile;
    std::uint64_t mSize = 0;
};

} // namespace

std::unique_ptr<ByteSource> memorySource(std::shared_ptr<const std::string> bytes) {
    return std::make_unique<MemorySource>(std::move(bytes));
}

std::unique_ptr<ByteSource> fileSource(const std::string& path) {
    return std::make_unique<FileSource>(path);
}

ByteReader::ByteReader(const ByteSource& source, std::uint64_t begin, std::uint64_t end)
    : mSource(source), mPosition(begin), mEnd(end) {
    if (begin > end || end > source.size()) throw VdbDamage(kCutShort);
}

void ByteReader::require(std::uint64_t count) const {
    if (count > left()) throw VdbDamage(kCutShort);
}

const char* ByteReader::take(std::uint64_t count) {
    require(count);
    if (mPosition < mWindowAt || mPosition + count > mWindowAt + mWindow.size()) {
        mWindowAt = mPosition;
        mWindow.resize(std::min(left(), kMostAtOnce));
        mSource.read(mPosition, mWindow.data(), mWindow.size());
    }
    const char* here = mWindow.data() + (mPosition - mWindowAt);
    mPosition += count;
    return here;
}

void ByteReader::skip(std::uint64_t count) {
    require(count);
    mPosition += count;
}

std::string ByteReader::bytes(std::uint64_t count) {
    require(count);
    std::string result(count, '\0');
    mSource.read(mPosition, result.data(), count);
    mPosition += count;
    return result;
}

std::string ByteReader::text() {
    return bytes(value<std::uint32_t>());
}

} // namespace eikonal::volume
