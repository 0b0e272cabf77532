// SPDX-License-Identifier: Apache-2.0
#include "mesh_content.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "tautline/models/model_error.h"

namespace tautline::models {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";

template <class Number>
bool convert(std::string_view word, Number& number) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size();
}

template <class Number>
double decodeAs(const char* bytes, bool isBigEndian) {
    std::array<char, sizeof(Number)> ordered;
    std::copy(bytes, bytes + sizeof(Number), ordered.begin());
    const std::uint16_t one = 1;
    const bool isThisBigEndian = *reinterpret_cast<const unsigned char*>(&one) == 0;
    if (isBigEndian != isThisBigEndian) std::reverse(ordered.begin(), ordered.end());
    Number number;
    std::memcpy(&number, ordered.data(), sizeof(Number));
    return static_cast<double>(number);
}

}  // namespace

std::string_view MeshContent::takeLine() {
    m_wordAt = m_at;
    const std::size_t end = std::min(m_bytes.find('\n', m_at), m_bytes.size());
    std::string_view line = m_bytes.substr(m_at, end - m_at);
    m_at = std::min(end + 1, m_bytes.size());
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

std::string_view MeshContent::takeWord() {
    std::string_view rest = m_bytes.substr(std::min(m_at, m_bytes.size()));
    const std::string_view word = takeWordOf(rest);
    m_at = m_bytes.size() - rest.size();
    m_wordAt = m_at - word.size();
    return word;
}

double MeshContent::takeNumber() {
    const std::string_view word = takeWord();
    double number;
    if (word.empty()) failAtLine("ends where a number should stand");
    if (!toNumber(word, number)) failAtLine("'" + std::string(word) + "' is no number");
    return number;
}

int MeshContent::takeInteger() {
    const std::string_view word = takeWord();
    int number;
    if (word.empty()) failAtLine("ends where a whole number should stand");
    if (!toInteger(word, number)) failAtLine("'" + std::string(word) + "' is no whole number");
    return number;
}

void MeshContent::failAtLine(const std::string& what) const {
    const auto at = static_cast<std::ptrdiff_t>(std::min(m_wordAt, m_bytes.size()));
    const auto ends = std::count(m_bytes.begin(), m_bytes.begin() + at, '\n');
    throw ModelError(m_fileName, 1 + static_cast<int>(ends), what);
}

void MeshContent::failAtByte(const std::string& what) const {
    throw ModelError(m_fileName + ": byte " + std::to_string(m_at) + ": " + what);
}

void MeshContent::addFace(const std::vector<int>& corners) {
    for (std::size_t k = 2; k < corners.size(); ++k)
        m_mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

TriangleMesh MeshContent::finish() {
    const auto fail = [this](const std::string& what) { throw ModelError(m_fileName + ": " + what); };
    if (m_mesh.triangles.empty()) fail("no faces");
    for (std::size_t i = 0; i < m_mesh.points.size(); ++i)
        if (!m_mesh.points[i].allFinite()) fail("point " + std::to_string(i) + " is not finite");
    const int count = static_cast<int>(m_mesh.points.size());
    for (const auto& triangle : m_mesh.triangles)
        for (const int corner : triangle)
            if (corner < 0 || corner >= count)
                fail("a face has a corner at point " + std::to_string(corner) + ", counted from 0, but there are " +
                     std::to_string(count) + " points");
    return std::move(m_mesh);
}

std::string_view takeWordOf(std::string_view& line) {
    const std::size_t begin = std::min(line.find_first_not_of(kSpace), line.size());
    const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

bool toNumber(std::string_view word, double& number) {
    return convert(word, number);
}
bool toInteger(std::string_view word, int& number) {
    return convert(word, number);
}

std::size_t getNumberSize(NumberType type) {
    constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

double decodeNumber(const char* bytes, NumberType type, bool isBigEndian) {
    switch (type) {
        case NumberType::Int8:
            return decodeAs<std::int8_t>(bytes, isBigEndian);
        case NumberType::UInt8:
            return decodeAs<std::uint8_t>(bytes, isBigEndian);
        case NumberType::Int16:
            return decodeAs<std::int16_t>(bytes, isBigEndian);
        case NumberType::UInt16:
            return decodeAs<std::uint16_t>(bytes, isBigEndian);
        case NumberType::Int32:
            return decodeAs<std::int32_t>(bytes, isBigEndian);
        case NumberType::UInt32:
            return decodeAs<std::uint32_t>(bytes, isBigEndian);
        case NumberType::Int64:
            return decodeAs<std::int64_t>(bytes, isBigEndian);
        case NumberType::UInt64:
            return decodeAs<std::uint64_t>(bytes, isBigEndian);
        case NumberType::Float32:
            return decodeAs<float>(bytes, isBigEndian);
        default:
            return decodeAs<double>(bytes, isBigEndian);
    }
}

int toIndex(double number) {
    return number >= 0 && number < 2147483647.0 ? static_cast<int>(number) : -1;
}

}  // namespace tautline::models
