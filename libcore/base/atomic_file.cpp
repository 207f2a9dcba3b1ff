// Output files that exist only when they are whole: the last step of every stage.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/atomic_file.h"

#include "base/error.h"
#include "base/text.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <streambuf>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace eikonal {

namespace {

// The one piece of process-wide state: a signal handler can reach nothing else. Slots are claimed
// and freed by the main thread and only read by the handler.
struct TemporarySlot {
    std::atomic<bool> used{false};
    char path[4096] = {};
};
// A front of a light and more may be written for each step of time; unused ones are never touched.
std::array<TemporarySlot, 2048> temporaries;

int claimSlot(const std::string& path) {
    for (size_t i = 0; i < temporaries.size(); ++i) {
        if (temporaries[i].used || path.size() >= sizeof temporaries[i].path) continue;
        std::memcpy(temporaries[i].path, path.c_str(), path.size() + 1);
        temporaries[i].used = true;
        return static_cast<int>(i);
    }
    return -1;
}

void onSignal(int signal) {
    removeTemporaries();
    std::signal(signal, SIG_DFL);
    ::raise(signal);
}

constexpr int kMostLinks = 40; // as in the kernel

std::string nameOf(const std::string& path) {
    return path == "-" ? "standard output" : path;
}

/// A stream buffer on a file descriptor that remembers the first errno.
class DescriptorBuffer : public std::streambuf {
public:
    explicit DescriptorBuffer(int descriptor) : mDescriptor(descriptor), mBytes(1 << 18) {
        setp(mBytes.data(), mBytes.data() + mBytes.size());
    }
    int error() const { return mError; }

protected:
    int_type overflow(int_type c) override {
        if (!drain()) return traits_type::eof();
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            *pptr() = traits_type::to_char_type(c);
            pbump(1);
        }
        return traits_type::not_eof(c);
    }
    int sync() override { return drain() ? 0 : -1; }
    pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                     std::ios_base::openmode) override {
        if (!drain()) return pos_type(off_type(-1));
        const int whence = from == std::ios_base::beg   ? SEEK_SET
                           : from == std::ios_base::cur ? SEEK_CUR
                                                        : SEEK_END;
        return pos_type(::lseek(mDescriptor, offset, whence));
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
        return seekoff(off_type(position), std::ios_base::beg, mode);
    }

private:
    bool drain() {
        const char* at = pbase();
        while (at < pptr() && mError == 0) {
            const ssize_t written = ::write(mDescriptor, at, static_cast<size_t>(pptr() - at));
            if (written >= 0)
                at += written;
            else if (errno != EINTR)
                mError = errno;
        }
        setp(mBytes.data(), mBytes.data() + mBytes.size());
        return mError == 0;
    }
    int mDescriptor;
    int mError = 0;
    std::vector<char> mBytes;
};

std::string reason(int error) {
    return std::strerror(error);
}

/// The number N where the path leads to a descriptor of this process, as /dev/stdout, /dev/fd/N
/// and the shell's >(command) do; -1 elsewhere. Such a link is no name of the file behind it: that
/// may be a pipe, gone, or being written from its middle.
int descriptorOf(std::filesystem::path path) {
    std::error_code error;
    const std::filesystem::path own =
        std::filesystem::canonical("/proc/self/fd", error); // /proc/PID/fd
    if (error) return -1;
    for (int hop = 0; hop < kMostLinks; ++hop) {
        const auto folder = std::filesystem::canonical(
            path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), error);
        if (error) return -1;
        if (folder == own) {
            const auto number = parseNumber(path.filename().string());
            return number && *number >= 0 && *number < 1e6 ? static_cast<int>(*number) : -1;
        }
        if (!std::filesystem::is_symlink(path, error)) return -1;
        path = folder / std::filesystem::read_symlink(path, error);
    }
    return -1;
}

} // namespace

struct AtomicFile::Impl {
    std::string path;      // as the user named it
    std::string target;    // behind symbolic links
    std::string temporary; // what is open now
    int descriptor = -1;
    int slot = -1;
    bool regular = false;
    bool noClobber = false;
    std::unique_ptr<DescriptorBuffer> buffer;
    std::unique_ptr<std::ostream> stream;

    /// Writes on where others have written to, as a shell's redirection does.
    void openDescriptor(int number) {
        const int flags = ::fcntl(number, F_GETFL);
        if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY)
            throw CreateError(nameOf(path) + ": can't write: open for reading only");
        // A copy, so that closing it to learn of a late error leaves the other alone.
        descriptor = ::fcntl(number, F_DUPFD_CLOEXEC, 0);
        if (descriptor < 0) throw CreateError(nameOf(path) + ": can't write: " + reason(errno));
        target = temporary = path;
    }

    void openInPlace() {
        temporary = target;
        descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) throw CreateError(path + ": can't open for writing: " + reason(errno));
    }

    void openTemporary() {
        const std::filesystem::path whole(target);
        const std::string folder =
            whole.has_parent_path() ? whole.parent_path().string() + "/" : std::string();
        // The suffix stays last, since some writers choose the format by it.
        std::string pattern =
            folder + "." + whole.stem().string() + ".XXXXXX" + whole.extension().string();
        const int suffix = static_cast<int>(whole.extension().string().size());
        descriptor = ::mkostemps(pattern.data(), suffix, O_CLOEXEC);
        if (descriptor < 0) throw CreateError(path + ": can't create: " + reason(errno));
        temporary = pattern;
        regular = true;
        slot = claimSlot(temporary);
        if (slot < 0) {
            ::unlink(temporary.c_str());
            throw CreateError(path + ": more than " + std::to_string(temporaries.size()) +
                              " outputs, or too long a path");
        }
        // mkostemps makes files private; an output gets the mode that open() would have given it.
        struct stat existing {};
        mode_t mode = 0666;
        if (::stat(target.c_str(), &existing) == 0) {
            mode = existing.st_mode & 07777;
        } else {
            const mode_t mask = ::umask(0);
            ::umask(mask);
            mode &= ~mask;
        }
        ::fchmod(descriptor, mode);
    }

    void close() {
        stream.reset();
        buffer.reset();
        if (descriptor >= 0) ::close(descriptor);
        descriptor = -1;
    }

    void forget() {
        if (slot >= 0) temporaries[static_cast<size_t>(slot)].used = false;
        slot = -1;
    }
};

AtomicFile::AtomicFile(const std::string& path, bool noClobber) : mImpl(new Impl) {
    Impl& file = *mImpl;
    file.path = path;
    file.noClobber = noClobber;
    if (path.empty()) throw CreateError("the output path is empty");
    if (const int number = path == "-" ? STDOUT_FILENO : descriptorOf(path); number >= 0) {
        file.openDescriptor(number);
    } else {
        std::error_code ignored;
        const auto status = std::filesystem::status(path, ignored);
        const bool exists = std::filesystem::exists(status);
        if (std::filesystem::is_directory(status))
            throw CreateError(path + ": is a directory, expected a file");
        if (exists && noClobber && std::filesystem::is_regular_file(status))
            throw CreateError(path + ": exists, and --no-clobber is given");
        file.target = path;
        for (int hop = 0; std::filesystem::is_symlink(file.target, ignored); ++hop) {
            if (hop == kMostLinks) throw CreateError(path + ": too many symbolic links");
            const auto next = std::filesystem::read_symlink(file.target, ignored);
            file.target = (std::filesystem::path(file.target).parent_path() / next).string();
        }
        if (exists && !std::filesystem::is_regular_file(status))
            file.openInPlace();
        else
            file.openTemporary();
    }
    file.buffer = std::make_unique<DescriptorBuffer>(file.descriptor);
    file.stream = std::make_unique<std::ostream>(file.buffer.get());
}

AtomicFile::~AtomicFile() {
    mImpl->close();
    if (mImpl->regular) ::unlink(mImpl->temporary.c_str());
    mImpl->forget();
}

std::ostream& AtomicFile::stream() {
    return *mImpl->stream;
}

bool AtomicFile::seekable() const {
    return mImpl->regular;
}

const std::string& AtomicFile::temporaryPath() const {
    return mImpl->temporary;
}

const std::string& AtomicFile::path() const {
    return mImpl->path;
}

void AtomicFile::finish() {
    Impl& file = *mImpl;
    if (!file.stream) return;
    file.stream->flush();
    const std::string name = nameOf(file.path);
    const int written = file.buffer->error();
    if (written == EPIPE) throw ClosedPipe(name + ": nobody reads it any more");
    if (written != 0) throw IoError(name + ": write failed: " + reason(written));
    if (!*file.stream) throw IoError(name + ": write failed");
    file.stream.reset();
    const int closed = ::close(file.descriptor) == 0 ? 0 : errno;
    file.descriptor = -1;
    if (closed != 0) throw IoError(name + ": write failed: " + reason(closed));
}

void AtomicFile::commit() {
    finish();
    Impl& file = *mImpl;
    if (!file.regular) return;
    if (file.noClobber) {
        // link() refuses an existing name, so a file made meanwhile by another is not lost.
        if (::link(file.temporary.c_str(), file.target.c_str()) != 0)
            throw CreateError(file.path + ": can't create: " + reason(errno));
        ::unlink(file.temporary.c_str());
    } else if (::rename(file.temporary.c_str(), file.target.c_str()) != 0) {
        throw CreateError(file.path + ": can't create: " + reason(errno));
    }
    file.regular = false;
    file.forget();
}

void removeTemporariesOnSignals() {
    // A signal that the caller had us ignore (nohup) stays ignored.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, onSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
    // A closed pipe or a file beyond the size limit then fails the write, which main hears of.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void removeTemporaries() {
    for (TemporarySlot& slot : temporaries)
        if (slot.used) ::unlink(slot.path);
}

bool readerIsGone(int descriptor) {
    pollfd look{descriptor, POLLOUT, 0};
    return ::poll(&look, 1, 0) > 0 && (look.revents & POLLERR) != 0;
}

void endByClosedPipe() {
    removeTemporaries();
    std::signal(SIGPIPE, SIG_DFL);
    ::raise(SIGPIPE);
    ::_exit(128 + SIGPIPE); // where the signal is blocked
}

bool writtenInPlace(const std::string& path) {
    if (path == "-" || descriptorOf(path) >= 0) return true;
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

bool sameFile(const std::string& a, const std::string& b) {
    if (a == "-" || b == "-") return false;
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

} // namespace eikonal
