// A VDB file's bytes, read with every length held against what is left; knows nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace eikonal::volume {

/// What is wrong with a VDB file, in words that stand behind its name.
class VdbDamage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A file, or a stream that was read whole, by position.
class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual std::uint64_t size() const = 0;
    /// All `count` bytes from `position` on; throws VdbDamage where they are not there.
    virtual void read(std::uint64_t position, char* to, std::uint64_t count) const = 0;
};

std::unique_ptr<ByteSource> memorySource(std::shared_ptr<const std::string> bytes);

/// Throws MissingError if the file can't be opened or read.
std::unique_ptr<ByteSource> fileSource(const std::string& path);

/// Walks through part of a source.
class ByteReader {
public:
    ByteReader(const ByteSource& source, std::uint64_t begin, std::uint64_t end);

    std::uint64_t position() const { return mPosition; }
    std::uint64_t left() const { return mEnd - mPosition; }

    /// The next bytes, at most kMostAtOnce, which are there until more are taken.
    const char* take(std::uint64_t count);
    void skip(std::uint64_t count);
    /// Any number of bytes.
    std::string bytes(std::uint64_t count);

    template<typename T> T value() {
        T result;
        std::memcpy(&result, take(sizeof(T)), sizeof(T));
        return result;
    }
    /// A length in 32 bits and so many bytes.
    std::string text();

    static constexpr std::uint64_t kMostAtOnce = 1 << 14;

private:
    void require(std::uint64_t count) const;

    const ByteSource& mSource;
    std::uint64_t mPosition, mEnd;
    std::uint64_t mWindowAt = 0;
    std::vector<char> mWindow;
};

} // namespace eikonal::volume
