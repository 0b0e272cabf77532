// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What the readers of meshes share: text by words, binary numbers of either byte order, faces with any number of
corners. */
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tautline/meshes/triangle_mesh.h"

namespace tautline::models {

/** A mesh that grows, with the place in its file for messages. */
class MeshContent {
public:
    MeshContent(std::string_view bytes, const std::string& fileName) : m_bytes(bytes), m_fileName(fileName) {}

    std::string_view getBytes() const { return m_bytes; }
    std::size_t getPlace() const { return m_at; }
    void setPlace(std::size_t at) { m_at = at; }
    bool isAtEnd() const { return m_at >= m_bytes.size(); }
    std::size_t countLeft() const { return m_bytes.size() - m_at; }

    /** The next line without its end; the place is then that of the line after it. */
    std::string_view takeLine();
    /** The next word, over the ends of lines; empty at the end. */
    std::string_view takeWord();
    double takeNumber();
    int takeInteger();

    [[noreturn]] void failAtLine(const std::string& what) const;
    [[noreturn]] void failAtByte(const std::string& what) const;

    void addPoint(const Vector3& point) { m_mesh.points.push_back(point); }
    std::size_t countPoints() const { return m_mesh.points.size(); }
    /** @param corners   numbers of points, which need not be there yet; fewer than three are no face */
    void addFace(const std::vector<int>& corners);

    /** Once all is read. @throws ModelError for a mesh without faces, a corner without a point, a point that is not
    finite */
    TriangleMesh finish();

private:
    std::string_view m_bytes;
    const std::string& m_fileName;
    std::size_t m_at = 0;
    std::size_t m_wordAt = 0;  ///< where the last word or line began
    TriangleMesh m_mesh;
};

/** The next word of a line, without it afterwards; empty if there is none. */
std::string_view takeWordOf(std::string_view& line);

/** @return false if the word is no number of this kind as a whole */
bool toNumber(std::string_view word, double& number);
bool toInteger(std::string_view word, int& number);

/** Types of binary numbers. */
enum class NumberType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };
std::size_t getNumberSize(NumberType type);
/** A number out of as many bytes as its type has. */
double decodeNumber(const char* bytes, NumberType type, bool isBigEndian);
/** A value as a number of a point or corner: -1 if it is none. */
int toIndex(double number);

/** Readers of single kinds of file; see mesh_file.h. */
TriangleMesh readVtp(std::string_view bytes, const std::string& fileName);
TriangleMesh readObj(std::string_view bytes, const std::string& fileName);
TriangleMesh readStl(std::string_view bytes, const std::string& fileName);
TriangleMesh readPly(std::string_view bytes, const std::string& fileName);

}  // namespace tautline::models
