// Inputs of any kind: regular files, FIFOs, process substitutions, "-" for standard input.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/input_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace eikonal {

bool isStream(const std::string& path) {
    if (path == "-") return true;
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return false;
    return S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode) || S_ISCHR(status.st_mode);
}

SeekableInput::SeekableInput(const std::string& path) : mPath(path) {
    if (!isStream(path)) return;
    const std::string bytes = readWhole(path);
    mDescriptor = ::memfd_create("input", MFD_CLOEXEC);
    if (mDescriptor < 0) throw MemoryError(path + ": can't be kept: " + std::strerror(errno));
    size_t kept = 0;
    while (kept < bytes.size()) {
        const ssize_t part = ::write(mDescriptor, bytes.data() + kept, bytes.size() - kept);
        if (part < 0 && errno == EINTR) continue;
        if (part <= 0) {
            const std::string reason = std::strerror(errno);
            ::close(mDescriptor);
            throw MemoryError(path + ": can't be kept: " + reason);
        }
        kept += static_cast<size_t>(part);
    }
    mPath = "/proc/self/fd/" + std::to_string(mDescriptor);
}

SeekableInput::~SeekableInput() {
    if (mDescriptor >= 0) ::close(mDescriptor);
}

std::string readWhole(const std::string& path) {
    const bool standard = path == "-";
    const std::string name = standard ? "standard input" : path;
    const int file = standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) throw MissingError(name + ": can't open: " + std::strerror(errno));
    std::string bytes;
    std::vector<char> block(1 << 20);
    ssize_t got = 0;
    do {
        got = ::read(file, block.data(), block.size());
        if (got > 0) bytes.append(block.data(), static_cast<size_t>(got));
    } while (got > 0 || (got < 0 && errno == EINTR));
    const int error = got < 0 ? errno : 0;
    if (!standard) ::close(file);
    if (error != 0) throw MissingError(name + ": can't read: " + std::strerror(error));
    return bytes;
}

} // namespace eikonal
