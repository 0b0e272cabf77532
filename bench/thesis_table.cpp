// SPDX-License-Identifier: Apache-2.0
/** The thesis's benchmark (Sec. 8.3, Tab. 8.1): a path over and under 100 to 500 moving cylinders, 40 s, every 0.02 s.
Real-time factor, the time for computing over the time simulated, the largest path error at a step, and the largest
error of the length, against solves to 1e-11. The motions are those of the weave (support/weave_scene.h). */
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/weave_scene.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/elliptic_cylinder.h"

namespace {

using namespace tautline;
using testing::WeaveScene;

struct Form {
    const char* name;
    std::shared_ptr<const Surface> surface;
};

/** Cylinders with their geodesics in closed form, and such whose geodesics are integrated, as the thesis's are. */
std::vector<Form> makeForms() {
    constexpr double r = 0.4;
    return {{"parametric, integrated", std::make_shared<ParametricEllipticCylinder>(r, r)},
            {"implicit, integrated", std::make_shared<EllipticCylinder>(r, r)},
            {"parametric", std::make_shared<ParametricCylinder>(r)},
            {"implicit", std::make_shared<Cylinder>(r)}};
}

struct Row {
    double realTimeFactor = 0, pathError = 0, lengthError = 0, iterations = 0;
    int numUnsolved = 0;
};

std::vector<PathPose> makePoses(const WeaveScene& scene, int numSteps) {
    std::vector<PathPose> poses(static_cast<std::size_t>(numSteps) + 1);
    for (std::size_t k = 0; k < poses.size(); ++k)
        scene.calcPose(static_cast<double>(k) * WeaveScene::kTimeStep, poses[k]);
    return poses;
}

/** Follows the path through the poses. @param onStep   told each path */
template <class OnStep>
double follow(const WeaveScene& scene, const std::vector<PathPose>& poses, double tolerance, double accuracy,
              OnStep onStep) {
    PathSolverOptions options;
    options.pathErrorTolerance = tolerance;
    options.geodesics.accuracy = accuracy;
    PathSolver solver(options);
    PathSolution path = scene.makeGuess();
    solver.solve(scene.getProblem(), poses.front(), path);
    double seconds = 0;
    for (std::size_t k = 1; k < poses.size(); ++k) {
        const auto begin = std::chrono::steady_clock::now();
        solver.solve(scene.getProblem(), poses[k], path);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        onStep(k, path);
    }
    return seconds;
}

Row measure(const Form& form, int numCylinders, int numSteps) {
    const WeaveScene scene(WeaveScene::Kind::Cylinders, numCylinders, form.surface);
    const std::vector<PathPose> poses = makePoses(scene, numSteps);
    std::vector<double> exact(poses.size());
    follow(scene, poses, 1e-11, 1e-12, [&](std::size_t k, const PathSolution& path) { exact[k] = path.length; });
    Row row;
    const double seconds = follow(scene, poses, 1e-3, 1e-3, [&](std::size_t k, const PathSolution& path) {
        row.pathError = std::max(row.pathError, path.pathError);
        row.lengthError = std::max(row.lengthError, std::abs(path.length - exact[k]));
        row.iterations += path.iterations;
        row.numUnsolved += path.status != PathStatus::Solved;
    });
    row.realTimeFactor = seconds / (numSteps * WeaveScene::kTimeStep);
    row.iterations /= numSteps;
    return row;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"The thesis's benchmark of many cylinders, Tab. 8.1"};
    double duration = 40;
    int most = 500;
    app.add_option("--duration", duration, "time to simulate [s]")->capture_default_str()->check(CLI::Range(0.1, 1e4));
    app.add_option("--most", most, "number of cylinders up to which to go")
        ->capture_default_str()
        ->check(CLI::Range(100, 2000));
    CLI11_PARSE(app, argc, argv);
    const int numSteps = static_cast<int>(std::lround(duration / WeaveScene::kTimeStep));
    std::printf("%9s  %-22s  %16s  %10s  %14s  %10s  %8s\n", "cylinders", "form", "real-time factor", "path error",
                "length error/m", "iterations", "unsolved");
    int numUnsolved = 0;
    for (int count = 100; count <= most; count += 100)
        for (const Form& form : makeForms()) {
            const Row row = measure(form, count, numSteps);
            std::printf("%9d  %-22s  %16.5f  %10.1e  %14.1e  %10.2f  %8d\n", count, form.name, row.realTimeFactor,
                        row.pathError, row.lengthError, row.iterations, row.numUnsolved);
            numUnsolved += row.numUnsolved;
        }
    return numUnsolved == 0 ? 0 : 1;
}
