// Words as solid letters.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/logo.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "mesh/fill_loops.h"
#include "shapes/curves.h"

#include <algorithm>
#include <cmath>
#include <ft2build.h>
#include <iomanip>
#include <memory>
#include <sstream>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace eikonal::shapes {

namespace {

using Loops = std::vector<std::vector<glm::dvec2>>;

/// The characters of UTF-8, as numbers. Throws UsageError of what is none.
std::vector<char32_t> charactersOf(const std::string& text) {
    std::vector<char32_t> characters;
    for (size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const size_t length = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
        bool valid = i + length <= text.size() && (lead < 0x80 || lead >= 0xc2) && lead < 0xf5;
        char32_t c = length == 1 ? lead : lead & (0x7fu >> length);
        for (size_t k = 1; valid && k < length; ++k) {
            const auto byte = static_cast<unsigned char>(text[i + k]);
            valid = (byte & 0xc0) == 0x80;
            c = c << 6 | (byte & 0x3fu);
        }
        if (!valid) throw UsageError("TEXT: byte " + std::to_string(i + 1) + " is no UTF-8");
        characters.push_back(c);
        i += length;
    }
    return characters;
}

/// A font open, measured in its own units.
class Font {
public:
    explicit Font(const std::string& path) : mPath(path), mBytes(readWhole(path)) {
        if (FT_Init_FreeType(&mLibrary) != 0) throw InternalError("FreeType does not start");
        if (FT_New_Memory_Face(mLibrary, reinterpret_cast<const FT_Byte*>(mBytes.data()),
                               static_cast<FT_Long>(mBytes.size()), 0, &mFace) != 0) {
            FT_Done_FreeType(mLibrary);
            throw DataError(path +
                            ": found no font that FreeType reads, expected TrueType or OpenType");
        }
    }
    ~Font() {
        FT_Done_Face(mFace);
        FT_Done_FreeType(mLibrary);
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    /// Throws DataError where the font has no outlines, which bitmap fonts have not.
    void requireOutlines() const {
        if (!FT_IS_SCALABLE(mFace))
            throw DataError(mPath + ": found a bitmap font, expected outlines");
    }

    FT_UInt glyphOf(char32_t c) const {
        const FT_UInt glyph = FT_Get_Char_Index(mFace, c);
        if (glyph != 0) return glyph;
        std::ostringstream code;
        code << std::hex << std::uppercase << std::setfill('0') << std::setw(4)
             << static_cast<std::uint32_t>(c);
        throw UsageError("TEXT: no glyph for U+" + code.str() + " in " + baseName(mPath));
    }

    /// Loads a glyph's outline; gives how far the next one is along x.
    double load(FT_UInt glyph) {
        if (FT_Load_Glyph(mFace, glyph, FT_LOAD_NO_SCALE) != 0)
            throw DataError(mPath + ": glyph " + std::to_string(glyph) + " can't be read");
        return static_cast<double>(mFace->glyph->metrics.horiAdvance);
    }
    FT_Outline& outline() { return mFace->glyph->outline; }

    double kerning(FT_UInt left, FT_UInt right) const {
        FT_Vector by{};
        if (!FT_HAS_KERNING(mFace) ||
            FT_Get_Kerning(mFace, left, right, FT_KERNING_UNSCALED, &by) != 0)
            return 0;
        return static_cast<double>(by.x);
    }

    /// Of an H; where there is none, seven tenths of the font's em.
    double capitalHeight() {
        const FT_UInt glyph = FT_Get_Char_Index(mFace, 'H');
        if (glyph != 0) {
            load(glyph);
            if (mFace->glyph->metrics.height > 0)
                return static_cast<double>(mFace->glyph->metrics.horiBearingY);
        }
        return 0.7 * mFace->units_per_EM;
    }

private:
    std::string mPath, mBytes;
    FT_Library mLibrary = nullptr;
    FT_Face mFace = nullptr;
};

/// Takes an outline from FreeType, curve by curve.
struct Pen {
    Loops& loops;
    double scale;
    glm::dvec2 shift;
    double tolerance; ///< [unit]

    glm::dvec2 at(const FT_Vector* v) const {
        return scale * (glm::dvec2(static_cast<double>(v->x), static_cast<double>(v->y)) + shift);
    }
    int draw(std::vector<glm::dvec2> control) {
        control.insert(control.begin(), loops.back().back());
        appendCurve(control, tolerance, loops.back());
        return 0;
    }
};

void drawGlyph(FT_Outline& outline, Pen pen) {
    FT_Outline_Funcs funcs{};
    funcs.move_to = [](const FT_Vector* to, void* user) {
        auto& p = *static_cast<Pen*>(user);
        p.loops.push_back({p.at(to)});
        return 0;
    };
    funcs.line_to = [](const FT_Vector* to, void* user) {
        auto& p = *static_cast<Pen*>(user);
        return p.draw({p.at(to)});
    };
    funcs.conic_to = [](const FT_Vector* a, const FT_Vector* to, void* user) {
        auto& p = *static_cast<Pen*>(user);
        return p.draw({p.at(a), p.at(to)});
    };
    funcs.cubic_to = [](const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
        auto& p = *static_cast<Pen*>(user);
        return p.draw({p.at(a), p.at(b), p.at(to)});
    };
    FT_Outline_Decompose(&outline, &funcs, &pen);
}

/// The text's outlines, each point once [unit].
Loops outlinesOf(const LogoParams& params) {
    Font font(params.font);
    font.requireOutlines();
    const double scale = params.height / font.capitalHeight();
    Loops loops;
    double along = 0; // [font unit]
    FT_UInt before = 0;
    for (const char32_t c : charactersOf(params.text)) {
        const FT_UInt glyph = font.glyphOf(c);
        if (before != 0) along += font.kerning(before, glyph);
        const double advance = font.load(glyph);
        drawGlyph(font.outline(), {loops, scale, {along, 0}, params.tolerance * params.height});
        along += advance;
        before = glyph;
    }
    for (auto& loop : loops) {
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    }
    return loops;
}

} // namespace

void LogoParams::check() const {
    requireOption(height > 0 && std::isfinite(height), "--height", toText(height), "above 0");
    requireOption(depth > 0 && std::isfinite(depth), "--depth", toText(depth), "above 0");
    requireOption(tolerance > 0 && tolerance <= 0.1, "--tolerance", toText(tolerance),
                  "above 0, to 0.1");
}

mesh::TriangleMesh makeLogo(const LogoParams& params) {
    mesh::FilledLoops face = mesh::fillLoops(outlinesOf(params));
    if (face.triangles.empty())
        throw UsageError("TEXT: found '" + params.text + "', expected letters");
    double low = face.points[0].x, high = low;
    for (const glm::dvec2& p : face.points) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
    }
    mesh::TriangleMesh letters;
    for (const double end : {-0.5, 0.5})
        for (const glm::dvec2& p : face.points)
            letters.points.emplace_back(p.x - (low + high) / 2, p.y, end * params.depth);
    const auto front = static_cast<std::uint32_t>(face.points.size());
    for (const glm::uvec3& t : face.triangles) {
        letters.triangles.push_back(t + front);
        letters.triangles.emplace_back(t.x, t.z, t.y);
    }
    for (const auto& [a, b] : face.sides) {
        letters.triangles.emplace_back(a, b, b + front);
        letters.triangles.emplace_back(a, b + front, a + front);
    }
    return letters;
}

} // namespace eikonal::shapes
