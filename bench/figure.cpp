/** Draws the README's figure: a path over a cylinder, a torus and an ellipsoid, as SVG on standard output. */
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
    Mat3 R = (Eigen::AngleAxisd(0.35, Vec3::UnitX()) * Eigen::AngleAxisd(-0.5, Vec3::UnitY())).toRotationMatrix();
    double scale = 110, x0 = 90, y0 = 210;

    double x(const Vec3& p) const { return x0 + scale * (R * p).x(); }
    double y(const Vec3& p) const { return y0 - scale * (R * p).y(); }
    bool faces(const Vec3& normal) const { return (R * normal).z() > 0; }
};

void drawLine(const View& view, const std::vector<Vec3>& points, const char* style) {
    std::cout << "<polyline " << style << " points=\"";
    for (const Vec3& p : points) std::cout << view.x(p) << "," << view.y(p) << " ";
    std::cout << "\"/>\n";
}

/** Coordinate lines of a surface given as x(u, v), the half that faces the viewer. */
template <class Point>
void drawSurface(const View& view, const Surface& surface, const Pose& X_GS, const Point& point, double u0, double u1,
                 double v0, double v1) {
    constexpr int kLines = 20, kSteps = 60;
    for (bool alongU : {true, false})
        for (int i = 0; i <= kLines; ++i) {
            std::vector<Vec3> run;
            for (int k = 0; k <= kSteps; ++k) {
                const double a = static_cast<double>(i) / kLines, b = static_cast<double>(k) / kSteps;
                const Vec3 p_S = point(u0 + (alongU ? b : a) * (u1 - u0), v0 + (alongU ? a : b) * (v1 - v0));
                Vec3 N;
                surface.calcHeight(p_S, N);
                if (view.faces(X_GS.R * N)) {
                    run.push_back(X_GS * p_S);
                } else if (!run.empty()) {
                    drawLine(view, run, "class=\"surface\"");
                    run.clear();
                }
            }
            if (!run.empty()) drawLine(view, run, "class=\"surface\"");
        }
}

}  // namespace

int main() {
    std::cout << std::fixed << std::setprecision(1);
    const View view;
    const auto cylinder = std::make_shared<Cylinder>(0.6);
    const auto torus = std::make_shared<Torus>(0.9, 0.3);
    const auto ellipsoid = std::make_shared<Ellipsoid>(Vec3(0.9, 0.55, 0.7));
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("cylinder", cylinder, Vec3(0, 0.6, 0));
    problem.addObstacle("torus", torus, Vec3(0.62, 0, 0));
    problem.addObstacle("ellipsoid", ellipsoid, Vec3(0, 0.55, 0));
    problem.addPoint("insertion");
    const Mat3 ringAcross = Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()).toRotationMatrix();
    PathPose pose;
    pose.X_GE = {Pose(Vec3(-0.4, -0.7, 0.5)), Pose(Vec3(0.8, 0.0, 0)), Pose(ringAcross, Vec3(2.6, 0.9, 0.1)),
                 Pose(Vec3(4.4, 0.1, 0)), Pose(Vec3(5.8, -0.8, -0.3))};
    const PathSolution path = solvePath(problem, pose);
    std::cerr << "status " << getName(path.status) << ", length " << path.length << "\n";

    std::cout << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 400\" width=\"760\" height=\"400\">\n"
                 "<style>.surface{fill:none;stroke:#7a9cc6;stroke-width:0.6} .path{fill:none;stroke:#c0392b;"
                 "stroke-width:3.5;stroke-linejoin:round;stroke-linecap:round} .end{fill:#222}</style>\n"
                 "<rect width=\"760\" height=\"400\" fill=\"white\"/>\n";
    drawSurface(
        view, *cylinder, pose.X_GE[1], [](double u, double v) { return Vec3(0.6 * std::cos(u), 0.6 * std::sin(u), v); },
        0, 2 * kPi, -1, 1);
    drawSurface(
        view, *torus, pose.X_GE[2],
        [](double u, double v) {
            const double rho = 0.9 + 0.3 * std::cos(v);
            return Vec3(rho * std::cos(u), rho * std::sin(u), 0.3 * std::sin(v));
        },
        0, 2 * kPi, 0, 2 * kPi);
    drawSurface(
        view, *ellipsoid, pose.X_GE[3],
        [](double u, double v) {
            return Vec3(0.9 * std::cos(v) * std::cos(u), 0.55 * std::sin(v), 0.7 * std::cos(v) * std::sin(u));
        },
        0, 2 * kPi, -kPi / 2, kPi / 2);
    std::vector<Vec3> points;
    calcDrawingPoints(path, problem, pose, 0.05, points);
    drawLine(view, points, "class=\"path\"");
    for (const Vec3& p : {points.front(), points.back()})
        std::cout << "<circle class=\"end\" cx=\"" << view.x(p) << "\" cy=\"" << view.y(p) << "\" r=\"5\"/>\n";
    std::cout << "</svg>\n";
    return path.status == PathStatus::Solved ? 0 : 1;
}
