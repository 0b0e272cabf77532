#include "tautline/simbody/cable_decorations.h"

#include "adapter_scenes.h"
#include "tautline/simbody/contact_geometry_surface.h"

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
    void implementCylinderGeometry(const SimTK::DecorativeCylinder& shape) override { addSurface(shape); }
    void implementCircleGeometry(const SimTK::DecorativeCircle&) override { ++others; }
    void implementSphereGeometry(const SimTK::DecorativeSphere& shape) override { addSurface(shape); }
    void implementEllipsoidGeometry(const SimTK::DecorativeEllipsoid& shape) override { addSurface(shape); }
    void implementFrameGeometry(const SimTK::DecorativeFrame& frame) override {
        frames.push_back(frame.getTransform());
    }
    void implementTextGeometry(const SimTK::DecorativeText&) override { ++others; }
    void implementMeshGeometry(const SimTK::DecorativeMesh& shape) override { addSurface(shape); }
    void implementMeshFileGeometry(const SimTK::DecorativeMeshFile&) override { ++others; }
    void implementTorusGeometry(const SimTK::DecorativeTorus& shape) override { addSurface(shape); }
    void implementArrowGeometry(const SimTK::DecorativeArrow&) override { ++others; }
    void implementConeGeometry(const SimTK::DecorativeCone&) override { ++others; }

    void addSurface(const SimTK::DecorativeGeometry& shape) { surfaceColors.push_back(shape.getColor()); }

    int lines = 0, others = 0;
    Real pathLength = 0;
    std::vector<SimTK::Vec3> surfaceColors;
    std::vector<Transform> frames;
};

Drawing draw(const CableSubsystem& cables, const State& state, Real frameSize) {
    SimTK::Array_<SimTK::DecorativeGeometry> geometry;
    CableDecorations(cables).setContactFrameSize(frameSize).generateDecorations(state, geometry);
    return Drawing(geometry);
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

TEST(CableDecorationsTest, TouchedSurfacesHaveTheirColour) {
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

TEST(CableDecorationsTest, AnySmoothGeometryIsDrawn) {
    BareScene scene;
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-2, 0, 0), scene.matter.Ground(),
                SimTK::Vec3(2, 0, 0));
    SimTK::Matrix f(4, 4, Real(0));
    f(1, 1) = 0.1;
    const SimTK::BicubicSurface surface(SimTK::Vec2(-1, -1), SimTK::Vec2(0.5, 0.5), f);
    for (const SimTK::ContactGeometry& geometry :
         {SimTK::ContactGeometry(SimTK::ContactGeometry::Sphere(0.1)),
          SimTK::ContactGeometry(SimTK::ContactGeometry::SmoothHeightMap(surface))})
        cable.addObstacle(scene.matter.Ground(), SimTK::Vec3(0, 0, -1),
                          std::make_shared<ContactGeometrySurface>(geometry));
    const State state = scene.system.realizeTopology();
    EXPECT_EQ(draw(scene.cables, state, 0).surfaceColors.size(), 2u);
}

}  // namespace
}  // namespace tautline::testing
