// What the readers of this room share: looking at a path before a vendor's library does.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace eikonal::image {

/// Throws MissingError with the system's reason if the path can't be opened for reading or is a
/// folder.
void checkReadable(const std::string& path);

/// Whether the file begins with OpenEXR's magic number, whatever its name.
bool beginsAsExr(const std::string& path);

/// A library's message without line breaks: an error is one line.
std::string oneLine(std::string message);

/// The extension in lower case, without the dot: "png"; "" if there is none.
std::string extensionOf(const std::string& path);

} // namespace eikonal::image
