// SPDX-License-Identifier: Apache-2.0
/** Readers of mesh files: one mesh in every kind and coding, and what is refused, with its place. */
#include "tautline/models/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <sstream>

#include "support/random.h"
#include "support/shared_data.h"
#include "support/triangle_meshes.h"
#include "tautline/models/model_error.h"

namespace tautline::models {
namespace {

constexpr unsigned kSeed = 20261127;

/** Coordinates that floats have exactly, so that every kind of file gives them back. */
TriangleMesh makeMesh() {
    TriangleMesh mesh = testing::makeBallMesh(1);
    for (Vector3& point : mesh.points) point = point.cast<float>().cast<double>();
    return mesh;
}

template <class Number>
void append(std::string& bytes, Number number, bool isBigEndian = false) {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, sizeof(Number));
    if (isBigEndian) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.begin(), raw.end());
}

std::string encodeBase64(const std::string& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string writeObj(const TriangleMesh& mesh, bool countsBack) {
    std::ostringstream text;
    text.precision(17);
    text << "# a ball\n";
    for (const Vector3& p : mesh.points) text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << "\r\nvn 0 0 1\n";
    const int back = static_cast<int>(mesh.points.size()) + 1;
    for (const auto& triangle : mesh.triangles) {
        text << 'f';
        for (const int corner : triangle) text << ' ' << (countsBack ? corner + 1 - back : corner + 1) << "//1";
        text << '\n';
    }
    return text.str();
}

std::string writeStl(const TriangleMesh& mesh, bool isBinary) {
    std::ostringstream text;
    text.precision(17);
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs begin binary files, too
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    text << "solid ball\n";
    for (int i = 0; i < mesh.countTriangles(); ++i) {
        text << "facet normal 0 0 0\nouter loop\n";
        bytes.append(12, '\0');
        for (int k = 0; k < 3; ++k) {
            const Vector3& p = mesh.getCorner(i, k);
            text << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
            for (const double x : p) append(bytes, static_cast<float>(x));
        }
        text << "endloop\nendfacet\n";
        bytes.append(2, '\0');
    }
    text << "endsolid ball\n";
    return isBinary ? bytes : text.str();
}

std::string writePly(const TriangleMesh& mesh, const std::string& format) {
    std::ostringstream text;
    text.precision(17);
    text << "ply\nformat " << format << " 1.0\ncomment a ball\nelement vertex " << mesh.points.size()
         << "\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\nelement face "
         << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    std::string bytes = text.str();
    const bool isBig = format == "binary_big_endian";
    for (const Vector3& p : mesh.points) {
        text << p.x() << " 255 " << p.y() << ' ' << p.z() << '\n';
        append(bytes, static_cast<float>(p.x()), isBig);
        bytes += '\xff';
        append(bytes, static_cast<float>(p.y()), isBig);
        append(bytes, static_cast<float>(p.z()), isBig);
    }
    for (const auto& triangle : mesh.triangles) {
        text << 3;
        bytes += '\3';
        for (const int corner : triangle) text << ' ' << corner, append(bytes, std::int32_t(corner), isBig);
        text << '\n';
    }
    return format == "ascii" ? text.str() : bytes;
}

enum class VtpCoding { Ascii, Inline, AppendedBase64, AppendedRaw };

std::string writeVtp(const TriangleMesh& mesh, VtpCoding coding, bool isBigEndian = false) {
    std::ostringstream ascii[3];
    std::string binary[3], appended;
    ascii[0].precision(17);
    for (const Vector3& p : mesh.points)
        for (const double x : p) ascii[0] << x << ' ', append(binary[0], static_cast<float>(x), isBigEndian);
    std::int64_t end = 0;
    for (const auto& triangle : mesh.triangles) {
        for (const int corner : triangle)
            ascii[1] << corner << ' ', append(binary[1], std::int32_t(corner), isBigEndian);
        ascii[2] << (end += 3) << '\n', append(binary[2], end, isBigEndian);
    }
    const auto writeArray = [&](int i, const std::string& attributes) {
        std::string bytes;
        append(bytes, static_cast<std::uint32_t>(binary[i].size()), isBigEndian);
        bytes += binary[i];
        const std::string head = "<DataArray " + attributes + " format=\"";
        if (coding == VtpCoding::Ascii) return head + "ascii\">" + ascii[i].str() + "</DataArray>\n";
        if (coding == VtpCoding::Inline) return head + "binary\">\n  " + encodeBase64(bytes) + "\n</DataArray>\n";
        const std::string offset = std::to_string(appended.size());
        appended += coding == VtpCoding::AppendedRaw ? bytes : encodeBase64(bytes);
        return head + "appended\" offset=\"" + offset + "\"/>\n";
    };
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"" +
                       std::string(isBigEndian ? "Big" : "Little") + "Endian\"><PolyData>\n<Piece NumberOfPoints=\"" +
                       std::to_string(mesh.points.size()) + "\"><Points>" +
                       writeArray(0, "type=\"Float32\" NumberOfComponents=\"3\"") + "</Points>\n<Polys>" +
                       writeArray(1, "type=\"Int32\" Name=\"connectivity\"") +
                       writeArray(2, "type=\"Int64\" Name=\"offsets\"") + "</Polys></Piece></PolyData>\n";
    if (coding >= VtpCoding::AppendedBase64)
        text += std::string("<AppendedData encoding=\"") + (coding == VtpCoding::AppendedRaw ? "raw" : "base64") +
                "\">\n_" + appended + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
}

/** One mesh in every kind of file: name and content. */
std::vector<std::pair<std::string, std::string>> writeAll(const TriangleMesh& mesh) {
    return {{"forward.obj", writeObj(mesh, false)},
            {"back.obj", writeObj(mesh, true)},
            {"ascii.stl", writeStl(mesh, false)},
            {"binary.STL", writeStl(mesh, true)},
            {"ascii.ply", writePly(mesh, "ascii")},
            {"little.ply", writePly(mesh, "binary_little_endian")},
            {"big.ply", writePly(mesh, "binary_big_endian")},
            {"ascii.vtp", writeVtp(mesh, VtpCoding::Ascii)},
            {"inline.vtp", writeVtp(mesh, VtpCoding::Inline)},
            {"appended.vtp", writeVtp(mesh, VtpCoding::AppendedBase64)},
            {"raw.vtp", writeVtp(mesh, VtpCoding::AppendedRaw)},
            {"big.vtp", writeVtp(mesh, VtpCoding::AppendedRaw, true)}};
}

TEST(MeshFile, EveryKindGivesTheSameTriangles) {
    const TriangleMesh mesh = makeMesh();
    for (const auto& [name, content] : writeAll(mesh)) {
        const TriangleMesh read = readMeshContent(content, name);
        ASSERT_EQ(read.triangles.size(), mesh.triangles.size()) << name;
        for (int i = 0; i < mesh.countTriangles(); ++i)
            for (int k = 0; k < 3; ++k) EXPECT_EQ(read.getCorner(i, k), mesh.getCorner(i, k)) << name;
    }
}

TEST(MeshFile, FacesOfManyCornersBecomeFans) {
    const TriangleMesh mesh = readMeshContent("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "square.obj");
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(MeshFile, RefusesWithThePlace) {
    const std::vector<std::array<std::string, 3>> cases{
        {"a.xyz", "", "a.xyz: meshes are read from .vtp, .obj, .stl and .ply files, not from '.xyz'"},
        {"a.obj", "", "a.obj: no faces"},
        {"a.obj", "v 1 2\n", "a.obj:1: '' is no coordinate of a point"},
        {"a.obj", "v 1 2 3\nv 1 x 3\n", "a.obj:2: 'x' is no coordinate of a point"},
        {"a.obj", "v 1 2 3\nf 1 2\n", "a.obj:2: a face needs three corners or more"},
        {"a.obj", "v 1 2 3\nf 1 1 0\n", "a.obj:2: '0' is no corner of a face"},
        {"a.obj", "v 1 2 3\nf 1 1 -2\n", "a.obj:2: corner -2 goes back beyond the first point"},
        {"a.obj", "v 1 2 3\nf 1 1 7\n",
         "a.obj: a face has a corner at point 6, counted from 0, but there are 1 points"},
        {"a.obj", "v 1 2 nan\nf 1 1 1\n", "a.obj: point 0 is not finite"},
        {"a.stl", "x", "a.stl: byte 0: neither 'solid' nor long enough to be binary"},
        {"a.stl", "solid\nvertex 1 2 3\nvertex 1 2 y\n", "a.stl:3: 'y' is no number"},
        {"a.stl", "solid\nvertex 1 2 3\nendfacet\n", "a.stl:3: a facet with 1 corners"},
        {"a.stl", "solid\nvertex 1 2", "a.stl:2: ends where a number should stand"},
        {"a.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(60, '\0'),
         "a.stl: byte 84: should have 2 triangles, but has room for 1"},
        {"a.ply", "plyx\n", "a.ply:1: does not begin with 'ply'"},
        {"a.ply", "ply\nformat text 1.0\n", "a.ply:2: unknown format 'text'"},
        {"a.ply", "ply\nelement vertex -1\n", "a.ply:2: '-1' is no number of elements"},
        {"a.ply", "ply\nproperty float x\n", "a.ply:2: a property before any element"},
        {"a.ply", "ply\nelement vertex 1\nproperty real x\n", "a.ply:3: unknown type 'real'"},
        {"a.ply", "ply\nelement vertex 1\n", "a.ply:2: ends within its header"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n",
         "a.ply:7: ends where a number should stand"},
        {"a.ply",
         "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int "
         "vertex_index\nend_header\n\xff\xff\xff"
         "\xff",
         "a.ply: byte 102: a list of more values than there are bytes"},
        {"a.vtp", "<VTKFile>", "a.vtp:1: not well-formed XML: Start-end tags mismatch"},
        {"a.vtp", "<VTKFile/>", "a.vtp:1: no VTKFile with PolyData"},
        {"a.vtp", "<VTKFile><PolyData>\n<Piece/></PolyData></VTKFile>", "a.vtp:2: a Piece without Points"},
        {"a.vtp",
         "<VTKFile><PolyData><Piece><Points>\n<DataArray>1 2 3 4</DataArray></Points></Piece></PolyData></VTKFile>",
         "a.vtp:2: 4 coordinates of points, not three for each"},
        {"a.vtp",
         "<VTKFile><PolyData><Piece><Points>\n<DataArray>1 2 c</DataArray></Points></Piece></PolyData></VTKFile>",
         "a.vtp:2: 'c', the number 3 of the array that begins here, is no number"},
        {"a.vtp",
         "<VTKFile compressor=\"vtkZLibDataCompressor\"><PolyData><Piece><Points>\n<DataArray "
         "format=\"binary\"/></Points></Piece></PolyData></VTKFile>",
         "a.vtp:2: compressed data are not read: save the file uncompressed, or in ASCII"},
        {"a.vtp",
         "<VTKFile><PolyData><Piece><Points>\n<DataArray format=\"appended\" "
         "offset=\"9\"/></Points></Piece></PolyData></VTKFile>",
         "a.vtp:2: its offset 9 is beyond the appended data"},
        {"a.vtp",
         "<VTKFile><PolyData><Piece><Points>\n<DataArray type=\"Float32\" "
         "format=\"binary\">/////w==</DataArray></Points></Piece></PolyData></VTKFile>",
         "a.vtp:2: its binary data should have more than the 0 bytes that there are"},
    };
    for (const auto& [name, content, message] : cases) {
        try {
            readMeshContent(content, name);
            ADD_FAILURE() << "not refused: " << message;
        } catch (const ModelError& error) {
            EXPECT_EQ(error.what(), message);
        }
    }
}

/** Whatever happens to a file, it is read or refused: nothing else is thrown, and nothing is read beyond its end. */
TEST(MeshFile, DamagedFilesAreReadOrRefused) {
    testing::Random random(kSeed);
    int numRefused = 0;
    for (const auto& [name, content] : writeAll(makeMesh())) {
        for (int i = 0; i < 300; ++i) {
            std::string damaged = content;
            const auto place = [&] {
                return static_cast<std::size_t>(random.integer(0, static_cast<int>(damaged.size()) - 1));
            };
            if (i % 3 == 0)
                damaged.resize(place());
            else
                for (int k = 0; k < i % 7; ++k) damaged[place()] = static_cast<char>(random.integer(0, 255));
            try {
                requireMesh(readMeshContent(damaged, name));
            } catch (const ModelError&) {
                ++numRefused;
            }
        }
    }
    EXPECT_GT(numRefused, 500);
}

TEST(DataMeshFile, AllBonesOfTheReferenceDataAreRead) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared / "data/opensim/geometry")) {
        const TriangleMesh mesh = readMeshFile(entry.path());
        const Vector3 sides = calcBox(mesh).sizes();
        EXPECT_GT(mesh.triangles.size(), 200u) << entry.path();
        EXPECT_GT(sides.minCoeff(), 0.03) << entry.path();
        EXPECT_LT(sides.maxCoeff(), 0.6) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 9);
}

}  // namespace
}  // namespace tautline::models
