// SPDX-License-Identifier: Apache-2.0
/** Wavefront's .obj files. */
#include "mesh_content.h"

namespace tautline::models {
namespace {

Vector3 readPoint(MeshContent& content, std::string_view line) {
    Vector3 point;
    for (double& coordinate : point) {
        const std::string_view word = takeWordOf(line);
        if (!toNumber(word, coordinate)) content.failAtLine("'" + std::string(word) + "' is no coordinate of a point");
    }
    return point;
}

/** Corners are i, i/texture, i//normal or i/texture/normal, counted from 1, or from the last point on if negative. */
std::vector<int> readCorners(MeshContent& content, std::string_view line) {
    std::vector<int> corners;
    for (std::string_view word = takeWordOf(line); !word.empty(); word = takeWordOf(line)) {
        int index;
        if (!toInteger(word.substr(0, word.find('/')), index) || index == 0)
            content.failAtLine("'" + std::string(word) + "' is no corner of a face");
        const int last = static_cast<int>(content.countPoints());
        if (index < -last) content.failAtLine("corner " + std::string(word) + " goes back beyond the first point");
        corners.push_back(index > 0 ? index - 1 : last + index);
    }
    if (corners.size() < 3) content.failAtLine("a face needs three corners or more");
    return corners;
}

}  // namespace

TriangleMesh readObj(std::string_view bytes, const std::string& fileName) {
    MeshContent content(bytes, fileName);
    while (!content.isAtEnd()) {
        std::string_view line = content.takeLine();
        const std::string_view what = takeWordOf(line);
        if (what == "v") content.addPoint(readPoint(content, line));
        if (what == "f") content.addFace(readCorners(content, line));
    }
    return content.finish();
}

}  // namespace tautline::models
