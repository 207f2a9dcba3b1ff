// PLY, ASCII and binary: a head that says what each element consists of, then the elements.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "mesh/formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace eikonal::mesh {

namespace {

enum class Type { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

Type typeNamed(std::string_view name) {
    if (name == "char" || name == "int8") return Type::int8;
    if (name == "uchar" || name == "uint8") return Type::uint8;
    if (name == "short" || name == "int16") return Type::int16;
    if (name == "ushort" || name == "uint16") return Type::uint16;
    if (name == "int" || name == "int32") return Type::int32;
    if (name == "uint" || name == "uint32") return Type::uint32;
    if (name == "float" || name == "float32") return Type::float32;
    if (name == "double" || name == "float64") return Type::float64;
    return Type::none;
}

size_t bytesOf(Type type) {
    switch (type) {
    case Type::int8:
    case Type::uint8:
        return 1;
    case Type::int16:
    case Type::uint16:
        return 2;
    case Type::float64:
        return 8;
    default:
        return 4;
    }
}

struct Property {
    std::string name;
    Type type = Type::none;
    Type countType = Type::none; ///< other than none for a list
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

enum class Form { ascii, little, big };

struct Head {
    Form form = Form::ascii;
    std::vector<Element> elements;
};

Type knownType(const FileText& text, size_t word) {
    const Type type = word < text.words().size() ? typeNamed(text.words()[word]) : Type::none;
    if (type == Type::none) text.fail(text.quoted(word), "a type like float or uchar");
    return type;
}

Form formOf(const FileText& text) {
    const std::string_view name = text.words().size() > 1 ? text.words()[1] : std::string_view();
    if (name == "ascii") return Form::ascii;
    if (name == "binary_little_endian") return Form::little;
    if (name == "binary_big_endian") return Form::big;
    text.fail(text.quoted(1), "ascii, binary_little_endian or binary_big_endian");
}

Property propertyOf(const FileText& text) {
    const bool isList = text.words().size() > 1 && text.words()[1] == "list";
    Property property;
    property.countType = isList ? knownType(text, 2) : Type::none;
    property.type = knownType(text, isList ? 3 : 1);
    const size_t name = isList ? 4 : 2;
    if (name >= text.words().size()) text.fail(text.quoted(name), "the name of a property");
    property.name = text.words()[name];
    return property;
}

Head readHead(FileText& text) {
    Head head;
    text.nextWords('\0', "'ply'");
    if (text.words()[0] != "ply") text.fail(text.quoted(0), "'ply'");
    for (;;) {
        text.nextWords('\0', "'end_header'");
        const std::string_view word = text.words()[0];
        if (word == "end_header") return head;
        if (word == "comment" || word == "obj_info") continue;
        if (word == "format") {
            head.form = formOf(text);
        } else if (word == "element" && text.words().size() > 2) {
            const std::int64_t count = text.integer(2, "a number of elements");
            head.elements.push_back({std::string(text.words()[1]), count, {}});
        } else if (word == "property" && !head.elements.empty()) {
            head.elements.back().properties.push_back(propertyOf(text));
        } else {
            text.fail(text.quoted(0), "format, element, property, comment or end_header");
        }
    }
}

/// The numbers after the head, one by one, whatever their form.
class Values {
public:
    Values(const std::string& path, Form form, std::string_view bytes)
        : mPath(path), mForm(form), mRest(bytes) {}

    double next(Type type) {
        if (mForm == Form::ascii) return nextWord();
        switch (type) {
        case Type::int8:
            return nextBytes<std::int8_t>();
        case Type::uint8:
            return nextBytes<std::uint8_t>();
        case Type::int16:
            return nextBytes<std::int16_t>();
        case Type::uint16:
            return nextBytes<std::uint16_t>();
        case Type::int32:
            return nextBytes<std::int32_t>();
        case Type::uint32:
            return nextBytes<std::uint32_t>();
        case Type::float32:
            return nextBytes<float>();
        case Type::float64:
            return nextBytes<double>();
        case Type::none:
            break;
        }
        throw InternalError(mPath + ": a PLY property without a type");
    }

    /// Steps over numbers that are of no interest, and so may be anything.
    void skip(Type type, double count) {
        if (mForm == Form::ascii) {
            for (double k = 0; k < count; ++k) takeWord();
            return;
        }
        const double bytes = count * static_cast<double>(bytesOf(type));
        if (bytes > static_cast<double>(mRest.size())) fail("the end of the file", "more data");
        mRest.remove_prefix(static_cast<size_t>(bytes));
    }

    /// A number that is of interest only if it is one.
    float nextOrNaN(Type type) {
        const auto number =
            mForm == Form::ascii ? parseNumber(takeWord()) : std::optional<double>(next(type));
        return number ? static_cast<float>(*number) : std::numeric_limits<float>::quiet_NaN();
    }

    /// How many numbers a property has.
    double countOf(const Property& property) {
        if (property.countType == Type::none) return 1;
        const double count = next(property.countType);
        if (!(count >= 0 && count <= UINT32_MAX) || count != std::floor(count))
            fail("no length of a list", "a whole number");
        return count;
    }

    /// The index of a point, or a negative number.
    std::int64_t nextIndex(Type type) {
        const double value = next(type);
        // Beyond the range of 32-bit indices a double need not convert.
        if (!(std::abs(value) <= UINT32_MAX) || value != std::floor(value))
            fail("no index", "that of a point");
        return static_cast<std::int64_t>(value);
    }

    /// Where the reader is, for its errors.
    void enter(const std::string& element, std::int64_t index) {
        mElement = element;
        mIndex = index;
    }

    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw DataError(mPath + ": found " + found + " in " + mElement + " " +
                        std::to_string(mIndex + 1) + ", expected " + expected);
    }

private:
    template<typename Number> double nextBytes() {
        if (mRest.size() < sizeof(Number)) fail("the end of the file", "more data");
        char bytes[sizeof(Number)];
        const bool swap = (mForm == Form::big) != (std::endian::native == std::endian::big);
        for (size_t i = 0; i < sizeof(Number); ++i)
            bytes[swap ? sizeof(Number) - 1 - i : i] = mRest[i];
        mRest.remove_prefix(sizeof(Number));
        Number number;
        std::memcpy(&number, bytes, sizeof number);
        return static_cast<double>(number);
    }

    std::string_view takeWord() {
        constexpr std::string_view kBlanks = " \t\r\n\f\v";
        mRest.remove_prefix(std::min(mRest.find_first_not_of(kBlanks), mRest.size()));
        if (mRest.empty()) fail("the end of the file", "more data");
        const std::string_view word = mRest.substr(0, mRest.find_first_of(kBlanks));
        mRest.remove_prefix(word.size());
        return word;
    }

    double nextWord() {
        const auto number = parseNumber(takeWord());
        if (!number) fail("something else than a finite number", "one");
        return *number;
    }

    std::string mPath;
    Form mForm;
    std::string_view mRest;
    std::string mElement;
    std::int64_t mIndex = 0;
};

/// -1 for properties other than x, y, z.
int axisOf(const Property& property) {
    if (property.countType != Type::none || property.name.size() != 1) return -1;
    const char name = property.name[0];
    return name >= 'x' && name <= 'z' ? name - 'x' : -1;
}

/// The same of the normal's: nx, ny, nz.
int normalAxisOf(const Property& property) {
    if (property.countType != Type::none || property.name.size() != 2) return -1;
    const char name = property.name[1];
    return property.name[0] == 'n' && name >= 'x' && name <= 'z' ? name - 'x' : -1;
}

bool hasNormals(const Element& element) {
    bool axes[3] = {};
    for (const Property& property : element.properties)
        if (const int axis = normalAxisOf(property); axis >= 0) axes[axis] = true;
    return axes[0] && axes[1] && axes[2];
}

void readVertex(Values& values, const Element& element, bool normals, PolygonSoup& soup) {
    glm::dvec3 point(0);
    glm::vec3 normal(0);
    for (const Property& property : element.properties) {
        const int axis = axisOf(property), normalAxis = normals ? normalAxisOf(property) : -1;
        if (normalAxis >= 0) {
            normal[normalAxis] = values.nextOrNaN(property.type);
            continue;
        }
        if (axis < 0) {
            values.skip(property.type, values.countOf(property));
            continue;
        }
        point[axis] = values.next(property.type);
        if (!std::isfinite(point[axis]))
            values.fail("a coordinate that is no number", "a finite one");
    }
    soup.points.push_back(point);
    if (!normals) return;
    soup.normals.resize(soup.points.size());
    soup.normals.back() = normal;
}

bool isCorners(const Property& property) {
    return property.countType != Type::none &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Reads the corners of an element, and steps over what else it has.
void readCorners(Values& values, const Element& element, std::vector<std::int64_t>& corners) {
    for (const Property& property : element.properties) {
        const double count = values.countOf(property);
        if (!isCorners(property)) {
            values.skip(property.type, count);
            continue;
        }
        for (double k = 0; k < count; ++k) corners.push_back(values.nextIndex(property.type));
    }
}

void readFace(Values& values, const Element& element, PolygonSoup& soup) {
    readCorners(values, element, soup.corners);
    soup.endPolygon();
}

/// Strips one after the other, each ended by a negative index; every triangle shares two corners
/// with the one before, and every second one runs the other way round.
void readStrips(Values& values, const Element& element, PolygonSoup& soup) {
    std::vector<std::int64_t> corners;
    readCorners(values, element, corners);
    for (size_t begin = 0, i = 0; i < corners.size(); ++i) {
        if (corners[i] < 0) begin = i + 1;
        if (i < begin + 2) continue;
        std::int64_t a = corners[i - 2], b = corners[i - 1];
        const std::int64_t c = corners[i];
        if (a == b || b == c || c == a) continue; // strips are joined by such
        if ((i - begin) % 2 == 1) std::swap(a, b);
        soup.corners.insert(soup.corners.end(), {a, b, c});
        soup.endPolygon();
    }
}

void skipElement(Values& values, const Element& element) {
    for (const Property& property : element.properties)
        values.skip(property.type, values.countOf(property));
}

bool isStrips(const Element& element) {
    return element.name == "tristrips";
}

void requireParts(const std::string& path, const Head& head) {
    bool axes[3] = {}, corners = false;
    for (const Element& element : head.elements)
        for (const Property& property : element.properties) {
            const int axis = axisOf(property);
            if (element.name == "vertex" && axis >= 0) axes[axis] = true;
            if ((element.name == "face" || isStrips(element)) && isCorners(property))
                corners = true;
        }
    if (!axes[0] || !axes[1] || !axes[2])
        throw DataError(path + ": found no vertex x, y and z in the head, expected all three");
    if (!corners)
        throw DataError(path + ": found no list of vertex_indices in the head, expected faces");
}

} // namespace

PolygonSoup parsePly(const std::string& path, std::string_view bytes) {
    FileText text(path, bytes);
    const Head head = readHead(text);
    requireParts(path, head);
    Values values(path, head.form, text.rest());
    PolygonSoup soup;
    for (const Element& element : head.elements) {
        // Without properties an element takes no bytes, and its count would be boundless.
        if (element.properties.empty()) continue;
        for (std::int64_t i = 0; i < element.count; ++i) {
            values.enter(element.name, i);
            if (element.name == "vertex")
                readVertex(values, element, hasNormals(element), soup);
            else if (element.name == "face")
                readFace(values, element, soup);
            else if (isStrips(element))
                readStrips(values, element, soup);
            else
                skipElement(values, element);
        }
    }
    if (!soup.normals.empty()) soup.looks = soup.corners; // a normal for each point
    return soup;
}

} // namespace eikonal::mesh
