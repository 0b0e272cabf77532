// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/contact_geometry_surface.h"

#include <thread>

#include "adapter_scenes.h"
#include "support/random.h"
#include "support/seeded_random.h"
#include "tautline/surfaces/half_space.h"
#include "tautline/surfaces/polynomial_patch.h"
#include "tautline/surfaces/surface_laws.h"

namespace tautline::testing {
namespace {

TEST(ContactGeometrySurfaceTest, IsPositiveOutsideAndAsCurvedAsItsTwin) {
    const ContactGeometrySurface wrapped(SimTK::ContactGeometry::Ellipsoid({1, 2, 3}));
    const Ellipsoid twin(Vector3(1, 2, 3));
    const SurfacePoint point = twin.findSurfacePoint(Vector3(1, 1, 1));
    const Vector3 direction(1, -2, 0.5);
    EXPECT_GT(wrapped.calcImplicit(2 * point.p).f, 0);
    EXPECT_LT(wrapped.calcImplicit(0.5 * point.p).f, 0);
    EXPECT_LT((wrapped.findSurfacePoint(point.p).p - point.p).norm(), 1e-14);
    const DarbouxFrame a = wrapped.calcFrame(point, direction), b = twin.calcFrame(point, direction);
    EXPECT_LT((a.N - b.N).norm(), 1e-13);
    EXPECT_NEAR(a.kappaN, b.kappaN, 1e-12);
    EXPECT_NEAR(a.tauG, b.tauG, 1e-12);
    EXPECT_NEAR(a.kappaB, b.kappaB, 1e-12);
    EXPECT_GT(wrapped.getSize(), 0.2);
    EXPECT_LT(wrapped.getSize(), 5);
}

/** z = 0.5 - 0.4 x^2 - 0.3 y^2 over [-1, 1]^2, which bicubic patches hold exactly if they are given its slopes. */
SimTK::ContactGeometry makeHeightMap() {
    constexpr int n = 5;
    SimTK::Vector x(n), y(n);
    SimTK::Matrix f(n, n), fx(n, n), fy(n, n), fxy(n, n, Real(0));
    for (int i = 0; i < n; ++i) x[i] = y[i] = -1 + 0.5 * i;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            f(i, j) = 0.5 - 0.4 * x[i] * x[i] - 0.3 * y[j] * y[j];
            fx(i, j) = -0.8 * x[i], fy(i, j) = -0.6 * y[j];
        }
    return SimTK::ContactGeometry::SmoothHeightMap(SimTK::BicubicSurface(x, y, f, fx, fy, fxy));
}

std::shared_ptr<const Surface> makeHeightMapTwin() {
    Eigen::MatrixXd p = Eigen::MatrixXd::Zero(3, 3);
    p(0, 0) = 0.5, p(2, 0) = -0.4, p(0, 2) = -0.3;
    return std::make_shared<PolynomialPatch>(PolynomialPatch::makeHeightPatch({Vector2(-1, -1), Vector2(1, 1)}, p));
}

/** A smooth geometry, the core's own surface of the same shape, where the string passes over it. */
struct GeometryCase {
    const char* name;
    SimTK::ContactGeometry geometry;
    double size;
    std::shared_ptr<const Surface> twin;
    SimTK::Vec3 A_S, B_S, hint_S;
};

std::vector<GeometryCase> makeGeometryCases() {
    using G = SimTK::ContactGeometry;
    using V = SimTK::Vec3;
    return {
        {"Sphere", G::Sphere(0.5), 0, std::make_shared<Sphere>(0.5), V(-2, 0.1, 0.1), V(2, 0.2, -0.3), V(0, 0.5, 0)},
        {"Cylinder", G::Cylinder(0.5), 0, std::make_shared<Cylinder>(0.5), V(-2, 0.1, 0.1), V(2, 0.2, -0.3),
         V(0, 0.5, 0)},
        {"Ellipsoid", G::Ellipsoid(V(0.5, 0.6, 0.7)), 0, std::make_shared<Ellipsoid>(Vector3(0.5, 0.6, 0.7)),
         V(-2, 0.1, 0.1), V(2, 0.2, -0.3), V(0, 0.6, 0)},
        {"Torus", G::Torus(1, 0.3), 0, std::make_shared<Torus>(1, 0.3), V(0.9, 0.1, -2), V(1.1, -0.2, 2), V(0.7, 0, 0)},
        {"SmoothHeightMap", makeHeightMap(), 0, makeHeightMapTwin(), V(-0.9, 0.1, 0.3), V(0.8, -0.2, 0.35),
         V(0, 0, 0.5)},
    };
}

Cable makeCable(BareScene& scene, const GeometryCase& c, std::shared_ptr<const Surface> surface) {
    Cable cable(scene.cables, scene.matter.Ground(), c.A_S, scene.matter.Ground(), c.B_S);
    cable.addObstacle(scene.matter.Ground(), Transform(), std::move(surface), c.hint_S);
    return cable;
}

TEST(ContactGeometrySurfaceTest, EverySmoothKindWrapsLikeItsTwin) {
    for (const GeometryCase& c : makeGeometryCases()) {
        SCOPED_TRACE(c.name);
        const auto calcLength = [&](std::shared_ptr<const Surface> surface) {
            BareScene scene;
            const Cable cable = makeCable(scene, c, std::move(surface));
            const State state = scene.system.realizeTopology();
            scene.system.realize(state, Stage::Position);
            EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
            EXPECT_TRUE(cable.isTouched(state, CableElementIndex(1)));
            return cable.getLength(state);
        };
        EXPECT_NEAR(calcLength(std::make_shared<ContactGeometrySurface>(c.geometry, c.size)), calcLength(c.twin), 1e-9);
    }
}

TEST(ContactGeometrySurfaceTest, EverySmoothKindObeysTheLaws) {
    std::vector<GeometryCase> cases = makeGeometryCases();
    cases.push_back({"HalfSpace", SimTK::ContactGeometry::HalfSpace(), 1, nullptr, {}, {}, {}});
    Random random(11);
    for (const GeometryCase& c : cases) {
        SCOPED_TRACE(c.name);
        const ContactGeometrySurface surface(c.geometry, c.size);
        std::vector<SurfaceLawSample> samples;
        for (int i = 0; i < 20; ++i) {
            SurfaceLawSample sample{random.vector(0.5), random.vector(1), 0.3};
            if (std::string(c.name) == "Torus") sample.p_S = Vector3(0.9, 0.1, 0.1) + 0.3 * sample.p_S;
            Vector3 N;
            surface.calcHeightAndNormal(surface.findSurfacePoint(sample.p_S).p, N);
            if (sample.direction_S.cross(N).norm() < 0.3) sample.direction_S = N.unitOrthogonal();
            samples.push_back(sample);
        }
        for (const std::string& broken : checkSurfaceLaws(surface, samples)) ADD_FAILURE() << broken;
    }
}

// 2026-11-25: spheres of radii far above 50 had a size of 51.7.
TEST(ContactGeometrySurfaceTest, ItsSizeGoesWithTheGeometryFromMillimetersToKilometers) {
    for (const double radius : {1e-3, 0.5, 60.0, 1e3, 1e6})
        EXPECT_NEAR(ContactGeometrySurface(SimTK::ContactGeometry::Sphere(radius)).getSize(), radius, 1e-9 * radius);
}

TEST(ContactGeometrySurfaceTest, AHalfSpaceIsAPlaneAndNeedsASize) {
    // SimTK's half space is where x > 0.
    const ContactGeometrySurface surface(SimTK::ContactGeometry::HalfSpace(), 2);
    Vector3 N;
    EXPECT_NEAR(surface.calcHeightAndNormal(Vector3(-0.3, 1, 2), N), 0.3, 1e-15);
    EXPECT_LT((N - Vector3(-1, 0, 0)).norm(), 1e-15);
    EXPECT_MESSAGE(ContactGeometrySurface(SimTK::ContactGeometry::HalfSpace()), "size must be positive and finite");
}

TEST(ContactGeometrySurfaceTest, AHeightMapIsOutsideAboveAndGoesOnBeyondItsEdges) {
    const ContactGeometrySurface surface(makeHeightMap());
    const auto twin = makeHeightMapTwin();
    for (const Vector3& p :
         {Vector3(0.2, 0.3, 1), Vector3(0.2, 0.3, -1), Vector3(1.4, 0.2, 0.1), Vector3(-1.2, 3, 0.5)}) {
        Vector3 N, twinN;
        EXPECT_NEAR(surface.calcHeightAndNormal(p, N), twin->calcHeightAndNormal(p, twinN), 1e-13);
        EXPECT_LT((N - twinN).norm(), 1e-13);
    }
    EXPECT_TRUE(surface.isInDomain({Vector3(0.9, -0.9, -0.067), Vector2::Zero(), 0}));
    EXPECT_FALSE(surface.isInDomain({Vector3(1.1, 0, 0.016), Vector2::Zero(), 0}));
}

TEST(ContactGeometrySurfaceTest, InsideAHeightMapIsThePrismBelowItsRectangle) {
    const ContactGeometrySurface surface(makeHeightMap());
    Random random(12);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vector3 p =
            i % 2 == 0 ? random.vector(1.5) : Vector3(random.vector(1) + Vector3(0, 0, random.uniform(-100, 0)));
        const double x = p.x(), y = p.y();
        const bool isBelow = std::abs(x) <= 1 && std::abs(y) <= 1 && p.z() < 0.5 - 0.4 * x * x - 0.3 * y * y;
        EXPECT_EQ(surface.calcHeight(p) < 0, isBelow) << p.transpose();
        inside += isBelow;
    }
    EXPECT_GT(inside, 200);
    for (const double z : {-1e4, -3.0, -0.1, 0.0, 0.3, 100.0})
        EXPECT_GT(surface.calcHeight(Vector3(3, -0.2, z)), 0) << z;
}

TEST(ContactGeometrySurfaceTest, APathOverTheEdgeOfAHeightMapHasLeftItsDomain) {
    BareScene scene;
    const GeometryCase c{"",
                         makeHeightMap(),
                         0,
                         nullptr,
                         SimTK::Vec3(0.2, -2, -0.45),
                         SimTK::Vec3(0.25, 2, -0.45),
                         SimTK::Vec3(0.2, 0, 0.5)};
    const Cable cable = makeCable(scene, c, std::make_shared<ContactGeometrySurface>(c.geometry));
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    EXPECT_EQ(cable.getStatus(state), PathStatus::LeftDomain);
    EXPECT_TRUE(std::isfinite(cable.getLength(state)));
}

// 2026-11-26: what lay below the continuation of a map counted as inside.
TEST(ContactGeometrySurfaceTest, APathBesideAHeightMapIsStraight) {
    for (const Real z : {-2.0, -0.1, 0.4}) {
        BareScene scene;
        const GeometryCase c{
            "", makeHeightMap(), 0, nullptr, SimTK::Vec3(1.2, -3, z), SimTK::Vec3(1.25, 3, z), SimTK::Vec3(1.2, 0, 0)};
        const Cable cable = makeCable(scene, c, std::make_shared<ContactGeometrySurface>(c.geometry));
        const State state = scene.system.realizeTopology();
        scene.system.realize(state, Stage::Position);
        EXPECT_EQ(cable.getStatus(state), PathStatus::Solved) << cable.explainStatus(state);
        EXPECT_NEAR(cable.getLength(state), (c.B_S - c.A_S).norm(), 1e-12);
    }
}

TEST(ContactGeometrySurfaceTest, ThreadsShareAHeightMap) {
    const auto surface = std::make_shared<ContactGeometrySurface>(makeHeightMap());
    // Paths that keep to different patches.
    const auto calcLength = [&](int i) {
        BareScene scene;
        const Real y = -0.8 + 0.4 * i;
        Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-0.9, y, 0.3), scene.matter.Ground(),
                    SimTK::Vec3(0.9, y + 0.05, 0.3));
        cable.addObstacle(scene.matter.Ground(), Transform(), surface, SimTK::Vec3(0, y, 0.5));
        const State state = scene.system.realizeTopology();
        scene.system.realize(state, Stage::Position);
        return cable.getLength(state);
    };
    constexpr int n = 5;
    std::vector<Real> expected(n), found(n);
    for (int i = 0; i < n; ++i) expected[i] = calcLength(i);
    std::vector<std::thread> threads;
    for (int i = 0; i < n; ++i) threads.emplace_back([&, i] { found[i] = calcLength(i); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
}

TEST(ContactGeometrySurfaceTest, RefusesWhatIsNotSmooth) {
    EXPECT_MESSAGE(ContactGeometrySurface(SimTK::ContactGeometry::Brick({1, 1, 1})), "not smooth");
    EXPECT_MESSAGE(ContactGeometrySurface(SimTK::ContactGeometry::Sphere(1), -2),
                   "size must be positive and finite, but is -2");
}

TEST(MakeSurface, GivesTheCoresOwnShapes) {
    using G = SimTK::ContactGeometry;
    EXPECT_EQ(makeSurface(G::Sphere(0.5))->getDescription(), Sphere(0.5).getDescription());
    EXPECT_EQ(makeSurface(G::Cylinder(0.4))->getDescription(), Cylinder(0.4).getDescription());
    EXPECT_EQ(makeSurface(G::Ellipsoid({1, 2, 3}))->getDescription(), Ellipsoid(Vector3(1, 2, 3)).getDescription());
    EXPECT_EQ(makeSurface(G::Torus(1, 0.3))->getDescription(), Torus(1, 0.3).getDescription());
    EXPECT_MESSAGE(makeSurface(G::Brick({1, 1, 1})), "not smooth");
    EXPECT_MESSAGE(makeSurface(G()), "empty");
}

/** Inside and outside are those of Simbody's function, and where it is zero the normals are the same. */
TEST(MakeSurface, OccupiesWhatTheGeometryOccupies) {
    SeededRandom random(12);
    std::vector<SimTK::ContactGeometry> geometries{SimTK::ContactGeometry::HalfSpace()};
    for (const GeometryCase& c : makeGeometryCases()) geometries.push_back(c.geometry);
    for (const SimTK::ContactGeometry& geometry : geometries) {
        const std::shared_ptr<const Surface> surface = makeSurface(geometry);
        SCOPED_TRACE(surface->getDescription());
        for (int i = 0; i < 200; ++i) {
            const Vector3 p = random.vector(0.9);
            const bool isHalfSpace = SimTK::ContactGeometry::HalfSpace::isInstance(geometry);
            const double f = isHalfSpace ? p.x() : geometry.calcSurfaceValue(toSimTK(p));
            EXPECT_EQ(surface->calcHeight(p) < 0, f > 0) << p.transpose();
            const SurfacePoint foot = surface->findSurfacePoint(p);
            if (!(surface->calcDomainMargin(foot) > 0)) continue;
            const Vector3 N = surface->calcFrame(foot, Vector3(1, 2, 3)).N;
            const Vector3 outward =
                isHalfSpace ? toEigen(SimTK::Vec3(SimTK::ContactGeometry::HalfSpace::getAs(geometry).getNormal()))
                            : Vector3(-toEigen(geometry.calcSurfaceGradient(toSimTK(foot.p))).normalized());
            EXPECT_LT((N - outward).norm(), 1e-9) << p.transpose();
        }
    }
}

/** A map of unequal cells: heights and all derivatives that geodesics need, against Simbody's. */
TEST(MakeSurface, AHeightMapHasTheValuesOfTheBicubicSurface) {
    SeededRandom random(34);
    constexpr int nx = 5, ny = 7;
    SimTK::Vector x(nx), y(ny);
    SimTK::Matrix f(nx, ny);
    for (int i = 0; i < nx; ++i) x[i] = i == 0 ? -1 : x[i - 1] + random.uniform(0.3, 0.6);
    for (int j = 0; j < ny; ++j) y[j] = j == 0 ? -2 : y[j - 1] + random.uniform(0.3, 0.6);
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) f(i, j) = random.uniform(-0.3, 0.3);
    const SimTK::BicubicSurface map(x, y, f);
    const auto surface = makeSurface(SimTK::ContactGeometry::SmoothHeightMap(map));
    double worst = 0, worstNormal = 0, worstCurvature = 0;
    for (int k = 0; k < 1000; ++k) {
        const SimTK::Vec2 at(random.uniform(x[0], x[nx - 1]), random.uniform(y[0], y[ny - 1]));
        const auto differentiate = [&](std::initializer_list<int> components) {
            return map.calcDerivative(SimTK::Array_<int>(components.begin(), components.end()), at);
        };
        const double fx = differentiate({0}), fy = differentiate({1}), slope = std::sqrt(1 + fx * fx + fy * fy);
        const SurfacePoint point{Vector3(at[0], at[1], map.calcValue(at)), Vector2(at[0], at[1]), 0};
        worst = std::max(worst, std::abs(surface->calcHeight(point.p)));
        const DarbouxFrame frame = surface->calcFrame(point, random.vector(1));
        worstNormal = std::max(worstNormal, (frame.N - Vector3(-fx, -fy, 1) / slope).norm());
        // The second fundamental form of a graph.
        const Vector3& t = frame.t;
        const double curvature = (differentiate({0, 0}) * t.x() * t.x() + 2 * differentiate({0, 1}) * t.x() * t.y() +
                                  differentiate({1, 1}) * t.y() * t.y()) /
                                 slope;
        worstCurvature = std::max(worstCurvature, std::abs(frame.kappaN - curvature) / (1 + std::abs(curvature)));
    }
    std::printf("[measured] height map: values %.1e, normals %.1e, curvatures %.1e\n", worst, worstNormal,
                worstCurvature);
    EXPECT_LT(worst, 1e-14);
    EXPECT_LT(worstNormal, 1e-13);
    EXPECT_LT(worstCurvature, 1e-12);
    EXPECT_GT(surface->calcDomainMargin(surface->findSurfacePoint(Vector3(x[0] + 0.1, 0, 0))), 0);
    EXPECT_LT(surface->calcDomainMargin(surface->findSurfacePoint(Vector3(x[0] - 0.1, 0, 0))), 0);
    EXPECT_GT(surface->calcHeight(Vector3(x[0] - 0.1, 0, -5)), 0);  // beside the map is outside
    EXPECT_LT(surface->calcHeight(Vector3(x[0] + 0.1, 0, -5)), 0);
}

TEST(MakeSurface, ACableTakesGeometryAsItIs) {
    for (const GeometryCase& c : makeGeometryCases()) {
        SCOPED_TRACE(c.name);
        BareScene scene;
        Cable given(scene.cables, SimTK::GroundIndex, c.A_S, SimTK::GroundIndex, c.B_S);
        given.addObstacle(SimTK::GroundIndex, Transform(), std::make_shared<SimTK::ContactGeometry>(c.geometry),
                          c.hint_S);
        Cable twin(scene.cables, SimTK::GroundIndex, c.A_S, SimTK::GroundIndex, c.B_S);
        twin.addObstacle(SimTK::GroundIndex, Transform(), c.twin, c.hint_S);
        const State state = scene.system.realizeTopology();
        scene.system.realize(state, Stage::Position);
        EXPECT_NEAR(given.getLength(state), twin.getLength(state), 1e-10);
        EXPECT_EQ(dynamic_cast<const ContactGeometrySurface*>(given.getSurface(given.getObstacle(0)).get()), nullptr);
    }
}

}  // namespace
}  // namespace tautline::testing
