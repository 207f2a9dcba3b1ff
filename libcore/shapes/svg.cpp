// The first outline of an SVG drawing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/svg.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace eikonal::shapes {

namespace {

/// Products of what is no larger do not overflow.
constexpr double kLargest = 1e100;

constexpr std::string_view kBlanks = " \t\r\n\f";

struct Tag {
    std::string_view name, text; ///< without angle brackets
};

/// Steps to the next tag; comments, declarations and what lies between tags are passed over.
bool nextTag(std::string_view& rest, Tag& tag) {
    for (;;) {
        const size_t open = rest.find('<');
        if (open == std::string_view::npos) return false;
        rest.remove_prefix(open + 1);
        if (rest.starts_with("!--")) {
            const size_t end = rest.find("-->");
            if (end == std::string_view::npos) return false;
            rest.remove_prefix(end + 3);
            continue;
        }
        size_t end = 0;
        for (char quote = 0; end < rest.size() && (quote || rest[end] != '>'); ++end) {
            const char c = rest[end];
            if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? '\0' : c;
        }
        if (end == rest.size()) return false;
        tag.text = rest.substr(0, end);
        tag.name = tag.text.substr(0, tag.text.find_first_of(" \t\r\n\f/", 1));
        rest.remove_prefix(end + 1);
        if (tag.text.starts_with("!") || tag.text.starts_with("?")) continue;
        return true;
    }
}

/// An attribute's value, or nothing.
std::optional<std::string_view> attribute(const Tag& tag, std::string_view name) {
    std::string_view rest = tag.text.substr(tag.name.size());
    for (;;) {
        const size_t begin = rest.find_first_not_of(kBlanks);
        const size_t equals = rest.find('=');
        if (begin == std::string_view::npos || equals == std::string_view::npos) return {};
        std::string_view found = rest.substr(begin, equals - begin);
        found = found.substr(0, found.find_last_not_of(kBlanks) + 1);
        const size_t quote = rest.find_first_of("\"'", equals);
        if (quote == std::string_view::npos) return {};
        const size_t end = rest.find(rest[quote], quote + 1);
        if (end == std::string_view::npos) return {};
        if (found == name) return rest.substr(quote + 1, end - quote - 1);
        rest.remove_prefix(end + 1);
    }
}

/// The numbers and letters of path data or of a list of points.
class PathText {
public:
    PathText(std::string_view text, const std::string& title) : mText(text), mTitle(title) {}

    bool atEnd() {
        while (mAt < mText.size() &&
               (kBlanks.find(mText[mAt]) != std::string_view::npos || mText[mAt] == ','))
            ++mAt;
        return mAt == mText.size();
    }
    /// A letter, or 0 where a number begins.
    char letter() {
        const char c = mText[mAt];
        mToken = mAt;
        const bool number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
        return number ? '\0' : mText[mAt++];
    }
    double number() {
        const bool end = atEnd();
        mToken = mAt;
        if (end) fail("the end", "a number");
        double value = 0;
        const char* const begin = mText.data() + mAt + (mText[mAt] == '+');
        const auto [behind, error] = std::from_chars(begin, mText.data() + mText.size(), value);
        if (error != std::errc() || !std::isfinite(value)) fail(here(), "a number");
        if (std::abs(value) > kLargest)
            fail("a number beyond " + toText(kLargest), "a smaller one");
        mAt = static_cast<size_t>(behind - mText.data());
        return value;
    }
    glm::dvec2 point() {
        const double x = number();
        return {x, number()};
    }
    /// A single 0 or 1, which nothing need keep apart from what follows.
    bool flag() {
        const bool end = atEnd();
        mToken = mAt;
        if (end || (mText[mAt] != '0' && mText[mAt] != '1'))
            fail(end ? "the end" : here(), "a flag, 0 or 1");
        return mText[mAt++] == '1';
    }
    std::string here() const { return "'" + std::string(mText.substr(mAt, 1)) + "'"; }
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw DataError(mTitle + ": character " + std::to_string(mToken + 1) +
                        " of the outline: found " + found + ", expected " + expected);
    }

private:
    std::string_view mText;
    const std::string& mTitle;
    size_t mAt = 0, mToken = 0; ///< where it is, and where the last letter or number began
};

/// An ellipse's arc from one point to another, as SVG 1.1 appendix F.6 has it: cubics of at most an
/// eighth of a turn each, which leave it by 4e-6 of its radius at most.
std::vector<std::vector<glm::dvec2>> arcCurves(const glm::dvec2& from, const glm::dvec2& to,
                                               glm::dvec2 radii, double turn, bool large,
                                               bool sweep) {
    radii = glm::abs(radii);
    if (from == to) return {};
    // Radii too unlike make a line; those that are nothing beside the chord grow below in any case.
    const double larger = std::max(radii.x, radii.y), least = 1e-9 * glm::length(to - from);
    if (std::min(radii.x, radii.y) <= 1e-9 * larger) return {{from, to}};
    if (larger < least) radii *= least / larger;
    // Where the ellipse is the unit circle.
    const double c = std::cos(turn), s = std::sin(turn);
    const glm::dmat2 axes({c, s}, {-s, c});
    const auto onCircle = [&](const glm::dvec2& p) { return (p * axes) / radii; };
    const auto onEllipse = [&](const glm::dvec2& p) { return axes * (p * radii); };
    const glm::dvec2 half = 0.5 * (onCircle(to) - onCircle(from));
    const double reach = glm::length(half);
    // Radii that are too small grow until they reach.
    if (reach > 1) radii *= reach;
    const glm::dvec2 a = onCircle(from), b = onCircle(to), chord = 0.5 * (b - a);
    const double off = std::sqrt(std::max(0.0, 1 / glm::dot(chord, chord) - 1));
    const glm::dvec2 across = glm::dvec2(-chord.y, chord.x) * off;
    const glm::dvec2 centre = 0.5 * (a + b) + (large == sweep ? -across : across);
    const glm::dvec2 first = a - centre, last = b - centre;
    const double begin = std::atan2(first.y, first.x);
    double angle = std::atan2(last.y, last.x) - begin;
    if (sweep && angle < 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle > 0) angle -= 2 * std::numbers::pi;
    const int parts =
        std::max(1, static_cast<int>(std::ceil(4 * std::abs(angle) / std::numbers::pi)));
    const double step = angle / parts, handle = 4.0 / 3 * std::tan(step / 4);
    const auto at = [](double t) { return glm::dvec2(std::cos(t), std::sin(t)); };
    const auto along = [](double t) { return glm::dvec2(-std::sin(t), std::cos(t)); };
    std::vector<std::vector<glm::dvec2>> curves;
    glm::dvec2 pen = from;
    for (int k = 0; k < parts; ++k) {
        const double t = begin + k * step, u = t + step;
        const glm::dvec2 end = k + 1 == parts ? to : onEllipse(centre + at(u));
        curves.push_back({pen, onEllipse(centre + at(t) + handle * along(t)),
                          onEllipse(centre + at(u) - handle * along(u)), end});
        pen = end;
    }
    return curves;
}

class PathReader {
public:
    PathReader(std::string_view text, const std::string& title) : mText(text, title) {}

    SvgOutline read() {
        char command = '\0';
        while (!mText.atEnd()) {
            const char letter = mText.letter();
            if (letter) command = letter;
            if (mOutline.closed) mText.fail("more behind Z", "one outline alone");
            if (!mBegun && command != 'M' && command != 'm')
                mText.fail(command ? std::string("'") + command + "'" : "a number", "M first");
            take(command);
            // Further points behind M are lines'.
            if (command == 'M') command = 'L';
            if (command == 'm') command = 'l';
        }
        if (mOutline.curves.empty()) mText.fail("the end", "lines or curves");
        return std::move(mOutline);
    }

private:
    void take(char command) {
        const bool relative = command >= 'a';
        const glm::dvec2 base = relative ? mPen : glm::dvec2(0);
        switch (relative ? command - 'a' + 'A' : command) {
        case 'M':
            if (mBegun) mText.fail(std::string("a second '") + command + "'", "one outline alone");
            mBegun = true;
            mPen = mStart = mText.point();
            return;
        case 'L':
            return draw({mPen, base + mText.point()});
        case 'H':
            return draw({mPen, {base.x + mText.number(), mPen.y}});
        case 'V':
            return draw({mPen, {mPen.x, base.y + mText.number()}});
        case 'Q': {
            const glm::dvec2 a = mText.point(), b = mText.point();
            return draw({mPen, base + a, base + b});
        }
        case 'C': {
            const glm::dvec2 a = mText.point(), b = mText.point(), c = mText.point();
            return draw({mPen, base + a, base + b, base + c});
        }
        case 'S': {
            const glm::dvec2 a = mirrored(4), b = mText.point(), c = mText.point();
            return draw({mPen, a, base + b, base + c});
        }
        case 'T': {
            const glm::dvec2 a = mirrored(3);
            return draw({mPen, a, base + mText.point()});
        }
        case 'A': {
            const glm::dvec2 radii = mText.point();
            const double turn = glm::radians(mText.number());
            const bool large = mText.flag(), sweep = mText.flag();
            for (auto& curve : arcCurves(mPen, base + mText.point(), radii, turn, large, sweep))
                draw(std::move(curve));
            mSmooth = 0;
            return;
        }
        case 'Z':
            if (mPen != mStart) draw({mPen, mStart});
            mOutline.closed = true;
            return;
        default:
            mText.fail(std::string("'") + command + "'", "M L H V C S Q T A or Z");
        }
    }
    /// The last control point of the curve before, mirrored at the pen, if that had so many points.
    glm::dvec2 mirrored(size_t points) const {
        if (mSmooth != points) return mPen;
        const auto& before = mOutline.curves.back();
        return 2.0 * mPen - before[before.size() - 2];
    }
    void draw(std::vector<glm::dvec2> control) {
        mPen = control.back();
        mSmooth = control.size();
        mOutline.curves.push_back(std::move(control));
    }

    PathText mText;
    SvgOutline mOutline;
    glm::dvec2 mPen{0}, mStart{0};
    size_t mSmooth = 0; ///< points of the curve before, where S or T may go on from it
    bool mBegun = false;
};

SvgOutline readPoints(std::string_view text, bool closed, const std::string& title) {
    PathText points(text, title);
    SvgOutline outline;
    outline.closed = closed;
    std::vector<glm::dvec2> all;
    while (!points.atEnd()) all.push_back(points.point());
    if (closed && !all.empty()) all.push_back(all.front());
    for (size_t i = 0; i + 1 < all.size(); ++i) outline.curves.push_back({all[i], all[i + 1]});
    if (outline.curves.empty()) points.fail("the end", "two points");
    return outline;
}

} // namespace

SvgOutline readSvg(std::string_view text, const std::string& title) {
    static const std::set<std::string_view> undrawn = {"defs", "clipPath", "marker",
                                                       "mask", "pattern",  "symbol"};
    struct Open {
        bool undrawn, moved;
    };
    std::vector<Open> open = {{false, false}};
    Tag tag;
    while (nextTag(text, tag)) {
        if (tag.text.starts_with("/")) {
            if (open.size() > 1) open.pop_back();
            continue;
        }
        const bool moved = open.back().moved || attribute(tag, "transform").has_value();
        const bool path = tag.name == "path", polygon = tag.name == "polygon";
        if (!open.back().undrawn && (path || polygon || tag.name == "polyline")) {
            const auto data = attribute(tag, path ? "d" : "points");
            if (!data)
                throw DataError(title + ": found a " + std::string(tag.name) + " without " +
                                (path ? "d" : "points") + ", expected an outline");
            if (moved)
                throw DataError(title +
                                ": found a transform of the outline, expected none (drawing "
                                "programs can apply it)");
            return path ? PathReader(*data, title).read() : readPoints(*data, polygon, title);
        }
        if (!tag.text.ends_with("/"))
            open.push_back({open.back().undrawn || undrawn.contains(tag.name), moved});
    }
    throw DataError(title + ": found no path, polyline or polygon, expected an outline");
}

} // namespace eikonal::shapes
