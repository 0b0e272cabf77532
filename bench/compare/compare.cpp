// SPDX-License-Identifier: Apache-2.0
/** Tautline beside those that people use: one run, one machine, one table of ratios. README.md of the folder above says
what each row is. */
#include <CLI/CLI.hpp>
#include <iostream>

#include "cost_curve.h"
#include "fitted_paths.h"
#include "text_table.h"
#include "weave.h"

namespace {

using namespace tautline;
using namespace tautline::compare;

/** A scene, and who solves it. */
struct Match {
    std::string scene;
    Kind kind;
    int count;
    double tolerance;
    bool hasPointsBetween;
    bool hasCablePath;  ///< which takes minutes over many surfaces
};

std::vector<Match> listMatches() {
    std::vector<Match> matches{
        {"5 cylinders", Kind::Cylinders, 5, 1e-3, false, true},
        {"5 cylinders", Kind::Cylinders, 5, 1e-9, false, true},
        {"20 cylinders", Kind::Cylinders, 20, 1e-3, false, true},
        {"50 cylinders", Kind::Cylinders, 50, 1e-3, false, false},
        {"5 ellipsoids", Kind::Ellipsoids, 5, 1e-3, false, true},
        {"5 ellipsoids", Kind::Ellipsoids, 5, 1e-9, false, true},
    };
#if TAUTLINE_HAS_MUJOCO
    matches.push_back({"5 cylinders, points between", Kind::Cylinders, 5, 1e-3, true, false});
    matches.push_back({"50 cylinders, points between", Kind::Cylinders, 50, 1e-3, true, false});
    matches.push_back({"5 spheres, points between", Kind::Spheres, 5, 1e-3, true, false});
    matches.push_back({"5 cylinders, points between", Kind::Cylinders, 5, 1e-9, true, false});
    matches.push_back({"5 spheres, points between", Kind::Spheres, 5, 1e-9, true, false});
#endif
    return matches;
}

std::vector<Contestant> listContestants(const Match& match, const WeaveRow& row) {
    std::vector<Contestant> contestants;
    if (match.hasPointsBetween) {
        contestants.push_back(makeCoreWithForces(row, match.tolerance));
#if TAUTLINE_HAS_MUJOCO
        contestants.push_back(makeMujoco(row));
#endif
        return contestants;
    }
    contestants.push_back(makeCore(row, match.tolerance));
    contestants.push_back(makeThroughSimbody(row, match.tolerance));
    if (match.hasCablePath) contestants.push_back(makeCablePath(row));
#if TAUTLINE_SIMBODY_HAS_CABLE_SPAN
    contestants.push_back(makeCableSpan(row, match.tolerance, true));
    contestants.push_back(makeCableSpan(row, match.tolerance, false));
#endif
    return contestants;
}

void compareWeaves(int numPoses, int numRounds) {
    TextTable table;
    table.addColumn("scene", "", true);
    table.addColumn("tol");
    table.addColumn("way", "", true);
    table.addColumn("us/surface");
    table.addColumn("ratio");
    table.addColumn("to", "", true);
    table.addColumn("most off", "[m]");
    for (const Match& match : listMatches()) {
        const WeaveRow row(match.kind, match.count, numPoses, match.hasPointsBetween);
        std::vector<Contestant> contestants = listContestants(match, row);
        runRounds(contestants, row.lengths, numRounds);
        bool isFirst = true;
        for (const Contestant& contestant : contestants) {
            const double each = contestant.calcMicroseconds(numPoses);
            std::string ratio;
            if (contestant.rival)
                ratio = format(each / findContestant(contestants, contestant.rival).calcMicroseconds(numPoses), 1);
            table.addRow({isFirst ? match.scene : "", isFirst ? format(match.tolerance, 0, true) : "", contestant.way,
                          format(each / match.count, 2), ratio, contestant.rival ? contestant.rival : "",
                          format(contestant.error, 1, true)});
            isFirst = false;
        }
    }
    table.print(std::cout);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Tautline beside CablePath, CableSpan, MuJoCo and fitted polynomials");
    int numPoses = 400, numRounds = 5;
    std::vector<std::string> fitted;
    std::string curve;
    app.add_option("--poses", numPoses, "of each scene")->check(CLI::Range(2, 100000))->capture_default_str();
    app.add_option("--rounds", numRounds, "of which the quickest counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--fitted", fitted,
                   "MODEL MOTION FUNCTIONS: files of a model, of a motion, and of FunctionBasedPaths")
        ->expected(3)
        ->check(CLI::ExistingFile);
    app.add_option("--curve", curve, "FILE.svg: cost against the number of surfaces, as a table and a picture");
    CLI11_PARSE(app, argc, argv);
    try {
        compareWeaves(numPoses, numRounds);
        if (!fitted.empty()) compareFittedPaths(fitted[0], fitted[1], fitted[2], numRounds, std::cout << "\n");
        if (!curve.empty()) drawCostCurve(numRounds, curve, std::cout << "\n");
    } catch (const std::exception& error) {
        std::cerr << "compare: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
