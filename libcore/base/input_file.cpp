// Inputs of any kind: regular files, FIFOs, process substitutions, "-" for standard input.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/input_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
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
