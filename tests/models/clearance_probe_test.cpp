// SPDX-License-Identifier: Apache-2.0
/** Signed distances of models/paraboloid.osim against a minimization that knows nothing of Newton's method or charts,
and how they go through touchdown. */
#include "tautline/simbody/clearance_probe.h"

#include <cmath>
#include <iostream>

#include "model_test_support.h"
#include "support/counting_surface.h"
#include "tautline/models/model_system.h"
#include "tautline/surfaces/sphere.h"

namespace tautline::models::testing {
namespace {

const SimTK::Vec3 A_G(-10, 2.5, 0), B_G(10, -1.5, 1);

double calcVertexHeight(double time) {
    return -0.5 - 3 * std::cos(2 * SimTK::Pi * time / 5);
}

class MovingParaboloid {
public:
    explicit MovingParaboloid(const PathSolverOptions& options = {})
        : model(readOsimFile(TAUTLINE_SOURCE_DIR "/models/paraboloid.osim")), probe(cable(), CableElementIndex(1)) {
        Cable(cable()).setOptions(options);
        state = model.makeDefaultState();
    }
    const Cable& cable() const { return model.getSprings().at(0).cable; }

    LineClearance calcClearance(double time) {
        state.setTime(time);
        model.getModel().setDefaultPose(state);
        model.getSystem().realize(state, SimTK::Stage::Velocity);
        return probe.calcClearance(state);
    }

    ModelSystem model;
    SimTK::State state;
    ClearanceProbe probe;
};

/** Least distance between the line A B and z = zv - x^2/14 - y^2/6: one coordinate after the other. */
double findLeastDistance(double vertexHeight) {
    const SimTK::Vec3 e = (B_G - A_G).normalize();
    double s = 10, x = 0, y = 0;
    const auto calcPoint = [&] { return SimTK::Vec3(x, y, vertexHeight - x * x / 14 - y * y / 6); };
    for (int sweep = 0; sweep < 3000; ++sweep) {
        s = ~(calcPoint() - A_G) * e;
        const SimTK::Vec3 D = A_G + s * e;
        // Newton in one variable on the derivative of half the squared distance.
        for (int i = 0; i < 3; ++i) {
            const double r = calcPoint()[2] - D[2];
            x -= (x - D[0] - r * x / 7) / (1 + x * x / 49 - r / 7);
        }
        for (int i = 0; i < 3; ++i) {
            const double r = calcPoint()[2] - D[2];
            y -= (y - D[1] - r * y / 3) / (1 + y * y / 9 - r / 3);
        }
    }
    return (A_G + s * e - calcPoint()).norm();
}

TEST(ClearanceProbe, LiftedItIsTheLeastDistance) {
    MovingParaboloid moving;
    for (double time : {0.0, 0.7, 1.2, 1.5}) {
        const LineClearance clearance = moving.calcClearance(time);
        ASSERT_TRUE(clearance.found);
        EXPECT_FALSE(moving.cable().isTouched(moving.state, CableElementIndex(1)));
        EXPECT_NEAR(clearance.distance, findLeastDistance(calcVertexHeight(time)), 1e-10) << time;
    }
}

TEST(ClearanceProbe, TouchedItIsTheDepthOfTheLineThatWouldBeThere) {
    MovingParaboloid moving;
    for (double time : {1.6, 2.0, 2.5, 3.0}) {
        const LineClearance clearance = moving.calcClearance(time);
        ASSERT_TRUE(clearance.found);
        EXPECT_TRUE(moving.cable().isTouched(moving.state, CableElementIndex(1)));
        // D and C by their definition: D on A B, D - C along the normal of z = zv - x^2/14 - y^2/6 and square to A B.
        const SimTK::Vec3 e = (B_G - A_G).normalize(), D = A_G + clearance.lineCoordinate * e;
        const double x = clearance.C.uv[0], y = -clearance.C.uv[1];  // turned by half a turn about x
        const SimTK::Vec3 C(x, y, calcVertexHeight(time) - x * x / 14 - y * y / 6);
        const SimTK::Vec3 N = SimTK::Vec3(x / 7, y / 3, 1).normalize();
        EXPECT_NEAR(~(D - C) * e, 0, 1e-12) << time;
        EXPECT_NEAR(((D - C) % N).norm(), 0, 1e-12) << time;
        EXPECT_NEAR(clearance.distance, ~(D - C) * N, 1e-12) << time;
        EXPECT_LT(clearance.distance, 0);
    }
}

TEST(ClearanceProbe, IsSmoothThroughTouchdown) {
    MovingParaboloid moving;
    const double h = 1e-3, touchdown = 1.5319361;
    double d[5] = {}, largest = 0;
    for (int k = -50; k <= 50; ++k) {
        for (int i = 0; i < 4; ++i) d[i] = d[i + 1];
        const LineClearance clearance = moving.calcClearance(touchdown + k * h);
        ASSERT_TRUE(clearance.found);
        d[4] = clearance.distance;
        EXPECT_EQ(d[4] < 0, moving.cable().isTouched(moving.state, CableElementIndex(1)));
        if (k < -46) continue;
        // A jump of d by j would show as 6 j/h^4, one of its slope as 3 j/h^3, one of its curvature as j/h^2.
        const double fourth = (d[4] - 4 * d[3] + 6 * d[2] - 4 * d[1] + d[0]) / std::pow(h, 4);
        largest = std::max(largest, std::abs(fourth));
    }
    std::cout << "largest fourth difference quotient " << largest << "\n";
    EXPECT_LT(largest, 20) << "the curvature of d jumps by no more than 2e-5";
}

/** What watches the depth begins with the middle of the arc, which is shot. */
TEST(ClearanceProbe, AnUnchangedPoseCostsNothing) {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter(system);
    CablePathSubsystem cables(system);
    const SimTK::MobilizedBody::Slider slider(matter.Ground(), SimTK::Transform(), SimTK::Body::Massless(),
                                              SimTK::Transform());
    Cable cable(cables, matter.Ground(), SimTK::Vec3(-2, 0, 0), slider, SimTK::Vec3(2, 0, 0));
    const auto surface = std::make_shared<tautline::testing::CountingSurface>(std::make_shared<Sphere>(0.5));
    const CableElementIndex sphere =
        cable.addObstacle(matter.Ground(), SimTK::Vec3(0, -0.4, 0), surface, SimTK::Vec3(0, 0.5, 0));
    ClearanceProbe probe(cable, sphere);
    SimTK::State state = system.realizeTopology();
    const auto countShots = [&] {
        system.realize(state, SimTK::Stage::Position);
        EXPECT_TRUE(cable.isTouched(state, sphere));
        const long before = surface->getNumShots();
        EXPECT_NEAR(probe.calcClearance(state).distance, -0.1, 1e-12);
        return surface->getNumShots() - before;
    };
    EXPECT_GT(countShots(), 0);
    EXPECT_EQ(countShots(), 0);
    state.updU() = 1;
    EXPECT_EQ(countShots(), 0);
    state.setTime(1);  // all is realized anew, in the same pose
    EXPECT_EQ(countShots(), 0);
    slider.setOneQ(state, 0, 0.1);
    EXPECT_GT(countShots(), 0);
}

TEST(ClearanceProbe, FindsTheSameOfACableThatComparesWithColdSolves) {
    PathSolverOptions compared;
    compared.comparesWithCold = true;
    MovingParaboloid plain, moving(compared);
    for (double time : {1.2, 1.6, 2.0})
        EXPECT_NEAR(moving.calcClearance(time).distance, plain.calcClearance(time).distance, 1e-13) << time;
}

}  // namespace
}  // namespace tautline::models::testing
