// Words as solid letters.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>

namespace eikonal::shapes {

/// Where Debian's fonts-dejavu-core puts a plain bold font.
constexpr const char* kDefaultFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

struct LogoParams {
    std::string text; ///< UTF-8, one line
    std::string font = kDefaultFont;
    double height = 1;        ///< of a capital letter [unit]
    double depth = 0.3;       ///< along z [unit]
    double tolerance = 0.001; ///< of curves [height of a capital letter]

    /// Throws UsageError.
    void check() const;
};

/// Letters along x, upright on y = 0, reading from +z, about x = 0 and z = 0: outlines of the font
/// (TrueType, OpenType or what else FreeType reads), with its kerning, made deep along z. Outlines
/// that overlap are one. Throws MissingError and DataError of a font that can't be read or has no
/// outlines, UsageError of a character that it has not, and of a text that shows nothing.
mesh::TriangleMesh makeLogo(const LogoParams& params);

} // namespace eikonal::shapes
