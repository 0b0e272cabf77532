// SPDX-License-Identifier: Apache-2.0
/** Stanford's .ply files. */
#include <map>
#include <optional>

#include "mesh_content.h"

namespace tautline::models {
namespace {

struct Property {
    std::string name;
    NumberType type;
    std::optional<NumberType> countType;  ///< of a list
};

struct ElementType {
    std::string name;
    int count = 0;
    std::vector<Property> properties;
};

enum class Format { Ascii, LittleEndian, BigEndian };

struct Header {
    Format format = Format::Ascii;
    std::vector<ElementType> elements;
};

NumberType readType(MeshContent& content, std::string_view& line) {
    static const std::map<std::string_view, NumberType> kTypes{
        {"char", NumberType::Int8},      {"int8", NumberType::Int8},       {"uchar", NumberType::UInt8},
        {"uint8", NumberType::UInt8},    {"short", NumberType::Int16},     {"int16", NumberType::Int16},
        {"ushort", NumberType::UInt16},  {"uint16", NumberType::UInt16},   {"int", NumberType::Int32},
        {"int32", NumberType::Int32},    {"uint", NumberType::UInt32},     {"uint32", NumberType::UInt32},
        {"float", NumberType::Float32},  {"float32", NumberType::Float32}, {"double", NumberType::Float64},
        {"float64", NumberType::Float64}};
    const std::string_view word = takeWordOf(line);
    const auto type = kTypes.find(word);
    if (type == kTypes.end()) content.failAtLine("unknown type '" + std::string(word) + "'");
    return type->second;
}

Format readFormat(MeshContent& content, std::string_view line) {
    const std::string_view word = takeWordOf(line);
    if (word == "ascii") return Format::Ascii;
    if (word == "binary_little_endian") return Format::LittleEndian;
    if (word == "binary_big_endian") return Format::BigEndian;
    content.failAtLine("unknown format '" + std::string(word) + "'");
}

Property readProperty(MeshContent& content, std::string_view line) {
    Property property;
    std::string_view rest = line;
    if (takeWordOf(rest) == "list") {
        line = rest;
        property.countType = readType(content, line);
    }
    property.type = readType(content, line);
    property.name = takeWordOf(line);
    return property;
}

Header readHeader(MeshContent& content) {
    Header header;
    if (content.takeLine() != "ply") content.failAtLine("does not begin with 'ply'");
    while (!content.isAtEnd()) {
        std::string_view line = content.takeLine();
        const std::string_view what = takeWordOf(line);
        if (what == "end_header") return header;
        if (what == "format") header.format = readFormat(content, line);
        if (what == "element") {
            ElementType element;
            element.name = takeWordOf(line);
            const std::string_view count = takeWordOf(line);
            if (!toInteger(count, element.count) || element.count < 0)
                content.failAtLine("'" + std::string(count) + "' is no number of elements");
            header.elements.push_back(element);
        }
        if (what == "property") {
            if (header.elements.empty()) content.failAtLine("a property before any element");
            header.elements.back().properties.push_back(readProperty(content, line));
        }
    }
    content.failAtLine("ends within its header");
}

double takeValue(MeshContent& content, Format format, NumberType type) {
    if (format == Format::Ascii) return content.takeNumber();
    const std::size_t size = getNumberSize(type);
    if (content.countLeft() < size) content.failAtByte("ends where a number should stand");
    const std::size_t at = content.getPlace();
    content.setPlace(at + size);
    return decodeNumber(content.getBytes().data() + at, type, format == Format::BigEndian);
}

/** A property has one value, or as many as its list says. */
void takeValues(MeshContent& content, Format format, const Property& property, std::vector<double>& values) {
    values.clear();
    double count = 1;
    if (property.countType) {
        count = takeValue(content, format, *property.countType);
        // A value takes a byte at least: so that no count asks for more memory than there are bytes.
        if (!(count >= 0 && count <= static_cast<double>(content.countLeft()))) {
            const std::string what = "a list of more values than there are bytes";
            if (format == Format::Ascii) content.failAtLine(what);
            content.failAtByte(what);
        }
    }
    for (int i = 0; i < static_cast<int>(count); ++i) values.push_back(takeValue(content, format, property.type));
}

void readElement(MeshContent& content, Format format, const ElementType& element, std::vector<double>& values) {
    Vector3 point = Vector3::Constant(kNaN);
    for (const Property& property : element.properties) {
        takeValues(content, format, property, values);
        if (element.name == "vertex" && !property.countType)
            for (int axis = 0; axis < 3; ++axis)
                if (property.name == std::string(1, "xyz"[axis])) point[axis] = values.front();
        if (element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index")) {
            std::vector<int> corners;
            for (const double value : values) corners.push_back(toIndex(value));
            content.addFace(corners);
        }
    }
    if (element.name == "vertex") content.addPoint(point);
}

}  // namespace

TriangleMesh readPly(std::string_view bytes, const std::string& fileName) {
    MeshContent content(bytes, fileName);
    const Header header = readHeader(content);
    std::vector<double> values;
    for (const ElementType& element : header.elements) {
        if (element.properties.empty()) continue;  // takes no room, however many there are said to be
        for (int i = 0; i < element.count; ++i) readElement(content, header.format, element, values);
    }
    return content.finish();
}

}  // namespace tautline::models
