// SPDX-License-Identifier: Apache-2.0
#include "fit_command.h"

#include <optional>
#include <sstream>

#include "fit_page.h"
#include "patch_region.h"
#include "storage_file.h"
#include "tautline/error.h"
#include "tautline/meshes/close_gaps.h"
#include "tautline/meshes/mesh_repair.h"
#include "tautline/models/mesh_file.h"
#include "tautline/surfaces/patch_fit.h"
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

std::string inMillimeters(const Vector3& lengths) {
    std::ostringstream text;
    text.precision(4);
    text << 1000 * lengths.x() << " x " << 1000 * lengths.y() << " x " << 1000 * lengths.z() << " mm";
    return text.str();
}

TriangleMesh readScaled(const std::filesystem::path& file, double unit) {
    require(unit > 0 && unit <= 1e6, "the unit of a mesh must be positive, but is ", unit);
    TriangleMesh mesh = models::readMeshFile(file);
    for (Vector3& point : mesh.points) point *= unit;
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
    const Vector3& worst = fit.points[static_cast<std::size_t>(fit.report.worst)];
    out << "put in order: " << describeRepairs(fit.repaired) << "; " << fit.repaired.parts
        << (fit.repaired.parts == 1 ? " part\n" : " parts\n") << "smoothed: width " << inMillimeters(grid.width)
        << ", grid " << inMillimeters(grid.spacing) << "\n"
        << "off the mesh: " << inMillimeters(fit.report.rms) << " rms, " << inMillimeters(fit.report.largest)
        << " at most, at " << worst.x() << " " << worst.y() << " " << worst.z() << "\n";
}

/** What a model needs to say; the file is named as it is seen from beside it. */
void printMeshElement(const std::filesystem::path& file, std::ostream& out) {
    out << "\n<TautlineWrapMesh name=\"" << file.stem().string() << "\">\n"
        << "    <solid_file>" << file.filename().string() << "</solid_file>\n"
        << "</TautlineWrapMesh>\n";
}

/** All digits that a reader needs to give back the same number. */
template <class Numbers>
std::string listNumbers(const Numbers& numbers) {
    std::ostringstream text;
    text.precision(17);
    for (Eigen::Index i = 0; i < numbers.size(); ++i) text << (i > 0 ? " " : "") << numbers[i];
    return text.str();
}

/** @param heights   z of the coefficients or control points */
void printPatchElement(const std::string& name, const Pose& X_MP, const ParameterDomain& domain,
                       const std::string& kind, const Eigen::RowVectorXd& heights, std::ostream& out) {
    const Vector3 angles = X_MP.R.eulerAngles(0, 1, 2);
    out << "\n<TautlineWrapPatch name=\"" << name << "\">\n"
        << "    <translation>" << listNumbers(X_MP.p) << "</translation>\n"
        << "    <xyz_body_rotation>" << listNumbers(angles) << "</xyz_body_rotation>\n"
        << "    <domain>" << listNumbers(Vector4(domain.min[0], domain.max[0], domain.min[1], domain.max[1]))
        << "</domain>\n"
        << "    " << kind << "\n"
        << "    <heights>" << listNumbers(heights) << "</heights>\n"
        << "</TautlineWrapPatch>\n";
}

void printPatchFit(const PatchRegion& region, const std::vector<int>& kept, const FitReport& report,
                   std::ostream& out) {
    const int worst = kept[static_cast<std::size_t>(report.worst)];
    const Vector3 place = region.X_MP * region.points_P[static_cast<std::size_t>(worst)];
    out << "fitted to: " << kept.size() << " points with " << report.numUnknowns << " unknowns; " << report.leftOut
        << " outliers left out\n"
        << "off the points: " << inMillimeters(report.rms) << " rms, " << inMillimeters(report.largest)
        << " at most, at " << place.x() << " " << place.y() << " " << place.z() << "\n";
}

/** "8x6": numbers of control points; "5": an order, twice. @return whether they are of control points */
bool readPatchKind(const std::string& kind, int& numU, int& numV) {
    const std::size_t cross = kind.find('x');
    const auto toNumber = [&](const std::string& word) {
        require(!word.empty() && word.size() < 4 && word.find_first_not_of("0123456789") == std::string::npos,
                "--patch is an order such as 5, or numbers of control points such as 8x6, but is '", kind, "'");
        return std::stoi(word);
    };
    numU = toNumber(kind.substr(0, cross));
    numV = cross == std::string::npos ? numU : toNumber(kind.substr(cross + 1));
    return cross != std::string::npos;
}

}  // namespace

void FitCommand::declare(CLI::App& app) {
    app.option_defaults()->take_last();
    app.add_option("MESH", meshFile, "mesh file (.vtp, .obj, .stl, .ply)")->required();
    CLI::Option* bone = app.add_flag("--bone", isBone, "fit a solid: all of the mesh, smoothed");
    CLI::Option* sheet = app.add_option(
        "--patch", patch, "fit a sheet of heights: a polynomial of this order, or bicubic B-splines, such as 8x6");
    bone->excludes(sheet);
    app.add_option("--width", width, "of the smoothing in m: its standard deviation (default: from the mesh)");
    app.add_option("--grid", spacing, "width of the grid's cells in m (default: 1.5 widths)");
    CLI::Option* close =
        app.add_option("--close", gap, "first close gaps narrower than this in m, as between the ribs of a chest");
    close->excludes(sheet);
    app.add_option("--toward", toward, "X Y Z: the direction that the patch faces (default: across the mesh)")
        ->expected(3);
    app.add_option("--box", box, "X0 X1 Y0 Y1 Z0 Z1 in m: only what lies between them is fitted by the patch")
        ->expected(6);
    app.add_option("--unit", unit, "of the mesh file in m, such as 0.001")->capture_default_str();
    CLI::Option* page = app.add_option("--report", report, "write a page (.html) to look at how far the mesh is off");
    page->excludes(sheet);
    app.add_option("--out", outFile, "file of the solid, for <solid_file> in models");
}

int FitCommand::run(std::ostream& out) const {
    require(isBone != !patch.empty(), "fit: --bone or --patch KIND says what to fit");
    require(!isBone || !outFile.empty(), "fit: --bone needs --out FILE for the solid");
    const TriangleMesh mesh = readScaled(meshFile, unit);
    out << "mesh: " << meshFile.string() << ": " << mesh.points.size() << " points, " << mesh.triangles.size()
        << " triangles, " << inMillimeters(calcBox(mesh).sizes()) << "\n";
    if (isBone)
        fitBone(mesh, out);
    else
        fitPatch(mesh, out);
    return 0;
}

void FitCommand::fitBone(const TriangleMesh& mesh, std::ostream& out) const {
    if (!report.empty()) requireReportAssets();
    require(gap >= 0, "--close is the width of gaps in m, but is ", gap);
    const SolidFit fit = fitSolid(gap > 0 ? closeGaps(mesh, gap) : mesh, {width, spacing});
    if (gap > 0) out << "gaps closed: narrower than " << inMillimeters(gap) << "\n";
    printFit(fit, out);
    if (outFile.has_parent_path()) std::filesystem::create_directories(outFile.parent_path());
    writeSolidFile(fit.solid, outFile);
    out << "written: " << outFile.string() << ", " << std::filesystem::file_size(outFile) / 1024 << " kB\n";
    if (!report.empty()) writeFitPage(fit, out);
    printMeshElement(outFile, out);
}

void FitCommand::writeFitPage(const SolidFit& fit, std::ostream& out) const {
    if (report.has_parent_path()) std::filesystem::create_directories(report.parent_path());
    writeWhole(writePage(makeFitPage(meshFile.filename().string(), fit)), report);
    out << "page: " << report.string() << "\n";
}

void FitCommand::fitPatch(const TriangleMesh& mesh, std::ostream& out) const {
    int numU, numV;
    const bool isSpline = readPatchKind(patch, numU, numV);
    std::optional<Vector3> direction;
    if (!toward.empty()) direction = Vector3(toward[0], toward[1], toward[2]);
    Eigen::AlignedBox3d region;
    if (!box.empty()) region = {Vector3(box[0], box[2], box[4]), Vector3(box[1], box[3], box[5])};
    // In order, so that triangles face outward.
    const PatchRegion part = findPatchRegion(repairMesh(mesh).mesh, direction, region);
    const std::string name = meshFile.stem().string(), counts = std::to_string(numU) + " " + std::to_string(numV);
    std::vector<int> kept;
    if (isSpline) {
        const BSplineFit fit = fitBSplineHeightsRobustly(part.points_P, numU, numV, &kept);
        printPatchFit(part, kept, fit.report, out);
        printPatchElement(name, part.X_MP, fit.patch.getDomain(), "<control_points>" + counts + "</control_points>",
                          fit.patch.getControlPoints().row(2), out);
    } else {
        const PolynomialFit fit =
            fitPolynomialHeightsRobustly(part.points_P, numU, numV, PolynomialTerms::TotalDegree, &kept);
        printPatchFit(part, kept, fit.report, out);
        printPatchElement(name, part.X_MP, fit.patch.getDomain(), "<orders>" + counts + "</orders>",
                          fit.patch.getCoefficients().row(2), out);
    }
}

}  // namespace tautline
