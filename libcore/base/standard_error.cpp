// Standard error belongs to the tool: what libraries write there would stand before its one line.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/standard_error.h"

#include <fcntl.h>
#include <unistd.h>

namespace eikonal {

namespace {

int kept = STDERR_FILENO; // process-wide, as the descriptor is

} // namespace

void keepStandardError() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (nowhere >= 0 && copy >= 0 && ::dup2(nowhere, STDERR_FILENO) >= 0) kept = copy;
    if (nowhere >= 0) ::close(nowhere);
}

void tell(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(kept, text.data(), text.size());
        if (written <= 0) return;
        text.remove_prefix(static_cast<size_t>(written));
    }
}

bool tellsTerminal() {
    return ::isatty(kept) != 0;
}

} // namespace eikonal
