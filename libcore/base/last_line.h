// The last line of a run that a library ends: by a signal, an exception nobody can catch, or
// exit(). SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"

#include <exception>

namespace eikonal {

/// From now on such an end removes every open temporary, says one line under that name, and has a
/// status: memory where the system refuses more memory or threads, internal otherwise. The name
/// must live as long.
void endInOneLine(const char* tool);

/// The same for exceptions alone, early enough for what libraries do before main.
void endExceptionsInOneLine(const char* tool);

/// What a library's exception means: memory where the system refused memory or a thread.
Error meaningOf(const std::exception& error);

/// The run has ended with this status, which nothing changes any more.
void endOrderly(int status);

} // namespace eikonal
