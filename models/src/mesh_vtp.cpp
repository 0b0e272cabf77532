// SPDX-License-Identifier: Apache-2.0
/** VTK's .vtp files: PolyData in XML. */
#include <map>

#include "mesh_content.h"
#include "tautline/models/model_error.h"
#include "xml_source.h"

namespace tautline::models {
namespace {

/** Value of a character of base64; -1 for any other. */
int decodeDigit(char c) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t at = kDigits.find(c);
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/** Up to padding or any other character, white space aside. */
std::string decodeBase64(std::string_view text) {
    std::string bytes;
    unsigned bits = 0;
    int numBits = 0;
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
        const int digit = decodeDigit(c);
        if (digit < 0) break;
        bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
        numBits += 6;
        if (numBits < 8) continue;
        numBits -= 8;
        bytes += static_cast<char>(bits >> numBits & 0xff);
    }
    return bytes;
}

/** The XML, and what is appended to it as raw bytes, which no XML reader takes. */
struct Parts {
    std::string xml;
    std::string_view appended;  ///< behind the underscore that begins it
};

Parts separate(std::string_view bytes) {
    const std::size_t tag = bytes.find("<AppendedData");
    if (tag == std::string_view::npos) return {std::string(bytes), {}};
    const std::size_t end = bytes.find('>', tag);
    const std::size_t begin = end == std::string_view::npos ? end : bytes.find('_', end);
    const std::size_t close = bytes.rfind("</AppendedData>");
    if (begin == std::string_view::npos || close == std::string_view::npos || close < begin)
        return {std::string(bytes), {}};
    return {std::string(bytes.substr(0, begin)) + std::string(bytes.substr(close)),
            bytes.substr(begin + 1, close - begin - 1)};
}

class VtpReader {
public:
    VtpReader(const Parts& parts, const std::string& fileName)
        : m_source(parts.xml, fileName), m_appended(parts.appended), m_content({}, fileName) {
        const pugi::xml_node root = m_source.getRoot();
        if (root.name() != std::string("VTKFile") || !root.child("PolyData"))
            m_source.fail(m_source.findLine(root), "no VTKFile with PolyData");
        m_isBigEndian = root.attribute("byte_order").value() == std::string("BigEndian");
        m_headerType =
            root.attribute("header_type").value() == std::string("UInt64") ? NumberType::UInt64 : NumberType::UInt32;
        m_isCompressed = bool(root.attribute("compressor"));
        m_appendedIsBase64 = root.child("AppendedData").attribute("encoding").value() == std::string("base64");
    }

    TriangleMesh read() {
        for (const pugi::xml_node piece : m_source.getRoot().child("PolyData").children("Piece")) readPiece(piece);
        return m_content.finish();
    }

private:
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const {
        m_source.fail(m_source.findLine(node), what);
    }

    void readPiece(pugi::xml_node piece) {
        const int first = static_cast<int>(m_content.countPoints());
        const pugi::xml_node pointsNode = piece.child("Points").child("DataArray");
        if (!pointsNode) fail(piece, "a Piece without Points");
        const std::vector<double> points = readArray(pointsNode);
        if (points.size() % 3 != 0)
            fail(pointsNode, std::to_string(points.size()) + " coordinates of points, not three for each");
        for (std::size_t i = 0; i < points.size(); i += 3)
            m_content.addPoint({points[i], points[i + 1], points[i + 2]});
        const pugi::xml_node polys = piece.child("Polys");
        const pugi::xml_node corners = polys.find_child_by_attribute("DataArray", "Name", "connectivity");
        const pugi::xml_node ends = polys.find_child_by_attribute("DataArray", "Name", "offsets");
        if (!corners || !ends) return;  // no polygons
        addFaces(ends, readArray(corners), readArray(ends), first);
    }

    void addFaces(pugi::xml_node node, const std::vector<double>& corners, const std::vector<double>& ends, int first) {
        const int numPoints = static_cast<int>(m_content.countPoints());
        std::size_t begin = 0;
        for (const double number : ends) {
            const int end = toIndex(number);
            if (end < 0 || static_cast<std::size_t>(end) < begin || static_cast<std::size_t>(end) > corners.size())
                fail(node, "offsets of polygons must rise up to " + std::to_string(corners.size()));
            std::vector<int> face;
            for (; begin < static_cast<std::size_t>(end); ++begin) {
                const int corner = toIndex(corners[begin]);
                face.push_back(corner < 0 || corner >= numPoints - first ? -1 : first + corner);
            }
            m_content.addFace(face);
        }
    }

    std::vector<double> readArray(pugi::xml_node node) const {
        const std::string format = node.attribute("format").value();
        if (format.empty() || format == "ascii") return readAscii(node);
        if (m_isCompressed) fail(node, "compressed data are not read: save the file uncompressed, or in ASCII");
        if (format == "binary") return decode(node, decodeBase64(node.child_value()));
        if (format != "appended") fail(node, "unknown format '" + format + "'");
        const std::size_t offset = node.attribute("offset").as_uint();
        if (offset > m_appended.size())
            fail(node, "its offset " + std::to_string(offset) + " is beyond the appended data");
        const std::string_view rest = m_appended.substr(offset);
        return decode(node, m_appendedIsBase64 ? decodeBase64(rest) : std::string(rest));
    }

    std::vector<double> readAscii(pugi::xml_node node) const {
        std::vector<double> numbers;
        std::string_view text = node.child_value();
        for (std::string_view word = takeWordOf(text); !word.empty(); word = takeWordOf(text)) {
            double number;
            if (!toNumber(word, number)) {
                fail(node, "'" + std::string(word) + "', the number " + std::to_string(numbers.size() + 1) +
                               " of the array that begins here, is no number");
            }
            numbers.push_back(number);
        }
        return numbers;
    }

    /** A header with the length in bytes, then the numbers. */
    std::vector<double> decode(pugi::xml_node node, const std::string& bytes) const {
        static const std::map<std::string, NumberType> kTypes{
            {"Int8", NumberType::Int8},      {"UInt8", NumberType::UInt8},   {"Int16", NumberType::Int16},
            {"UInt16", NumberType::UInt16},  {"Int32", NumberType::Int32},   {"UInt32", NumberType::UInt32},
            {"Int64", NumberType::Int64},    {"UInt64", NumberType::UInt64}, {"Float32", NumberType::Float32},
            {"Float64", NumberType::Float64}};
        const auto type = kTypes.find(node.attribute("type").value());
        if (type == kTypes.end()) fail(node, "unknown type '" + std::string(node.attribute("type").value()) + "'");
        const std::size_t header = getNumberSize(m_headerType), size = getNumberSize(type->second);
        if (bytes.size() < header) fail(node, "its binary data end within their header");
        const double length = decodeNumber(bytes.data(), m_headerType, m_isBigEndian);
        if (!(length <= static_cast<double>(bytes.size() - header)))
            fail(node, "its binary data should have more than the " + std::to_string(bytes.size() - header) +
                           " bytes that there are");
        std::vector<double> numbers;
        for (std::size_t at = header; at + size <= header + static_cast<std::size_t>(length); at += size)
            numbers.push_back(decodeNumber(bytes.data() + at, type->second, m_isBigEndian));
        return numbers;
    }

    XmlSource m_source;
    std::string_view m_appended;
    MeshContent m_content;
    NumberType m_headerType;
    bool m_isBigEndian, m_isCompressed, m_appendedIsBase64;
};

}  // namespace

TriangleMesh readVtp(std::string_view bytes, const std::string& fileName) {
    return VtpReader(separate(bytes), fileName).read();
}

}  // namespace tautline::models
