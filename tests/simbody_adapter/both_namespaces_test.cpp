// SPDX-License-Identifier: Apache-2.0
/** A file that uses both namespaces, with every public header of the core and the adapter (all_headers.h is made of
them by CMake). Names that both have would be ambiguous here, so that this file would not compile. */
#include <Simbody.h>
#include <gtest/gtest.h>

#include "all_headers.h"

using namespace SimTK;
using namespace tautline;

namespace {

TEST(BothNamespaces, ServeOneProgram) {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    GeneralForceSubsystem forces(system);
    CablePathSubsystem cables(system);
    const Body::Rigid body(MassProperties(1, Vec3(0), UnitInertia(1)));
    MobilizedBody::Slider slider(matter.Ground(), Transform(Vec3(0, 0, 0)), body, Transform());

    Cable cable(cables, matter.Ground(), Vec3(-2, 0, 0), matter.Ground(), Vec3(2, 0, 0));
    const CableElementIndex drum = cable.addObstacle(slider, Transform(Vec3(0, -0.3, 0)), std::make_shared<Cylinder>(0.5),
                                                     PassOnSide{Vector3(0, 1, 0)});
    CableSpringForce spring(forces, cable, 100, 4, 0.1);

    State state = system.realizeTopology();
    system.realize(state, Stage::Velocity);
    EXPECT_GT(cable.getLength(state), 4);
    EXPECT_GT(cable.getArcLength(state, drum), 0);
}

TEST(BothNamespaces, NamesThatWereInBothMeanSimbodys) {
    const Vec2 two(1, 2);
    const Vec3 three(1, 2, 3);
    const Vec4 four(1, 2, 3, 4);
    const Geo::Point point(three);
    const Plane plane(Vec3(0, 0, 1), 0.5);
    const Geodesic geodesic;
    const GeodesicOptions options;
    EXPECT_EQ(two.size() + three.size() + four.size(), 9);
    EXPECT_NEAR(plane.getDistance(three), 2.5, 1e-15);
    EXPECT_EQ(geodesic.getNumPoints(), 0);
    EXPECT_TRUE(dynamic_cast<const Surface*>(std::make_shared<HalfSpace>(1.0).get()));
    static_cast<void>(point);
    static_cast<void>(options);
}

}  // namespace
