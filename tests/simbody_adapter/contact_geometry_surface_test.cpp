#include "tautline/simbody/contact_geometry_surface.h"

#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

TEST(ContactGeometrySurfaceTest, IsPositiveOutsideAndAsCurvedAsItsTwin) {
    const ContactGeometrySurface wrapped(SimTK::ContactGeometry::Ellipsoid({1, 2, 3}));
    const Ellipsoid twin(Vec3(1, 2, 3));
    const SurfacePoint point = twin.findSurfacePoint(Vec3(1, 1, 1));
    const Vec3 direction(1, -2, 0.5);
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

TEST(ContactGeometrySurfaceTest, WrapsLikeItsTwin) {
    const auto calcLength = [](std::shared_ptr<const Surface> surface) {
        BareScene scene;
        Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(-2, 0.1, 0.1), scene.matter.Ground(),
                    SimTK::Vec3(2, 0.2, -0.3));
        cable.addObstacle(scene.matter.Ground(), Transform(), std::move(surface), SimTK::Vec3(0, 0.6, 0));
        const State state = scene.system.realizeTopology();
        scene.system.realize(state, Stage::Position);
        EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
        EXPECT_TRUE(cable.isTouched(state, CableElementIndex(1)));
        return cable.getLength(state);
    };
    EXPECT_NEAR(
        calcLength(std::make_shared<ContactGeometrySurface>(SimTK::ContactGeometry::Ellipsoid({0.5, 0.6, 0.7}))),
        calcLength(std::make_shared<Ellipsoid>(Vec3(0.5, 0.6, 0.7))), 1e-9);
}

TEST(ContactGeometrySurfaceTest, RefusesWhatIsNotSmooth) {
    EXPECT_MESSAGE(ContactGeometrySurface(SimTK::ContactGeometry::Brick({1, 1, 1})), "not smooth");
    EXPECT_MESSAGE(ContactGeometrySurface(SimTK::ContactGeometry::Sphere(1), -2),
                   "size must be positive and finite, but is -2");
}

}  // namespace
}  // namespace tautline::testing
