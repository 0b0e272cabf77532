// SPDX-License-Identifier: Apache-2.0
/** Paths of other kinds than GeometryPath in the reference data: obstacles by contact geometry, lengths by functions.
 */
#include <algorithm>
#include <cmath>
#include <iostream>

#include "model_test_support.h"
#include "support/shared_data.h"
#include "tautline/models/model_system.h"
#include "tautline/paths/path_solver.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::models::testing {
namespace {

struct SurfaceMaker {
    using Result = std::shared_ptr<const Surface>;
    Result operator()(const SphereShape& shape) const { return std::make_shared<Sphere>(shape.radius); }
    Result operator()(const CylinderShape& shape) const { return std::make_shared<Cylinder>(shape.radius); }
    Result operator()(const EllipsoidShape& shape) const { return std::make_shared<Ellipsoid>(shape.semiAxes); }
    Result operator()(const TorusShape& shape) const {
        return std::make_shared<Torus>(shape.ringRadius, shape.tubeRadius);
    }
    Result operator()(const HalfSpaceShape&) const { return nullptr; }
};

const ContactGeometry& findGeometry(const ModelDescription& model, const std::string& name) {
    for (const ContactGeometry& geometry : model.contactGeometries)
        if (geometry.name == name) return geometry;
    throw ModelError("no contact geometry " + name);
}

/** The path of the example, built through the core with the file's obstacles in their order and the file's hints. */
TEST(DataScholz, TheExampleHasThePathOfTheCoreBitForBit) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription description =
        readOsimFile(shared / "data" / "opensim" / "models" / "Scholz2015GeometryPathExample.osim");
    ModelSystem model(description);
    SimTK::State state = model.makeDefaultState();
    model.getSystem().realize(state, SimTK::Stage::Position);
    const Cable& cable = model.getPaths().at(0).cable;
    const MusclePath& path = description.muscles.at(0).path;
    ASSERT_EQ(path.points.size(), 2u);
    ASSERT_EQ(path.wraps.size(), 6u);

    const char* names[] = {"cylinder1", "ellipsoid1", "ellipsoid2", "torus1", "torus2", "sphere1"};
    const auto findPose = [&](const std::string& body) -> const SimTK::Transform& {
        return model.getModel().getBody(body).getBodyTransform(state);
    };
    PathProblem problem;
    PathPose pose;
    const auto addPoint = [&](const PathPoint& point) {
        problem.addPoint(point.name);
        pose.X_GE.emplace_back(toEigen(findPose(point.body) * toSimTK(point.location)));
    };
    addPoint(path.points[0]);
    for (std::size_t i = 0; i < 6; ++i) {
        const ContactGeometry& geometry = findGeometry(description, names[i]);
        EXPECT_EQ(description.wrapObjects.at(path.wraps[i].wrapObject).name, names[i]);
        problem.addObstacle(names[i], std::visit(SurfaceMaker(), geometry.shape), path.wraps[i].hint);
        pose.X_GE.push_back(toPose(findPose(geometry.body) * toTransform(geometry.X_BS)));
    }
    addPoint(path.points[1]);
    const PathSolution solution = solvePath(problem, pose);
    std::cout << "length " << solution.length << " m, " << getName(solution.status) << "\n";
    EXPECT_EQ(cable.getStatus(state), solution.status);
    EXPECT_EQ(solution.status, PathStatus::Solved);
    EXPECT_EQ(cable.getLength(state), solution.length);
}

/** Polynomials that others fitted to OpenSim's lengths. Muscles of the toes are left out, whose joint was welded
elsewhere when they were fitted, and those with two wraps. */
TEST(DataFunctionPaths, AreNearThePathsThatTheyWereFittedTo) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto folder = shared / "data" / "opensim";
    ModelDescription description = readOsimFile(folder / "models" / "subject_walk_scaled.osim");
    const std::vector<OwnedPathFunctions> fitted =
        readFunctionBasedPaths(folder / "reference" / "subject_walk_scaled_FunctionBasedPathSet.xml", description);
    ASSERT_EQ(fitted.size(), 80u);
    ModelSystem model(description);
    SimTK::State state = model.makeDefaultState();
    std::vector<double> errors, rateErrors;
    for (const double share : {0.0, 0.3, 0.6}) {
        const BuiltModel& built = model.getModel();
        for (const char* side : {"_r", "_l"}) {
            built.setCoordinate(state, std::string("hip_flexion") + side, 0.5 - share);
            built.setCoordinate(state, std::string("knee_angle") + side, 0.2 + share);
            built.setCoordinate(state, std::string("ankle_angle") + side, 0.2 * share);
            built.setCoordinateSpeed(state, std::string("hip_flexion") + side, 1.0);
        }
        built.applyCouplers(state);
        model.getSystem().realize(state, SimTK::Stage::Velocity);
        for (const OwnedPathFunctions& each : fitted) {
            const std::string name = each.owner.substr(each.owner.rfind('/') + 1);
            const bool isOfToes = name.substr(1, 2) == "hl" || name.substr(1, 2) == "dl";
            const auto slot = std::find_if(model.getMuscles().begin(), model.getMuscles().end(),
                                           [&](const auto& muscle) { return muscle.name == name; });
            ASSERT_NE(slot, model.getMuscles().end()) << name;
            if (isOfToes || slot->wraps.size() > 1) continue;
            const FunctionBasedPath path(each.functions, built);
            errors.push_back(std::abs(path.calcLength(state) - slot->cable.getLength(state)));
            rateErrors.push_back(std::abs(path.calcLengthRate(state) - slot->cable.getLengthRate(state)));
        }
    }
    std::sort(errors.begin(), errors.end());
    std::sort(rateErrors.begin(), rateErrors.end());
    std::cout << errors.size() << " lengths: median error " << errors[errors.size() / 2] << " m, worst "
              << errors.back() << " m; rates: median " << rateErrors[errors.size() / 2] << " m/s\n";
    EXPECT_LT(errors[errors.size() / 2], 2e-4);
    EXPECT_LT(errors[errors.size() * 9 / 10], 1e-3);
    EXPECT_LT(rateErrors[errors.size() / 2], 2e-3);
}

}  // namespace
}  // namespace tautline::models::testing
