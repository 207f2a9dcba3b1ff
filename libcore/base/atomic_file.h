// Output files that exist only when they are whole: the last step of every stage.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <ostream>
#include <string>

namespace eikonal {

/// An output being written. A regular file goes to a temporary beside it and is renamed by
/// commit() (a symbolic link is followed); a device or FIFO is written in place, and so is an open
/// descriptor: "-", standard output, or what /dev/stdout, /dev/fd/N and >(command) lead to.
/// Destroyed before commit(), or on SIGINT and SIGTERM after removeTemporariesOnSignals(), it
/// leaves nothing behind. Open it before the work, so that a bad path is found at once.
class AtomicFile {
public:
    /// Throws CreateError if the file can't be created, or exists under `noClobber`.
    explicit AtomicFile(const std::string& path, bool noClobber = false);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// A buffered stream onto the output. Failures show in commit().
    std::ostream& stream();

    /// Whether the stream can seek (a regular file), as VDB and EXR writers want to know.
    bool seekable() const;

    /// Where the bytes go now, for libraries that only take a path; equals path() for devices.
    const std::string& temporaryPath() const;
    const std::string& path() const;

    /// Flushes and checks that every byte arrived; the stream is closed after that. Where a run has
    /// several outputs, finish them all before committing any. Throws IoError, and ClosedPipe
    /// where the reader of a pipe has gone.
    void finish();

    /// finish(), if that was not done, and the rename. Throws IoError, CreateError.
    void commit();

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

/// Makes SIGINT, SIGTERM and SIGHUP remove every open temporary and then end the process by that
/// signal (so a shell sees 128 + N), and SIGPIPE and SIGXFSZ ordinary write errors. Called once, by
/// main.
void removeTemporariesOnSignals();

/// Removes every open temporary; all that a signal handler may do.
void removeTemporaries();

/// Whether a descriptor is a pipe that nobody reads any more.
bool readerIsGone(int descriptor);

/// Ends the process as SIGPIPE does, which says nothing; a shell sees 141.
[[noreturn]] void endByClosedPipe();

/// Whether an output of that path is written in place: devices, FIFOs, open descriptors.
bool writtenInPlace(const std::string& path);

/// Whether both paths name the same existing file. "-" is no file.
bool sameFile(const std::string& a, const std::string& b);

} // namespace eikonal
