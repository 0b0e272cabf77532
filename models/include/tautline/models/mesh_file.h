// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Triangle meshes from the files that scanners and OpenSim use. */
#include <filesystem>
#include <string>
#include <string_view>

#include "tautline/meshes/triangle_mesh.h"

namespace tautline::models {

/** Reads the faces of a mesh; those of more than three corners become fans of triangles. By the ending of its name:

- .vtp: VTK's PolyData in XML: ASCII, binary inline (base64) or appended (base64 or raw), not compressed; its polygons
- .obj: Wavefront: `v` and `f`, with indices of either sign
- .stl: ASCII or binary; each triangle has points of its own
- .ply: ASCII or binary, of either byte order: `vertex` and `face`

Everything else in them, such as normals and colors, is passed over.
@throws ModelError with the file and the line, in binary parts the byte, of what cannot be read: another ending, a file
that is cut off or no such file, a number that is none, a corner without a point, a mesh without faces */
TriangleMesh readMeshFile(const std::filesystem::path& file);

/** The same from the content. @param fileName   for its ending and for messages */
TriangleMesh readMeshContent(std::string_view content, const std::string& fileName);

}  // namespace tautline::models
