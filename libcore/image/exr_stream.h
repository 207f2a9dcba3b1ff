// OpenEXR's way to memory and streams, for outputs and inputs that are no plain files.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <OpenEXR/ImfIO.h>
#include <algorithm>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace eikonal::image {

/// OpenEXR's way to a std::ostream. It remembers a failure, since the destructor of
/// Imf::OutputFile, which writes the table of line offsets, swallows exceptions.
class StreamOutput : public Imf::OStream {
public:
    StreamOutput(std::ostream& stream, const std::string& path)
        : Imf::OStream(path.c_str()), mStream(stream) {}

    void write(const char bytes[], int count) override {
        mStream.write(bytes, count);
        mPosition += static_cast<uint64_t>(count);
        check();
    }
    uint64_t tellp() override { return mPosition; }
    void seekp(uint64_t position) override {
        mStream.seekp(static_cast<std::streamoff>(position));
        mPosition = position;
        check();
    }
    bool failed() const { return mFailed; }

private:
    void check() {
        if (mStream) return;
        mFailed = true;
        throw std::runtime_error("write failed");
    }
    std::ostream& mStream;
    uint64_t mPosition = 0; // the outputs start empty
    bool mFailed = false;
};

/// A whole file in memory, which outlives this.
class MemoryInput : public Imf::IStream {
public:
    MemoryInput(std::string_view bytes, const std::string& path)
        : Imf::IStream(path.c_str()), mBytes(bytes) {}

    bool read(char out[], int count) override {
        const auto wanted = static_cast<uint64_t>(count);
        if (count < 0 || wanted > mBytes.size() - mPosition)
            throw std::runtime_error("ends before its data do");
        std::memcpy(out, mBytes.data() + mPosition, wanted);
        mPosition += wanted;
        return mPosition < mBytes.size();
    }
    uint64_t tellg() override { return mPosition; }
    void seekg(uint64_t position) override {
        mPosition = std::min<uint64_t>(position, mBytes.size());
    }

private:
    std::string_view mBytes;
    uint64_t mPosition = 0;
};

} // namespace eikonal::image
