// SPDX-License-Identifier: Apache-2.0
/** Stereolithography's .stl files. */
#include "mesh_content.h"

namespace tautline::models {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;  ///< bytes of a binary file; normal, corners and two bytes more

void addTriangle(MeshContent& content) {
    const int last = static_cast<int>(content.countPoints());
    content.addFace({last - 3, last - 2, last - 1});
}

TriangleMesh readAscii(MeshContent& content) {
    int corners = 0;
    for (std::string_view word = content.takeWord(); !word.empty(); word = content.takeWord()) {
        if (word == "vertex") {
            Vector3 point;
            for (double& coordinate : point) coordinate = content.takeNumber();
            content.addPoint(point);
            ++corners;
        } else if (word == "endfacet") {
            if (corners != 3) content.failAtLine("a facet with " + std::to_string(corners) + " corners");
            addTriangle(content);
            corners = 0;
        }
    }
    if (corners > 0) content.failAtLine("ends within a facet");
    return content.finish();
}

TriangleMesh readBinary(MeshContent& content) {
    const auto take = [&content](NumberType type) {
        const std::size_t at = content.getPlace();
        content.setPlace(at + getNumberSize(type));
        return decodeNumber(content.getBytes().data() + at, type, false);
    };
    content.setPlace(kHeader);
    const auto count = static_cast<std::size_t>(take(NumberType::UInt32));
    if (count > content.countLeft() / kTriangle)
        content.failAtByte("should have " + std::to_string(count) + " triangles, but has room for " +
                           std::to_string(content.countLeft() / kTriangle));
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = content.getPlace();
        content.setPlace(begin + 3 * sizeof(float));  // behind the normal
        for (int corner = 0; corner < 3; ++corner) {
            Vector3 point;
            for (double& coordinate : point) coordinate = take(NumberType::Float32);
            content.addPoint(point);
        }
        addTriangle(content);
        content.setPlace(begin + kTriangle);
    }
    return content.finish();
}

}  // namespace

/** Both may begin with "solid": a binary file is as long as its number of triangles says. */
TriangleMesh readStl(std::string_view bytes, const std::string& fileName) {
    MeshContent content(bytes, fileName);
    if (bytes.size() >= kHeader + 4) {
        const double count = decodeNumber(bytes.data() + kHeader, NumberType::UInt32, false);
        const bool beginsAsText = bytes.substr(0, 5) == "solid";
        if (!beginsAsText || count * kTriangle + kHeader + 4 == static_cast<double>(bytes.size()))
            return readBinary(content);
    }
    if (bytes.substr(0, 5) != "solid") content.failAtByte("neither 'solid' nor long enough to be binary");
    return readAscii(content);
}

}  // namespace tautline::models
