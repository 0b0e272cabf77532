// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "mesh_content.h"
#include "read_text.h"
#include "tautline/models/model_error.h"

namespace tautline::models {

TriangleMesh readMeshContent(std::string_view content, const std::string& fileName) {
    using Reader = TriangleMesh (*)(std::string_view, const std::string&);
    static const std::map<std::string, Reader> kReaders{
        {".vtp", readVtp}, {".obj", readObj}, {".stl", readStl}, {".ply", readPly}};
    std::string ending = std::filesystem::path(fileName).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto reader = kReaders.find(ending);
    if (reader == kReaders.end())
        throw ModelError(fileName + ": meshes are read from .vtp, .obj, .stl and .ply files, not from '" + ending +
                         "'");
    return reader->second(content, fileName);
}

TriangleMesh readMeshFile(const std::filesystem::path& file) {
    return readMeshContent(readText(file), file.string());
}

}  // namespace tautline::models
