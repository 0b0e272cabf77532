// SPDX-License-Identifier: Apache-2.0
/** Draws the README's figure: a path over a cylinder, through a torus and over an ellipsoid, as SVG on standard output.
Facets and pieces of the path are painted from the back to the front, so that what is nearer hides what is behind. */
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <vector>

#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/torus.h"

namespace {

using namespace tautline;

/** Orthographic view: x to the right, y up, z towards the viewer, after turning the scene. */
struct View {
    Matrix3 R =
        (Eigen::AngleAxisd(0.35, Vector3::UnitX()) * Eigen::AngleAxisd(0.55, Vector3::UnitY())).toRotationMatrix();
    double scale = 110, x0 = 118, y0 = 276;

    double x(const Vector3& p) const { return x0 + scale * (R * p).x(); }
    double y(const Vector3& p) const { return y0 - scale * (R * p).y(); }
    double calcNearness(const Vector3& p) const { return (R * p).z(); }
};

/** Something to be painted: a facet, or a piece of the path. */
struct Shape {
    std::vector<Vector3> points;
    double nearness = 0;
    double brightness = -1;  ///< of a facet, 0 to 1; negative: a piece of the path
};

/** Facets of a surface given as x(u, v), the darker the more they turn away from the light. */
template <class Point>
void addSurface(const View& view, const Surface& surface, const Pose& X_GS, const Point& point, int numU, int numV,
                std::vector<Shape>& shapes) {
    const Vector3 light = view.R.transpose() * Vector3(-0.4, 0.7, 0.6).normalized();
    for (int i = 0; i < numU; ++i)
        for (int k = 0; k < numV; ++k) {
            Shape facet;
            Vector3 middle_S = Vector3::Zero(), N_S;
            for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                const Vector3 p_S = point(static_cast<double>(i + du) / numU, static_cast<double>(k + dv) / numV);
                facet.points.push_back(X_GS * p_S);
                middle_S += p_S / 4;
            }
            surface.calcHeightAndNormal(middle_S, N_S);
            const double facing = std::abs((X_GS.R * N_S).dot(light));  // what is seen from inside is lit, too
            facet.nearness = view.calcNearness(X_GS * middle_S), facet.brightness = facing;
            shapes.push_back(facet);
        }
}

/** Pieces of the path short beside a facet, each a little nearer than it is: it lies on the surfaces. */
void addPath(const View& view, const std::vector<Vector3>& points, std::vector<Shape>& shapes) {
    constexpr double kPiece = 0.03, kLift = 0.12;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vector3 step = points[i + 1] - points[i];
        const int count = std::max(1, static_cast<int>(step.norm() / kPiece));
        for (int k = 0; k < count; ++k) {
            Shape piece;
            piece.points = {points[i] + k * step / count, points[i] + (k + 1) * step / count};
            piece.nearness = view.calcNearness((piece.points[0] + piece.points[1]) / 2) + kLift;
            shapes.push_back(piece);
        }
    }
}

void paint(const View& view, const Shape& shape) {
    const bool isFacet = shape.brightness >= 0;
    std::cout << (isFacet ? "<polygon" : "<polyline class=\"path\"") << " points=\"";
    for (const Vector3& p : shape.points) std::cout << view.x(p) << "," << view.y(p) << " ";
    std::cout << "\"";
    if (isFacet) {
        const auto mix = [&](int dark, int bright) {
            return dark + static_cast<int>(shape.brightness * (bright - dark));
        };
        std::cout << " fill=\"rgb(" << mix(120, 226) << "," << mix(152, 236) << "," << mix(196, 248) << ")\"";
    }
    std::cout << "/>\n";
}

}  // namespace

int main() {
    std::cout << std::fixed << std::setprecision(1);
    const View view;
    const auto cylinder = std::make_shared<Cylinder>(0.6);
    const auto torus = std::make_shared<Torus>(0.9, 0.3);
    const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(0.9, 0.55, 0.7));
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("cylinder", cylinder, Vector3(0, 0.6, 0));
    problem.addObstacle("torus", torus, ThreadHole{1});
    problem.addObstacle("ellipsoid", ellipsoid, Vector3(0, 0.55, 0));
    problem.addPoint("insertion");
    const Matrix3 ringAcross = Eigen::AngleAxisd(kPi / 2, Vector3::UnitY()).toRotationMatrix();
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-0.6, -0.8, 0.2)), Pose(Vector3(0.8, 0.0, 0)), Pose(ringAcross, Vector3(2.6, 0.9, 0.1)),
                 Pose(Vector3(4.4, -0.9, 0.1)), Pose(Vector3(5.9, -1.5, 0.1))};
    const PathSolution path = solvePath(problem, pose);
    std::cerr << "status " << getName(path.status) << ", length " << path.length << "\n";

    std::vector<Shape> shapes;
    addSurface(
        view, *cylinder, pose.X_GE[1],
        [](double u, double v) { return Vector3(0.6 * std::cos(2 * kPi * u), 0.6 * std::sin(2 * kPi * u), 2 * v - 1); },
        36, 12, shapes);
    addSurface(
        view, *torus, pose.X_GE[2],
        [](double u, double v) {
            const double rho = 0.9 + 0.3 * std::cos(2 * kPi * v);
            return Vector3(rho * std::cos(2 * kPi * u), rho * std::sin(2 * kPi * u), 0.3 * std::sin(2 * kPi * v));
        },
        48, 20, shapes);
    addSurface(
        view, *ellipsoid, pose.X_GE[3],
        [](double u, double v) {
            const double latitude = kPi * (v - 0.5);
            return Vector3(0.9 * std::cos(latitude) * std::cos(2 * kPi * u), 0.55 * std::sin(latitude),
                           0.7 * std::cos(latitude) * std::sin(2 * kPi * u));
        },
        36, 16, shapes);
    std::vector<Vector3> points;
    calcDrawingPoints(path, problem, pose, 0.05, points);
    addPath(view, points, shapes);
    std::stable_sort(shapes.begin(), shapes.end(),
                     [](const Shape& a, const Shape& b) { return a.nearness < b.nearness; });

    std::cout << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 400\" width=\"760\" height=\"400\">\n"
                 "<style>polygon{stroke:#7a9cc6;stroke-width:0.5;stroke-linejoin:round} .path{fill:none;"
                 "stroke:#c0392b;stroke-width:3.5;stroke-linecap:round} .end{fill:#222}</style>\n"
                 "<rect width=\"760\" height=\"400\" fill=\"white\"/>\n";
    for (const Shape& shape : shapes) paint(view, shape);
    for (const Vector3& p : {points.front(), points.back()})
        std::cout << "<circle class=\"end\" cx=\"" << view.x(p) << "\" cy=\"" << view.y(p) << "\" r=\"5\"/>\n";
    std::cout << "</svg>\n";
    return path.status == PathStatus::Solved ? 0 : 1;
}
