// SPDX-License-Identifier: Apache-2.0
#pragma once
/** All kinds of surface of the project with samples for the laws: random ones, and ones crowded where
coordinates or curvatures are special. */
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "support/triangle_meshes.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/cone.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/elliptic_torus.h"
#include "tautline/surfaces/function_surface.h"
#include "tautline/surfaces/half_space.h"
#include "tautline/surfaces/offset_surface.h"
#include "tautline/surfaces/paraboloid.h"
#include "tautline/surfaces/patch_fit.h"
#include "tautline/surfaces/scaled_surface.h"
#include "tautline/surfaces/solid_fit.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/surface_laws.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

struct SurfaceCase {
    std::string name;
    std::shared_ptr<const Surface> surface;
    std::vector<Vector3> specialPoints;  ///< poles, equators, seams, joints
    double extent = 1;                   ///< random points are drawn from the cube [-extent, extent]^3 about `center`
    Vector3 center = Vector3::Zero();
    double length = 1;                  ///< of the longest geodesic
    double differenceTolerance = 1e-5;  ///< more where curvature has kinks, so that differences are of first order
};

/** Two forms of the same surface. */
struct TwinCase {
    std::string name;
    std::shared_ptr<const Surface> implicitForm, parametricForm;
    double extent, length;
    std::vector<Vector3> specialPoints;
    Vector3 center = Vector3::Zero();
};

/** What GoogleTest and ctest call a case. */
inline void PrintTo(const SurfaceCase& surfaceCase, std::ostream* text) {
    *text << surfaceCase.name;
}
inline void PrintTo(const TwinCase& twinCase, std::ostream* text) {
    *text << twinCase.name;
}

/** The axis points and near-axis points of a box: poles and equators of the closed shapes about the origin. */
inline std::vector<Vector3> makeAxisPoints(const Vector3& semiAxes) {
    std::vector<Vector3> points;
    for (int i = 0; i < 3; ++i)
        for (const double side : {1.0, -1.0})
            for (const double aside : {0.0, 1e-12, 1e-7, 1e-3}) {
                Vector3 p = Vector3::Zero();
                p[i] = side * semiAxes[i];
                p[(i + 1) % 3] = aside * semiAxes[(i + 1) % 3];
                p[(i + 2) % 3] = -0.4 * aside * semiAxes[(i + 2) % 3];
                points.push_back(p);
            }
    return points;
}

/** Points on and beside the special circles of a torus: outer and inner equator, top, and the seams u, v = pi. */
inline std::vector<Vector3> makeTorusPoints(double R, double a, double b) {
    std::vector<Vector3> points;
    for (const double u : {0.0, kPi, kPi - 1e-9, 1.0})
        for (const double v : {0.0, 0.5 * kPi, kPi, -kPi + 1e-9, 0.5 * kPi + 1e-6}) {
            const double rho = R + a * std::cos(v);
            points.push_back({rho * std::cos(u), rho * std::sin(u), b * std::sin(v)});
        }
    return points;
}

/** Factors along the axes of a body in which the surface's frame lies askew. */
inline Matrix3 makeBodyScaling(const Vector3& factors) {
    const Matrix3 R_BS = Eigen::AngleAxisd(0.7, Vector3(2, -1, 3).normalized()).toRotationMatrix();
    return R_BS.transpose() * factors.asDiagonal() * R_BS;
}

inline std::vector<Vector3> mapPoints(const Matrix3& M, std::vector<Vector3> points) {
    for (Vector3& p : points) p = (M * p).eval();
    return points;
}

inline std::vector<TwinCase> makeTwinCases() {
    std::vector<TwinCase> cases;
    const Vector3 axes(0.05, 0.03, 0.08), long_(1, 0.2, 0.3);
    cases.push_back({"Sphere", std::make_shared<Sphere>(0.4), std::make_shared<ParametricSphere>(0.4), 0.6, 1.1,
                     makeAxisPoints(Vector3::Constant(0.4))});
    cases.push_back({"Cylinder", std::make_shared<Cylinder>(0.4), std::make_shared<ParametricCylinder>(0.4), 0.6, 3.0,
                     makeAxisPoints(Vector3(0.4, 0.4, 5))});
    cases.push_back({"Ellipsoid", std::make_shared<Ellipsoid>(axes), std::make_shared<ParametricEllipsoid>(axes), 0.1,
                     0.15, makeAxisPoints(axes)});
    cases.push_back({"LongEllipsoid", std::make_shared<Ellipsoid>(long_), std::make_shared<ParametricEllipsoid>(long_),
                     1.0, 1.0, makeAxisPoints(long_)});
    cases.push_back({"Torus", std::make_shared<Torus>(3, 1), std::make_shared<ParametricTorus>(3, 1), 4, 6,
                     makeTorusPoints(3, 1, 1)});
    cases.push_back({"EllipticTorus", std::make_shared<EllipticTorus>(0.3, 0.06, 0.11),
                     std::make_shared<ParametricEllipticTorus>(0.3, 0.06, 0.11), 0.4, 0.4,
                     makeTorusPoints(0.3, 0.06, 0.11)});
    cases.push_back({"Paraboloid",
                     std::make_shared<Paraboloid>(14, 6),
                     std::make_shared<ParametricParaboloid>(14, 6),
                     8,
                     6,
                     {Vector3::Zero(), Vector3(1e-9, 0, 0)}});
    cases.push_back({"EllipticCylinder", std::make_shared<EllipticCylinder>(0.3, 0.1),
                     std::make_shared<ParametricEllipticCylinder>(0.3, 0.1), 0.4, 0.5,
                     makeAxisPoints(Vector3(0.3, 0.1, 5))});
    const auto capsule = std::make_shared<Capsule>(0.1, 0.3, 0.12);
    const double joint = 0.5 * capsule->getLength();
    cases.push_back({"Capsule",
                     capsule,
                     std::make_shared<ParametricCapsule>(0.1, 0.3, 0.12),
                     0.3,
                     0.3,
                     {Vector3(0, 0, 0.27), Vector3(0, 0, -0.27), Vector3(0.1, 0, joint), Vector3(0.1, 0, joint + 1e-4),
                      Vector3(0, 0.1, 0)}});
    cases.push_back({"HalfSpace",
                     std::make_shared<HalfSpace>(0.2),
                     std::make_shared<ParametricHalfSpace>(0.2),
                     1,
                     2,
                     {Vector3::Zero()}});
    cases.push_back({"Cone",
                     std::make_shared<Cone>(0.4, 0.3),
                     std::make_shared<ParametricCone>(0.4, 0.3),
                     0.4,
                     1,
                     {},
                     Vector3(0, 0, 1)});
    cases.push_back(
        {"ScaledTorus",
         std::make_shared<ScaledImplicitSurface<Torus>>(Torus(0.3, 0.1), Vector3(1.2, 0.9, 1.5)),
         std::make_shared<ScaledParametricSurface<ParametricTorus>>(ParametricTorus(0.3, 0.1), Vector3(1.2, 0.9, 1.5)),
         0.5,
         0.4,
         {Vector3(0.48, 0, 0), Vector3(-0.48, 0, 0), Vector3(0, 0.18, 0)}});
    const Matrix3 body = makeBodyScaling(Vector3(1.3, 0.8, 1.0)), strong = makeBodyScaling(Vector3(2.5, 0.5, 1.0));
    cases.push_back({"ShearedTorus", std::make_shared<ScaledImplicitSurface<Torus>>(Torus(0.3, 0.1), body),
                     std::make_shared<ScaledParametricSurface<ParametricTorus>>(ParametricTorus(0.3, 0.1), body), 0.5,
                     0.4, mapPoints(body, makeTorusPoints(0.3, 0.1, 0.1))});
    cases.push_back({"StronglySheared", std::make_shared<ScaledImplicitSurface<Ellipsoid>>(Ellipsoid(axes), strong),
                     std::make_shared<ScaledParametricSurface<ParametricEllipsoid>>(ParametricEllipsoid(axes), strong),
                     0.1, 0.08, mapPoints(strong, makeAxisPoints(axes))});
    cases.push_back(
        {"ShearedCapsule", std::make_shared<ScaledImplicitSurface<Capsule>>(Capsule(0.1, 0.3, 0.12), body),
         std::make_shared<ScaledParametricSurface<ParametricCapsule>>(ParametricCapsule(0.1, 0.3, 0.12), body), 0.3,
         0.3,
         mapPoints(body, {Vector3(0, 0, 0.27), Vector3(0, 0, -0.27), Vector3(0.1, 0, joint), Vector3(0, 0.1, 0)})});
    return cases;
}

/** A saddle with bumps over [-1, 1]^2: as a formula, its height patches, and a curved patch in space. */
inline double calcBumps(double x, double y) {
    return 0.3 * std::sin(1.3 * x + 0.4) * std::cos(1.1 * y) - 0.2 * x * x;
}

inline BSplinePatch makeBumpPatch(int n, double normalSign = 1) {
    Eigen::MatrixXd heights(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) heights(i, j) = calcBumps(-1 + 2.0 * i / (n - 1), -1 + 2.0 * j / (n - 1));
    return BSplinePatch::interpolateHeights({Vector2(-1, -1), Vector2(1, 1)}, heights, normalSign);
}

/** Part of a cylinder-like shell through B-splines in space: no height patch. */
inline BSplinePatch makeShellPatch() {
    const int n = 9;
    Eigen::Matrix3Xd points(3, n * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = -1.2 + 2.4 * i / (n - 1), v = -0.5 + 1.0 * j / (n - 1), r = 0.3 + 0.05 * v * v;
            points.col(i * n + j) = Vector3(r * std::cos(u), r * std::sin(u), v);
        }
    return BSplinePatch::interpolate({Vector2(0, 0), Vector2(1, 1)}, n, n, points);
}

inline PolynomialPatch makePolynomialPatch(int order, double normalSign = 1) {
    std::vector<Vector3> points;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
            const double x = -1 + 0.1 * i, y = -1 + 0.1 * j;
            points.push_back({x, y, calcBumps(x, y)});
        }
    return fitPolynomialHeights(points, order, order, PolynomialTerms::TotalDegree, normalSign).patch;
}

/** A pear: convex or not, with a formula only. */
inline ImplicitFunctionSurface makePear() {
    return makeImplicitSurface("pear", 0.2, [](auto x, auto y, auto z) {
        const auto w = 1 + 0.8 * z;
        return 0.5 * ((x * x + y * y) * w * w / 0.2 + z * z / 0.45 - 0.2);
    });
}

/** Of a mesh with facets of some 6 mm. */
inline std::shared_ptr<const BSplineSolid> getBoneSolid() {
    static const auto bone = std::make_shared<const BSplineSolid>(fitSolid(makeBoneMesh()).solid);
    return bone;
}

/** Every surface of the project: both forms of the twins, and the ones with one form. */
inline std::vector<SurfaceCase> makeSurfaceCases() {
    std::vector<SurfaceCase> cases;
    for (const TwinCase& twin : makeTwinCases()) {
        cases.push_back({twin.name, twin.implicitForm, twin.specialPoints, twin.extent, twin.center, twin.length});
        cases.push_back(
            {"Parametric" + twin.name, twin.parametricForm, twin.specialPoints, twin.extent, twin.center, twin.length});
    }
    cases.push_back({"OffsetEllipsoid",
                     std::make_shared<OffsetSurface>(std::make_shared<Ellipsoid>(Vector3(0.05, 0.03, 0.08)), 0.01),
                     {Vector3(0.06, 0, 0), Vector3(0, 0.04, 0), Vector3(0, 0, 0.09)},
                     0.1,
                     Vector3::Zero(),
                     0.15});
    cases.push_back({"OffsetParametricTorus",
                     std::make_shared<OffsetSurface>(std::make_shared<ParametricTorus>(0.3, 0.1), 0.02),
                     {Vector3(0.42, 0, 0), Vector3(0.18, 0, 0)},
                     0.4,
                     Vector3::Zero(),
                     0.4});
    cases.push_back({"PolynomialPatch",
                     std::make_shared<PolynomialPatch>(makePolynomialPatch(5)),
                     {Vector3::Zero()},
                     0.7,
                     Vector3::Zero(),
                     0.3});
    cases.push_back({"PolynomialPatchFromBelow",
                     std::make_shared<PolynomialPatch>(makePolynomialPatch(4, -1)),
                     {Vector3::Zero()},
                     0.7,
                     Vector3::Zero(),
                     0.3});
    cases.push_back({"BSplinePatch",
                     std::make_shared<BSplinePatch>(makeBumpPatch(11)),
                     {Vector3(0.2, 0.2, 0), Vector3(0.1, 0.2, 0.1)},
                     0.7,
                     Vector3::Zero(),
                     0.3,
                     1e-3});
    cases.push_back({"BSplinePatchBeyondItsEdge",
                     std::make_shared<BSplinePatch>(makeBumpPatch(11)),
                     {Vector3(1, 0, 0), Vector3(1.2, 1.3, 0)},
                     0.3,
                     Vector3(1.1, 0.9, 0),
                     0.3,
                     1e-3});
    cases.push_back({"BSplineShell",
                     std::make_shared<BSplinePatch>(makeShellPatch()),
                     {Vector3(0.35, 0, 0)},
                     0.15,
                     Vector3(0.35, 0, 0),
                     0.2,
                     1e-3});
    cases.push_back({"BSplineSolid",
                     getBoneSolid(),
                     {Vector3(0, 0, 0.15), Vector3(0, 0, -0.15), Vector3(0.012, 0, 0)},
                     0.15,
                     Vector3::Zero(),
                     0.02,
                     1e-3});
    cases.push_back(
        {"FormulaPear", std::make_shared<ImplicitFunctionSurface>(makePear()), {}, 0.3, Vector3::Zero(), 0.3});
    cases.push_back(
        {"ValueOnlyPear",
         std::make_shared<ImplicitFunctionSurface>(
             "pear by values", 0.2, [pear = makePear()](const Vector3& p) { return pear.calcImplicit(p).f; }),
         {},
         0.3,
         Vector3::Zero(),
         0.3});
    cases.push_back(
        {"GradientPear",
         std::make_shared<ImplicitFunctionSurface>(
             "pear by gradients", 0.2, [pear = makePear()](const Vector3& p) { return pear.calcImplicit(p).f; },
             [pear = makePear()](const Vector3& p) { return pear.calcImplicit(p).gradient; }),
         {},
         0.3,
         Vector3::Zero(),
         0.3});
    // Of unknown class, scaled in the form that they have.
    const Matrix3 body = makeBodyScaling(Vector3(1.3, 0.8, 1.0));
    cases.push_back({"ScaledPear",
                     makeScaledSurface(std::make_shared<ImplicitFunctionSurface>(makePear()), body),
                     {},
                     0.3,
                     Vector3::Zero(),
                     0.3});
    cases.push_back({"ScaledSharedEllipsoid",
                     makeScaledSurface(std::make_shared<ParametricEllipsoid>(Vector3(0.05, 0.03, 0.08)), body),
                     mapPoints(body, makeAxisPoints(Vector3(0.05, 0.03, 0.08))), 0.1, Vector3::Zero(), 0.15});
    cases.push_back(
        {"ScaledOffsetTorus",
         makeScaledSurface(std::make_shared<OffsetSurface>(std::make_shared<ParametricTorus>(0.3, 0.1), 0.02), body),
         mapPoints(body, {Vector3(0.42, 0, 0), Vector3(0.18, 0, 0)}), 0.4, Vector3::Zero(), 0.4});
    cases.push_back(
        {"OffsetScaledTorus",
         std::make_shared<OffsetSurface>(makeScaledSurface(std::make_shared<ParametricTorus>(0.3, 0.1), body), 0.02),
         mapPoints(body, {Vector3(0.42, 0, 0), Vector3(0.18, 0, 0)}), 0.4, Vector3::Zero(), 0.4});
    cases.push_back({"ScaledPatchFromBelow",
                     makeScaledSurface(std::make_shared<PolynomialPatch>(makePolynomialPatch(4, -1)), body),
                     {Vector3::Zero()},
                     0.7,
                     Vector3::Zero(),
                     0.3});
    const ParameterDomain square{Vector2(-1, -1), Vector2(1, 1)};
    cases.push_back({"FormulaSheet",
                     std::make_shared<ParametricFunctionSurface>(makeParametricSurface(
                         "sheet", 0.5, square,
                         [](auto u, auto v) {
                             using Number = decltype(u);
                             return std::array<Number, 3>{u + 0.1 * v, v - 0.1 * u * u, 0.3 * sin(u) * cos(v)};
                         })),
                     {Vector3::Zero()},
                     0.5,
                     Vector3::Zero(),
                     0.4});
    cases.push_back({"PositionSheet",
                     std::make_shared<ParametricFunctionSurface>(ParametricFunctionSurface::fromPosition(
                         "sheet by positions", 0.5, square,
                         [](const Vector2& uv) {
                             const double u = uv[0], v = uv[1];
                             return Vector3(u + 0.1 * v, v - 0.1 * u * u, 0.3 * std::sin(u) * std::cos(v));
                         })),
                     {Vector3::Zero()},
                     0.5,
                     Vector3::Zero(),
                     0.4});
    return cases;
}

/** Random directions at random points off the surface by up to half its size, and at the special points. */
inline std::vector<SurfaceLawSample> makeSamples(const Surface& surface, double extent, const Vector3& center,
                                                 double length, const std::vector<Vector3>& specialPoints,
                                                 int numRandom, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto draw = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    std::vector<SurfaceLawSample> samples;
    const auto add = [&](const Vector3& p) {
        const Vector3 foot = surface.findSurfacePoint(p).p;
        Vector3 N;
        surface.calcHeightAndNormal(foot, N);
        Vector3 direction = draw();
        if (direction.cross(N).norm() < 0.3) direction = N.unitOrthogonal();
        samples.push_back({p, direction, length * (0.55 + 0.45 * uniform(random))});
    };
    for (int i = 0; i < numRandom; ++i) {
        const Vector3 foot = surface.findSurfacePoint(center + extent * draw()).p;
        add(foot + 0.02 * surface.getSize() * draw());
    }
    for (const Vector3& p : specialPoints)
        for (int i = 0; i < 2; ++i) add(p);
    return samples;
}

}  // namespace tautline::testing
