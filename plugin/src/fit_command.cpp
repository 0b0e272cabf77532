// SPDX-License-Identifier: Apache-2.0
#include "fit_command.h"

#include <sstream>
#include <vector>

#include "tautline/error.h"
#include "tautline/models/mesh_file.h"
#include "tautline/surfaces/solid_file.h"
#include "tautline/surfaces/solid_fit.h"

namespace tautline {
namespace {

/** Lengths in millimeters with three digits. */
std::string inMillimeters(double length) {
    std::ostringstream text;
    text.precision(3);
    text << 1000 * length << " mm";
    return text.str();
}

std::string inMillimeters(const Vec3& lengths) {
    std::ostringstream text;
    text.precision(4);
    text << 1000 * lengths.x() << " x " << 1000 * lengths.y() << " x " << 1000 * lengths.z() << " mm";
    return text.str();
}

TriangleMesh readScaled(const std::filesystem::path& file, double unit) {
    require(unit > 0 && unit <= 1e6, "the unit of a mesh must be positive, but is ", unit);
    TriangleMesh mesh = models::readMeshFile(file);
    for (Vec3& point : mesh.points) point *= unit;
    return mesh;
}

/** What was put in order, each with its number, as far as there was anything. */
std::string describeRepairs(const RepairedMesh& repaired) {
    std::vector<std::string> repairs;
    const auto add = [&](int count, const std::string& what) {
        if (count > 0) repairs.push_back(std::to_string(count) + " " + what);
    };
    add(repaired.closedHoles, "holes closed (the widest " + inMillimeters(repaired.widestHole) + ")");
    add(repaired.turnedTriangles, "triangles turned outward");
    add(repaired.doubleTriangles, "double triangles dropped");
    add(repaired.emptyTriangles, "triangles without area dropped");
    add(repaired.edgesOfManyFaces, "edges of three faces or more left");
    std::string text;
    for (const std::string& repair : repairs) text += (text.empty() ? "" : ", ") + repair;
    return text.empty() ? "nothing" : text;
}

void printFit(const SolidFit& fit, std::ostream& out) {
    const SolidGrid& grid = fit.solid.getGrid();
    const Vec3& worst = fit.points[static_cast<std::size_t>(fit.report.worst)];
    out << "put in order: " << describeRepairs(fit.repaired) << "; " << fit.repaired.parts << " parts\n"
        << "smoothed: width " << inMillimeters(grid.width) << ", grid " << inMillimeters(grid.spacing) << "\n"
        << "off the mesh: " << inMillimeters(fit.report.rms) << " rms, " << inMillimeters(fit.report.largest)
        << " at most, at " << worst.x() << " " << worst.y() << " " << worst.z() << "\n";
}

/** What a model needs to say; the file is named as it is seen from beside it. */
void printElement(const std::filesystem::path& file, std::ostream& out) {
    out << "\n<TautlineWrapMesh name=\"" << file.stem().string() << "\">\n"
        << "    <solid_file>" << file.filename().string() << "</solid_file>\n"
        << "</TautlineWrapMesh>\n";
}

}  // namespace

void FitCommand::declare(CLI::App& app) {
    app.option_defaults()->take_last();
    app.add_option("MESH", meshFile, "mesh file (.vtp, .obj, .stl, .ply)")->required();
    app.add_flag("--bone", isBone, "fit a solid: all of the mesh, smoothed")->required();
    app.add_option("--width", width, "of the smoothing in m: its standard deviation (default: from the mesh)");
    app.add_option("--grid", spacing, "width of the grid's cells in m (default: 1.5 widths)");
    app.add_option("--unit", unit, "of the mesh file in m, such as 0.001")->capture_default_str();
    app.add_option("--out", outFile, "file of the solid, for <solid_file> in models")->required();
}

int FitCommand::run(std::ostream& out) const {
    const TriangleMesh mesh = readScaled(meshFile, unit);
    out << "mesh: " << meshFile.string() << ": " << mesh.points.size() << " points, " << mesh.triangles.size()
        << " triangles, " << inMillimeters(calcBox(mesh).sizes()) << "\n";
    const SolidFit fit = fitSolid(mesh, {width, spacing});
    printFit(fit, out);
    if (outFile.has_parent_path()) std::filesystem::create_directories(outFile.parent_path());
    writeSolidFile(fit.solid, outFile);
    out << "written: " << outFile.string() << ", " << std::filesystem::file_size(outFile) / 1024 << " kB\n";
    printElement(outFile, out);
    return 0;
}

}  // namespace tautline
