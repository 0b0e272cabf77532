// SPDX-License-Identifier: Apache-2.0
#include "fit_page.h"

#include <algorithm>
#include <cmath>

#include "text_table.h"

namespace tautline {
namespace {

constexpr double kMillimeters = 1e3;
constexpr double kScaleOfRms = 3;  ///< the end of the scale of colors: beyond it are few
constexpr double kNeedle = 0.15;   ///< its length over the diagonal of the mesh

/** How far each point of the mesh stands out of the solid, negative: is below its surface [mm]. */
std::vector<double> calcHeights(const SolidFit& fit) {
    std::vector<double> heights;
    for (const Vector3& p : fit.repaired.mesh.points) {
        const double distance = (fit.solid.findSurfacePoint(p).p - p).norm();
        heights.push_back(kMillimeters * std::copysign(distance, fit.solid.calcHeight(p)));
    }
    return heights;
}

/** The residual below which a part of all lies. */
double findQuantile(std::vector<double> residuals, double part) {
    const auto at = residuals.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(residuals.size() - 1));
    std::nth_element(residuals.begin(), at, residuals.end());
    return *at;
}

/** From the place that is farthest off, away from the solid. */
ReportPage::Path makeNeedle(const SolidFit& fit) {
    const Vector3& worst = fit.points[static_cast<std::size_t>(fit.report.worst)];
    Vector3 N;
    fit.solid.calcHeightAndNormal(worst, N);
    return {{worst, worst + kNeedle * calcBox(fit.repaired.mesh).diagonal().norm() * N}, {}};
}

}  // namespace

ReportPage makeFitPage(const std::string& title, const SolidFit& fit) {
    ReportPage page;
    page.title = title;
    page.summary = fit.solid.getDescription();
    page.valueName = "mm out of the solid";
    page.largestValue = std::max(kScaleOfRms * kMillimeters * fit.report.rms, 1e-6);
    page.bones.push_back(
        {0, SimTK::Transform(), fit.repaired.mesh.points, fit.repaired.mesh.triangles, calcHeights(fit)});
    page.paths = {"farthest off"};
    page.frames.push_back({0, {SimTK::Transform()}, {makeNeedle(fit)}, {}});
    page.curveTimes = {0};
    page.headings = {"distance of the mesh from the solid", "mm", "where [m]"};
    const auto addRow = [&](const std::string& what, double distance, const std::string& where) {
        page.rows.push_back({{what, format(kMillimeters * distance, 3), where}});
    };
    const Vector3& worst = fit.points[static_cast<std::size_t>(fit.report.worst)];
    addRow("rms", fit.report.rms, "");
    addRow("median", findQuantile(fit.report.residuals, 0.5), "");
    addRow("99 of 100 below", findQuantile(fit.report.residuals, 0.99), "");
    addRow("largest", fit.report.largest,
           format(worst.x(), 4) + " " + format(worst.y(), 4) + " " + format(worst.z(), 4) + " (the needle)");
    return page;
}

}  // namespace tautline
