// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_decorations.h"

#include "adapter_scenes.h"
#include "support/surface_cases.h"
#include "tautline/simbody/contact_geometry_surface.h"
#include "tautline/simbody/conversions.h"

namespace tautline::testing {
namespace {

/** Counts what is drawn, by kind. */
struct Drawing : SimTK::DecorativeGeometryImplementation {
    explicit Drawing(const SimTK::Array_<SimTK::DecorativeGeometry>& geometry) {
        for (const SimTK::DecorativeGeometry& shape : geometry) shape.implementGeometry(*this);
    }
    void implementPointGeometry(const SimTK::DecorativePoint&) override { ++others; }
    void implementLineGeometry(const SimTK::DecorativeLine& line) override {
        ++lines;
        pathLength += (line.getPoint2() - line.getPoint1()).norm();
    }
    void implementBrickGeometry(const SimTK::DecorativeBrick&) override { ++others; }
    void implementCylinderGeometry(const SimTK::DecorativeCylinder& shape) override {
        addSurface(shape);
        cylinderHalfLength = shape.getHalfHeight();
    }
    void implementCircleGeometry(const SimTK::DecorativeCircle&) override { ++others; }
    void implementSphereGeometry(const SimTK::DecorativeSphere& shape) override { addSurface(shape); }
    void implementEllipsoidGeometry(const SimTK::DecorativeEllipsoid& shape) override { addSurface(shape); }
    void implementFrameGeometry(const SimTK::DecorativeFrame& frame) override {
        frames.push_back(frame.getTransform());
    }
    void implementTextGeometry(const SimTK::DecorativeText&) override { ++others; }
    void implementMeshGeometry(const SimTK::DecorativeMesh& shape) override {
        addSurface(shape);
        meshes.push_back(shape.getMesh());
    }
    void implementMeshFileGeometry(const SimTK::DecorativeMeshFile&) override { ++others; }
    void implementTorusGeometry(const SimTK::DecorativeTorus& shape) override { addSurface(shape); }
    void implementArrowGeometry(const SimTK::DecorativeArrow&) override { ++others; }
    void implementConeGeometry(const SimTK::DecorativeCone&) override { ++others; }

    void addSurface(const SimTK::DecorativeGeometry& shape) { surfaceColors.push_back(shape.getColor()); }

    int lines = 0, others = 0;
    Real pathLength = 0, cylinderHalfLength = SimTK::NaN;
    std::vector<SimTK::Vec3> surfaceColors;
    std::vector<SimTK::PolygonalMesh> meshes;
    std::vector<Transform> frames;
};

Drawing draw(CableDecorations& decorations, const State& state) {
    SimTK::Array_<SimTK::DecorativeGeometry> geometry;
    decorations.generateDecorations(state, geometry);
    return Drawing(geometry);
}

Drawing draw(const CablePathSubsystem& cables, const State& state, Real frameSize) {
    return draw(CableDecorations(cables).setContactFrameSize(frameSize), state);
}

/** A cable from the left to the right above one obstacle on ground that is not in its way unless it is raised. */
struct OneObstacleScene : BareScene {
    OneObstacleScene(std::shared_ptr<const Surface> surface, const Transform& X_GS, const SimTK::Vec3& A_G,
                     const SimTK::Vec3& B_G) {
        cable = Cable(cables, matter.Ground(), A_G, matter.Ground(), B_G);
        obstacle = cable.addObstacle(matter.Ground(), X_GS, std::move(surface));
        state = system.realizeTopology();
    }
    Cable cable;
    CableElementIndex obstacle;
    State state;
};

/** From a point in S to the nearest of 5 x 5 points of each facet of a mesh of quadrangles. */
Real calcDistance(const SimTK::PolygonalMesh& mesh, const SimTK::Vec3& p) {
    Real least = SimTK::Infinity;
    for (int face = 0; face < mesh.getNumFaces(); ++face) {
        const auto corner = [&](int i) { return mesh.getVertexPosition(mesh.getFaceVertex(face, i)); };
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; j <= 4; ++j) {
                const SimTK::Vec3 low = corner(0) + 0.25 * i * (corner(1) - corner(0));
                const SimTK::Vec3 high = corner(3) + 0.25 * i * (corner(2) - corner(3));
                least = std::min(least, (low + 0.25 * j * (high - low) - p).norm());
            }
    }
    return least;
}

TEST(CableDecorationsTest, DrawThePathWithItsCurvesAndTheSurfaces) {
    MechanismScene scene;
    const State state = scene.makeState(0);
    const Drawing drawing = draw(scene.cables, state, 0);
    EXPECT_EQ(drawing.surfaceColors.size(), 3u);
    EXPECT_GT(drawing.lines, 10);
    // Arcs are turned by 0.1 per line, which is short by 0.1^2/24 of them.
    EXPECT_NEAR(drawing.pathLength, scene.cable.getLength(state), 1e-3);
    EXPECT_TRUE(drawing.frames.empty());
    EXPECT_EQ(drawing.others, 0);
}

TEST(CableDecorationsTest, TouchedSurfacesHaveTheirColor) {
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-2, 0, 0), scene.matter.Ground(),
                SimTK::Vec3(2, 0, 0));
    const auto sphere = std::make_shared<Sphere>(0.4);
    cable.addObstacle(scene.matter.Ground(), SimTK::Vec3(-1, -0.3, 0), sphere);
    cable.addObstacle(scene.matter.Ground(), SimTK::Vec3(1, -0.6, 0), sphere);
    const State state = scene.system.realizeTopology();
    const Drawing drawing = draw(scene.cables, state, 0);
    ASSERT_EQ(drawing.surfaceColors.size(), 2u);
    EXPECT_EQ(drawing.surfaceColors[0], SimTK::Orange);
    EXPECT_EQ(drawing.surfaceColors[1], SimTK::Cyan);
}

TEST(CableDecorationsTest, ContactFramesOnDemand) {
    MechanismScene scene;
    const State state = scene.makeState(0);
    const Drawing drawing = draw(scene.cables, state, 0.1);
    ASSERT_EQ(drawing.frames.size(), 6u);
    SimTK::Vec3 P_G, Q_G;
    ASSERT_TRUE(scene.cable.getContactPoints(state, scene.sphere, P_G, Q_G));
    EXPECT_LT((drawing.frames[0].p() - P_G).norm(), 1e-14);
    EXPECT_LT((drawing.frames[1].p() - Q_G).norm(), 1e-14);
    // x runs along the path, y out of the sphere.
    const SimTK::Vec3 center_G = scene.matter.getMobilizedBody(scene.cable.getElementBody(scene.sphere))
                                     .findStationLocationInGround(state, scene.cable.calcStation(state, scene.sphere));
    EXPECT_LT((SimTK::Vec3(drawing.frames[0].y()) - (P_G - center_G) / 0.5).norm(), 1e-12);
    EXPECT_GT(~drawing.frames[0].x() * (Q_G - P_G), 0);
    EXPECT_MESSAGE(CableDecorations(scene.cables).setContactFrameSize(-1), "not negative, but is -1");
}

/** Copies of a PolygonalMesh share what is in it. */
bool areOne(SimTK::PolygonalMesh& a, const SimTK::PolygonalMesh& b) {
    const SimTK::Vec3 p = a.getVertexPosition(0);
    a.scaleMesh(2);
    return b.getVertexPosition(0) == 2 * p;
}

/** Whatever its shape, an obstacle has one picture; what Simbody has no shape for is a mesh on the surface. */
TEST(CableDecorationsTest, EverySurfaceOfTheProjectIsDrawn) {
    for (const SurfaceCase& one : makeSurfaceCases()) {
        SCOPED_TRACE(one.name);
        OneObstacleScene scene(one.surface, Transform(), SimTK::Vec3(-2, 0, 30), SimTK::Vec3(2, 0, 30));
        const Drawing drawing = draw(scene.cables, scene.state, 0);
        EXPECT_EQ(drawing.surfaceColors.size(), 1u);
        for (const SimTK::PolygonalMesh& mesh : drawing.meshes) {
            EXPECT_GT(mesh.getNumFaces(), 50);
            for (int i = 0; i < mesh.getNumVertices(); ++i)
                EXPECT_LT(std::abs(one.surface->calcHeight(toEigen(mesh.getVertexPosition(i)))),
                          1e-10 * one.surface->getSize());
        }
        const std::string itself[] = {"Sphere", "Cylinder", "Ellipsoid", "LongEllipsoid", "Torus"};
        const bool isSimbodys = std::find(std::begin(itself), std::end(itself), one.name) != std::end(itself);
        EXPECT_EQ(drawing.meshes.size(), isSimbodys ? 0u : 1u);
    }
}

/** Simbody's own pictures of its geometries leave some out and have frames of their own: these are meshes too. */
TEST(CableDecorationsTest, AnySmoothGeometryIsDrawn) {
    SimTK::Matrix f(4, 4, Real(0));
    f(1, 1) = 0.1;
    const SimTK::BicubicSurface surface(SimTK::Vec2(-1, -1), SimTK::Vec2(0.5, 0.5), f),
        away(SimTK::Vec2(7, -6), SimTK::Vec2(0.5, 0.5), f);
    using Geometry = SimTK::ContactGeometry;
    const std::pair<Geometry, Real> geometries[] = {{Geometry::Sphere(0.1), 0},
                                                    {Geometry::Cylinder(0.1), 0},
                                                    {Geometry::Ellipsoid(SimTK::Vec3(0.1, 0.2, 0.3)), 0},
                                                    {Geometry::Torus(0.5, 0.1), 0},
                                                    {Geometry::HalfSpace(), 0.3},
                                                    {Geometry::SmoothHeightMap(surface), 0},
                                                    {Geometry::SmoothHeightMap(away), 0}};
    for (const auto& [geometry, size] : geometries) {
        SCOPED_TRACE(geometry.getTypeId());
        OneObstacleScene scene(std::make_shared<ContactGeometrySurface>(geometry, size), Transform(),
                               SimTK::Vec3(-2, 3, 3), SimTK::Vec3(-2, 3, 4));
        const Drawing drawing = draw(scene.cables, scene.state, 0);
        ASSERT_EQ(drawing.meshes.size(), 1u);
        const SimTK::PolygonalMesh& mesh = drawing.meshes.front();
        EXPECT_GT(mesh.getNumFaces(), 50);
        for (int i = 0; i < mesh.getNumVertices(); ++i) {
            SimTK::Vec3 p = mesh.getVertexPosition(i);
            // A height map is not defined one rounding beyond its edge.
            if (Geometry::SmoothHeightMap::isInstance(geometry)) {
                const SimTK::BicubicSurface& map = Geometry::SmoothHeightMap::getAs(geometry).getBicubicSurface();
                for (const int k : {0, 1}) p[k] = SimTK::clamp(map.getMinXY()[k], p[k], map.getMaxXY()[k]);
            }
            EXPECT_NEAR(geometry.calcSurfaceValue(p), 0, 1e-10);
        }
    }
}

/** Surfaces without end are drawn where they are touched, however far that is from their origin. */
TEST(CableDecorationsTest, PicturesReachTheContact) {
    using V = SimTK::Vec3;
    const Transform along(SimTK::Rotation(SimTK::Pi / 2, SimTK::YAxis), V(0, -0.1, 0));  // z of S along x of ground
    const struct {
        std::shared_ptr<const Surface> surface;
        Transform X_GS;
        V A_G, B_G;
    } cases[] = {{std::make_shared<EllipticCylinder>(0.2, 0.3), along, V(7, 0.1, -2), V(7.3, 0.1, 2)},
                 {std::make_shared<Cone>(0.3, 0.2), along, V(4, 0.5, -2), V(4.2, 0.5, 2)},
                 {std::make_shared<ParametricParaboloid>(0.4, 0.3), along, V(9, 0.5, -4), V(9.2, 0.5, 4)}};
    for (const auto& one : cases) {
        SCOPED_TRACE(one.surface->getDescription());
        OneObstacleScene scene(one.surface, one.X_GS, one.A_G, one.B_G);
        CableDecorations decorations(scene.cables);
        const Drawing drawing = draw(decorations, scene.state);
        ASSERT_TRUE(scene.cable.isTouched(scene.state, scene.obstacle));
        ASSERT_EQ(drawing.meshes.size(), 1u);
        const ShotGeodesic& arc = scene.cable.getSolution(scene.state).contacts[scene.obstacle].geodesic;
        for (const Vector3& p : {arc.P.x, arc.Q.x}) {
            EXPECT_GT(p.norm(), 10 * one.surface->getSize());
            EXPECT_LT(calcDistance(drawing.meshes[0], toSimTK(p)), 0.1 * one.surface->getSize());
        }
    }
    OneObstacleScene scene(std::make_shared<Cylinder>(0.2), along, V(7, 0, -2), V(7.3, 0, 2));
    EXPECT_GT(draw(scene.cables, scene.state, 0).cylinderHalfLength, 7);
    EXPECT_EQ(draw(CableDecorations(scene.cables).setExtent(50), scene.state).cylinderHalfLength, 10);
    EXPECT_MESSAGE(CableDecorations(scene.cables).setExtent(0), "positive and finite, but is 0");
}

/** Two obstacles of one surface, touched far out on either side. */
TEST(CableDecorationsTest, ASharedSurfaceIsDrawnForAllOfItsObstacles) {
    BareScene scene;
    const auto surface = std::make_shared<EllipticCylinder>(0.2, 0.3);
    const SimTK::Rotation along(SimTK::Pi / 2, SimTK::YAxis);  // z of S along x of ground
    std::vector<Cable> cables;
    for (const Real x : {-6.0, 6.0}) {
        cables.emplace_back(scene.cables, scene.matter.Ground(), SimTK::Vec3(x, 0.1, -2), scene.matter.Ground(),
                            SimTK::Vec3(x, 0.1, 2));
        cables.back().addObstacle(scene.matter.Ground(), Transform(along, SimTK::Vec3(0, -0.1, 0)), surface);
    }
    const State state = scene.system.realizeTopology();
    CableDecorations decorations(scene.cables);
    draw(decorations, state);
    Drawing drawing = draw(decorations, state);
    ASSERT_EQ(drawing.meshes.size(), 2u);
    for (const Cable& cable : cables) {
        ASSERT_TRUE(cable.isTouched(state, CableElementIndex(1)));
        const ShotGeodesic& arc = cable.getSolution(state).contacts[1].geodesic;
        for (const SimTK::PolygonalMesh& mesh : drawing.meshes)
            EXPECT_LT(calcDistance(mesh, toSimTK(arc.P.x)), 0.1 * surface->getSize());
    }
    EXPECT_TRUE(areOne(drawing.meshes[0], drawing.meshes[1]));
}

TEST(CableDecorationsTest, MeshesAreLaidOnce) {
    OneObstacleScene scene(std::make_shared<Capsule>(0.1, 0.4), Transform(), SimTK::Vec3(-2, 1, 0),
                           SimTK::Vec3(2, 1, 0));
    CableDecorations decorations(scene.cables);
    Drawing first = draw(decorations, scene.state), second = draw(decorations, scene.state);
    ASSERT_EQ(first.meshes.size(), 1u);
    ASSERT_EQ(second.meshes.size(), 1u);
    EXPECT_TRUE(areOne(first.meshes[0], second.meshes[0]));
}

TEST(CableSubsystemDecorations, AreDrawnWithTheSystemUnlessToldNotTo) {
    MechanismScene scene;
    const State state = scene.makeState(0);
    scene.system.realize(state, Stage::Position);
    const auto countLines = [&] {
        SimTK::Array_<SimTK::DecorativeGeometry> geometry;
        for (Stage stage = Stage::Topology; stage <= Stage::Position; stage = stage.next())
            scene.system.calcDecorativeGeometryAndAppend(state, stage, geometry);
        return Drawing(geometry).lines;
    };
    EXPECT_TRUE(scene.cables.getShowDecorations());
    const int shown = countLines();
    scene.cables.setShowDecorations(false);  // the bodies draw lines too
    EXPECT_EQ(shown - countLines(), static_cast<int>(scene.cable.calcDrawingPoints(state).size()) - 1);
}

}  // namespace
}  // namespace tautline::testing
