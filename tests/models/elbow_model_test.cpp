// SPDX-License-Identifier: Apache-2.0
/** Our own arm: models/elbow.osim. */
#include <cmath>
#include <iostream>

#include "model_test_support.h"
#include "tautline/models/path_points.h"
#include "tautline/simbody/conversions.h"

namespace tautline::models::testing {
namespace {

std::filesystem::path findModel() {
    return std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "elbow.osim";
}

/** The point in the frame of the wrap object. */
SimTK::Vec3 locateInWrap(const PathPoint& point, const WrapObject& wrap, const BuiltSystem& arm) {
    const SimTK::Vec3 point_G = PlacedPoint(point, arm.model).calcLocation(arm.state);
    const SimTK::Transform X_GW = arm.model.getBody(wrap.body).getBodyTransform(arm.state) * toTransform(wrap.X_BW);
    return ~X_GW * point_G;
}

/** Less than 1 inside the surface. */
double calcDepth(const WrapObject& wrap, const SimTK::Vec3& point_W) {
    if (const auto* cylinder = std::get_if<CylinderShape>(&wrap.shape))
        return std::hypot(point_W[0], point_W[1]) / cylinder->radius;
    const Vector3 axes = std::get<EllipsoidShape>(wrap.shape).semiAxes;
    return std::hypot(point_W[0] / axes[0], point_W[1] / axes[1], point_W[2] / axes[2]);
}

TEST(ElbowModel, HasTwoCoordinatesAndSixMuscles) {
    const ModelDescription model = readOsimFile(findModel());
    EXPECT_EQ(model.bodies.size(), 2u);
    ASSERT_EQ(model.muscles.size(), 6u);
    EXPECT_EQ(model.wrapObjects.size(), 4u);
    EXPECT_EQ(findCoordinate(model, "elbow_flexion")->defaultValue, 0.5);
    EXPECT_TRUE(model.skipped.empty());
}

TEST(ElbowModel, EachWrapIsBoundToOneSegment) {
    const ModelDescription model = readOsimFile(findModel());
    for (const Muscle& muscle : model.muscles) {
        EXPECT_FALSE(muscle.path.wraps.empty()) << muscle.name;
        for (const PathWrap& wrap : muscle.path.wraps) {
            EXPECT_GE(wrap.range[0], 1) << wrap.name;
            EXPECT_EQ(wrap.range[1], wrap.range[0] + 1) << wrap.name;
        }
    }
}

TEST(ElbowModel, NoPointOfAWrappedSegmentLiesInTheWrapObject) {
    BuiltSystem arm(readOsimFile(findModel()));
    double least = 10.0;
    for (double shoulder = -1.0; shoulder < 2.01; shoulder += 0.25) {
        for (double elbow = -1.0; elbow < 2.21; elbow += 0.1) {
            arm.set("shoulder_flexion", shoulder);
            arm.set("elbow_flexion", elbow);
            for (const Muscle& muscle : arm.description.muscles) {
                for (const PathWrap& use : muscle.path.wraps) {
                    const WrapObject& wrap = arm.description.wrapObjects[use.wrapObject];
                    for (int index : use.range) {
                        const auto& point = muscle.path.points[static_cast<std::size_t>(index - 1)];
                        least = std::min(least, calcDepth(wrap, locateInWrap(point, wrap, arm)));
                    }
                }
            }
        }
    }
    std::cout << "least distance of a point, in radii: " << least << "\n";
    EXPECT_GT(least, 1.05);
}

/** The angle that a path in the plane wraps around a circle on a given side; negative if it passes clear of it. The
three wraps at the elbow are cylinders about z, or nearly circular. */
double calcWrapAngle(const SimTK::Vec3& a, const SimTK::Vec3& b, double radius, double turn) {
    const double ra = std::hypot(a[0], a[1]), rb = std::hypot(b[0], b[1]);
    const double between = turn * (std::atan2(b[1], b[0]) - std::atan2(a[1], a[0]));
    const double angle = between - std::acos(radius / ra) - std::acos(radius / rb);
    return std::remainder(angle, 2 * SimTK::Pi);
}

TEST(ElbowModel, WrapsStayOnTheirSideAllTheWay) {
    BuiltSystem arm(readOsimFile(findModel()));
    for (const Muscle& muscle : arm.description.muscles) {
        for (const PathWrap& use : muscle.path.wraps) {
            const WrapObject& wrap = arm.description.wrapObjects[use.wrapObject];
            const auto* cylinder = std::get_if<CylinderShape>(&wrap.shape);
            if (!cylinder) continue;
            // Down the front is clockwise seen from the right, down the back counterclockwise.
            const double turn = wrap.quadrant == Quadrant::PlusX ? -1.0 : 1.0;
            double previous = 0.0;
            for (int step = 0; step <= 320; ++step) {
                arm.set("elbow_flexion", -1.0 + 0.01 * step);
                const auto first = static_cast<std::size_t>(use.range[0] - 1);
                const double angle =
                    calcWrapAngle(locateInWrap(muscle.path.points[first], wrap, arm),
                                  locateInWrap(muscle.path.points[first + 1], wrap, arm), cylinder->radius, turn);
                EXPECT_LT(std::abs(angle), 0.8 * SimTK::Pi) << muscle.name << " step " << step;
                // A step of the elbow turns the path by as much; a jump would change sides.
                const double turned = step > 0 ? std::abs(angle - previous) : 0.01;
                EXPECT_NEAR(turned, 0.01, 1e-9) << muscle.name;
                previous = angle;
            }
        }
    }
}

TEST(ElbowModel, SwingsUnderGravityAndKeepsItsEnergy) {
    BuiltSystem arm(readOsimFile(findModel()));
    SimTK::RungeKuttaMersonIntegrator integrator(arm.system);
    integrator.setAccuracy(1e-8);
    SimTK::TimeStepper stepper(arm.system, integrator);
    stepper.initialize(arm.state);
    arm.system.realize(integrator.getState(), SimTK::Stage::Dynamics);
    const double energy = arm.system.calcEnergy(integrator.getState());
    double lowest = 1.0, highest = 0.0;
    for (int step = 1; step <= 100; ++step) {
        stepper.stepTo(0.01 * step);
        const double elbow = arm.model.getCoordinate(integrator.getState(), "elbow_flexion");
        lowest = std::min(lowest, elbow);
        highest = std::max(highest, elbow);
    }
    arm.system.realize(integrator.getState(), SimTK::Stage::Dynamics);
    std::cout << "elbow from " << lowest << " to " << highest << ", energy changed by "
              << arm.system.calcEnergy(integrator.getState()) - energy << " J\n";
    EXPECT_NEAR(arm.system.calcEnergy(integrator.getState()), energy, 1e-6);
    EXPECT_GT(lowest, -1.0) << "where the wraps are checked";
    EXPECT_LT(highest, 2.2);
}

}  // namespace
}  // namespace tautline::models::testing
