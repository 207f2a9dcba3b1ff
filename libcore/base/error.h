// Errors as the library throws them; a tool's main turns one into its exit status.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace eikonal {

/// Exit statuses, after sysexits.h. 128 + N is reserved for signal N.
enum class ExitStatus : int {
    done = 0,
    usage = 64,      ///< wrong usage
    data = 65,       ///< input that is no valid data
    missing = 66,    ///< input missing or unreadable
    device = 69,     ///< no usable device
    internal = 70,   ///< a fault of ours, a NaN found in an output included
    memory = 71,     ///< not enough memory, host or device
    cantCreate = 73, ///< output can't be created, or exists under --no-clobber
    io = 74,         ///< read or write failed
};

/// What every engine throws. The message says where, what was found and what was wanted, on one
/// line and without the tool's name, which main puts before it.
class Error : public std::runtime_error {
public:
    Error(ExitStatus status, const std::string& message)
        : std::runtime_error(message), mStatus(status) {}
    ExitStatus status() const { return mStatus; }

private:
    ExitStatus mStatus;
};

/// One class per status, so that call sites read as words.
template<ExitStatus kStatus> class ErrorOf : public Error {
public:
    explicit ErrorOf(const std::string& message) : Error(kStatus, message) {}
};

using UsageError = ErrorOf<ExitStatus::usage>;
using DataError = ErrorOf<ExitStatus::data>;
using MissingError = ErrorOf<ExitStatus::missing>;
using DeviceError = ErrorOf<ExitStatus::device>;
using InternalError = ErrorOf<ExitStatus::internal>;
using MemoryError = ErrorOf<ExitStatus::memory>;
using CreateError = ErrorOf<ExitStatus::cantCreate>;
using IoError = ErrorOf<ExitStatus::io>;

/// The reader of a pipe has gone: no fault, the run just ends, as by SIGPIPE.
class ClosedPipe : public IoError {
public:
    using IoError::IoError;
};

/// Throws UsageError of an option whose value does not hold: what was found, and what was wanted.
inline void requireOption(bool holds, const std::string& option, const std::string& found,
                          const std::string& wanted) {
    if (!holds) throw UsageError(option + ": found " + found + ", expected " + wanted);
}

} // namespace eikonal
