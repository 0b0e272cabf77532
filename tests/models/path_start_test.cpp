// SPDX-License-Identifier: Apache-2.0
/** The first path of models/four_surfaces_*.osim, from geodesics chosen by hand (thesis Sec. 8.3, Fig. 8.4). */
#include <cmath>
#include <iostream>

#include "model_test_support.h"
#include "tautline/error.h"
#include "tautline/models/model_system.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_torus.h"
#include "tautline/surfaces/torus.h"

namespace tautline::models::testing {
namespace {

class FourSurfaces {
public:
    explicit FourSurfaces(const std::string& form)
        : model(readOsimFile(TAUTLINE_SOURCE_DIR "/models/four_surfaces_" + form + ".osim")),
          state(model.makeDefaultState()) {
        model.getSystem().realize(state, SimTK::Stage::Position);
    }
    const ModelSystem::SpringSlot& getView() const { return model.getSprings().at(0); }
    const PathProblem& getProblem() const { return getView().cable.getPathProblem(); }
    const PathPose& getPose() const { return getView().cable.getPathPose(state); }
    IteratedPath iterate() const { return iteratePath(getProblem(), getPose(), getView().start); }
    const Surface& getSurface(const std::string& name) const {
        return *getView().cable.getSurface(getView().cable.findElement(name));
    }

    ModelSystem model;
    SimTK::State state;
};

TEST(FourSurfacesModel, FormsAreThoseThatTheFilesAskFor) {
    const FourSurfaces implicit("implicit"), parametric("parametric");
    EXPECT_NE(dynamic_cast<const Cylinder*>(&implicit.getSurface("over_cylinder")), nullptr);
    EXPECT_NE(dynamic_cast<const Ellipsoid*>(&implicit.getSurface("over_ellipsoid")), nullptr);
    EXPECT_NE(dynamic_cast<const ParametricCylinder*>(&parametric.getSurface("over_cylinder")), nullptr);
    EXPECT_NE(dynamic_cast<const ParametricEllipsoid*>(&parametric.getSurface("over_ellipsoid")), nullptr);
    for (const FourSurfaces* model : {&implicit, &parametric}) {
        EXPECT_NE(dynamic_cast<const ParametricTorus*>(&model->getSurface("through_torus")), nullptr);
        EXPECT_NE(dynamic_cast<const ParametricEllipticTorus*>(&model->getSurface("through_elliptic_torus")), nullptr);
    }
}

TEST(FourSurfacesModel, TheIterationConvergesQuadraticallyFromAnErrorOf1_11) {
    for (const char* form : {"implicit", "parametric"}) {
        SCOPED_TRACE(form);
        const FourSurfaces model(form);
        const IteratedPath iterated = model.iterate();
        const auto& iterations = iterated.iterations;
        EXPECT_NEAR(iterations.front().error, 1.11, 0.005);
        EXPECT_LE(iterations.size(), 6u) << "five iterations";
        EXPECT_LT(iterations.back().error, 1e-12);
        for (std::size_t i = 0; i < iterations.size(); ++i) {
            double sum = 0;
            std::cout << i << ":";
            for (double error : iterations[i].obstacleErrors) sum += error * error, std::cout << " " << error;
            std::cout << " all " << iterations[i].error << "\n";
            EXPECT_NEAR(iterations[i].error, std::sqrt(sum), 1e-15);
            // From here on each error is about 1.5 times the square of the one before.
            if (i < 3) continue;
            EXPECT_LT(iterations[i].error, 2 * std::pow(iterations[i - 1].error, 2)) << i;
        }
    }
}

TEST(FourSurfacesModel, TheSolverGetsThereInFiveIterationsToo) {
    const FourSurfaces model("parametric");
    const PathStart& start = model.getView().start;
    PathSolution path = makePathSolution(start);
    PathSolver().solve(model.getProblem(), model.getPose(), path);
    EXPECT_EQ(path.status, PathStatus::Solved);
    EXPECT_FALSE(path.wasCold);
    EXPECT_LE(path.iterations, 5);
}

/** The problem with a point near each arc of a path as the hint of its obstacle. */
PathProblem hintAlong(PathProblem problem, const PathSolution& path) {
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (path.contacts[e].isTouched)
            problem.setHint(e, PassNear{0.5 * (path.contacts[e].geodesic.P.x + path.contacts[e].geodesic.Q.x)});
    return problem;
}

TEST(FourSurfacesModel, TheStartLeadsToThePathThatIsFoundFromHints) {
    for (const char* form : {"implicit", "parametric"}) {
        SCOPED_TRACE(form);
        const FourSurfaces model(form);
        const IteratedPath iterated = model.iterate();
        PathSolution path = makePathSolution(iterated.start);
        PathSolver().solveKeepingContacts(model.getProblem(), model.getPose(), path);
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_TRUE(verifyPath(model.getProblem(), model.getPose(), path).isMinimum());
        const PathSolution hinted = solvePath(hintAlong(model.getProblem(), path), model.getPose());
        EXPECT_EQ(hinted.status, PathStatus::Solved);
        EXPECT_TRUE(hinted.followsHints());
        EXPECT_NEAR(path.length, hinted.length, 1e-11);
    }
}

TEST(FourSurfacesModel, AStudyContinuesFromAGivenPath) {
    FourSurfaces model("implicit");
    const Cable& cable = model.getView().cable;
    const IteratedPath iterated = model.iterate();
    cable.continueFrom(model.state, makePathSolution(iterated.start));
    cable.resetStatistics();
    EXPECT_TRUE(cable.areContactsFixed(model.state));
    model.model.getSystem().realize(model.state, SimTK::Stage::Position);
    EXPECT_EQ(cable.getStatus(model.state), PathStatus::Solved);
    EXPECT_EQ(cable.getStatistics().numColdSolves, 0);
    EXPECT_THROW(cable.continueFrom(model.state, PathSolution()), InvalidInput);
}

/** A string along x over two rolls beneath it; the far one comes first in the list. */
ModelDescription readTwoRolls(const std::string& order, const std::string& hint = "") {
    const auto makeRoll = [](const std::string& name, const std::string& x) {
        return "<WrapCylinder name=\"" + name + "\"><radius>0.5</radius><length>4</length><translation>" + x +
               " 0 0</translation></WrapCylinder>";
    };
    const auto makePoint = [](const std::string& x) {
        return "<PathPoint name=\"p" + x + "\"><socket_parent_frame>/ground</socket_parent_frame><location>" + x +
               " 0.4 0</location></PathPoint>";
    };
    const std::string ground = "<Ground><WrapObjectSet><objects>" + makeRoll("far", "2") + makeRoll("near", "-2") +
                               "</objects></WrapObjectSet></Ground>";
    const std::string spring = "<ForceSet><objects><PathSpring name=\"s\"><GeometryPath><PathPointSet><objects>" +
                               makePoint("-4") + makePoint("4") + "</objects></PathPointSet>" + order +
                               "<PathWrapSet><objects><PathWrap><wrap_object>far</wrap_object></PathWrap>"
                               "<PathWrap><wrap_object>near</wrap_object>" +
                               hint +
                               "</PathWrap></objects></PathWrapSet></GeometryPath><resting_length>1</resting_length>"
                               "<stiffness>1</stiffness><dissipation>0</dissipation></PathSpring></objects></ForceSet>";
    return readNew(ground + spring);
}

std::string findFirstObstacle(const std::string& order) {
    const ModelSystem model(readTwoRolls(order));
    return model.getSprings().at(0).cable.getElementName(CableElementIndex(1));
}

TEST(WrapOrder, IsByPlaceUnlessTheListSaysOtherwise) {
    EXPECT_EQ(findFirstObstacle(""), "near");
    EXPECT_EQ(findFirstObstacle("<tautline_wraps_in_order>false</tautline_wraps_in_order>"), "near");
    EXPECT_EQ(findFirstObstacle("<tautline_wraps_in_order>true</tautline_wraps_in_order>"), "far");
}

TEST(WrapHint, ChoosesTheSideOnWhichThePathRuns) {
    const auto findHeight = [](const std::string& hint) {
        ModelSystem model(readTwoRolls("", hint));
        const Cable& cable = model.getSprings().at(0).cable;
        SimTK::State state = model.makeDefaultState();
        model.getSystem().realize(state, SimTK::Stage::Position);
        SimTK::Vec3 P_G, Q_G;
        EXPECT_TRUE(cable.getContactPoints(state, cable.findElement("near"), P_G, Q_G));
        return P_G[1];
    };
    EXPECT_GT(findHeight(""), 0.3);
    EXPECT_LT(findHeight("<tautline_hint>0 -0.5 0</tautline_hint>"), 0);
}

}  // namespace
}  // namespace tautline::models::testing
