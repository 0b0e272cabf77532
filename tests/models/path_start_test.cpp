/** The first path of models/four_surfaces_*.osim, from geodesics chosen by hand (thesis Sec. 8.3, Fig. 8.4). */
#include <cmath>
#include <iostream>

#include "model_test_support.h"
#include "tautline/ellipsoid.h"
#include "tautline/error.h"
#include "tautline/models/model_system.h"
#include "tautline/parametric_cylinder.h"
#include "tautline/parametric_ellipsoid.h"
#include "tautline/parametric_torus.h"

namespace tautline::models::testing {
namespace {

class FourSurfaces {
public:
    explicit FourSurfaces(const std::string& form)
        : model(readOsimFile(TAUTLINE_SOURCE_DIR "/models/four_surfaces_" + form + ".osim")),
          state(model.makeDefaultState()) {
        model.getSystem().realize(state, SimTK::Stage::Position);
        path = makePathInPose(getView().cable, state);
    }
    const ModelSystem::SpringSlot& getView() const { return model.getSprings().at(0); }
    const Surface& getSurface(const std::string& name) const {
        return *getView().cable.getSurface(getView().cable.findElement(name));
    }

    ModelSystem model;
    SimTK::State state;
    PathInPose path;
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
        const IteratedPath iterated = iteratePath(model.path, model.getView().start);
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
    PathSolution path;
    path.contacts.resize(start.size());
    for (std::size_t e = 0; e < start.size(); ++e) {
        if (!start[e]) continue;
        path.contacts[e].isTouched = true;
        path.contacts[e].start = *start[e];
    }
    PathSolver().solve(model.path.problem, model.path.pose, path);
    EXPECT_EQ(path.status, PathStatus::Solved);
    EXPECT_FALSE(path.wasCold);
    EXPECT_LE(path.iterations, 5);
}

TEST(FourSurfacesModel, TheStartLeadsToThePathThatIsFoundFromHints) {
    for (const char* form : {"implicit", "parametric"}) {
        SCOPED_TRACE(form);
        const FourSurfaces model(form);
        const IteratedPath iterated = iteratePath(model.path, model.getView().start);
        PathSolution path = makePathSolution(model.path, iterated.start);
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_TRUE(verifyPath(model.path.problem, model.path.pose, path).isMinimum());
        EXPECT_NEAR(path.length, model.getView().cable.getLength(model.state), 1e-11);
    }
}

TEST(FourSurfacesModel, AStudyContinuesFromAGivenPath) {
    FourSurfaces model("implicit");
    const Cable& cable = model.getView().cable;
    const IteratedPath iterated = iteratePath(model.path, model.getView().start);
    cable.continueFrom(model.state, makePathSolution(model.path, iterated.start));
    cable.resetStatistics();
    EXPECT_TRUE(cable.areContactsFixed(model.state));
    model.model.getSystem().realize(model.state, SimTK::Stage::Position);
    EXPECT_EQ(cable.getStatus(model.state), PathStatus::Solved);
    EXPECT_EQ(cable.getStatistics().numColdSolves, 0);
    EXPECT_THROW(cable.continueFrom(model.state, PathSolution()), InvalidInput);
}

}  // namespace
}  // namespace tautline::models::testing
