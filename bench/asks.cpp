// SPDX-License-Identifier: Apache-2.0
/** Random scenes of every way of asking, walked, long, far, wound and grooved ones, each against what is right:
`asks [--family F] [--scenes N] [--seed S] [--examples K]`. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/asked_scenes.h"
#include "support/moving_scenes.h"

namespace {

using namespace tautline;
using namespace tautline::testing;

double calcQuantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

struct Tally {
    std::array<int, kNumOutcomes> counts{};
    int alarms = 0;  ///< found, but said not to follow the hints, or to depend on its history
    std::vector<double> times, shots;

    int get(Outcome outcome) const { return counts[static_cast<int>(outcome)]; }
};

struct TimedSolve {
    double seconds = 0;
    void operator()(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
        const auto start = std::chrono::steady_clock::now();
        solver.solve(problem, pose, path);
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

/** What one family of scenes came to, whole and by kind. */
class Report {
public:
    explicit Report(int examples) : m_examples(examples) {}

    /** @param scene   its seed and numbers, for those that are answered poorly */
    void add(const std::string& family, const std::string& kind, Outcome outcome, const PathSolution& path,
             double seconds, const std::function<std::string()>& scene) {
        for (const std::string& name : {family, family + ", " + kind}) {
            Tally& tally = m_tallies[name];
            ++tally.counts[static_cast<int>(outcome)];
            tally.alarms += outcome == Outcome::Found && (!path.followsHints() || path.dependsOnHistory());
            tally.times.push_back(seconds);
            tally.shots.push_back(path.shots);
        }
        const bool isPoor = outcome == Outcome::Silent || outcome == Outcome::Missed || outcome == Outcome::Unknown;
        if (!isPoor || ++m_shown[kind + getName(outcome)] > m_examples) return;
        std::cout << "  " << family << ", " << kind << ", " << getName(outcome) << ": " << scene() << "; got "
                  << std::setprecision(12) << path.length << std::setprecision(6) << ", "
                  << tautline::getName(path.status) << (path.followsHints() ? "" : ", not where the hints lead")
                  << "\n";
    }

    static void printHead() {
        std::cout << std::left << std::setw(32) << "family" << std::right << std::setw(8) << "scenes";
        for (int i = 0; i < kNumOutcomes; ++i) std::cout << std::setw(9) << getName(static_cast<Outcome>(i));
        std::cout << std::setw(9) << "alarms" << std::setw(9) << "found %" << std::setw(12) << "median us"
                  << std::setw(12) << "99 % us" << std::setw(12) << "largest us" << std::setw(8) << "shots"
                  << std::setw(9) << "99 %" << std::setw(9) << "largest"
                  << "\n";
    }
    void print() const {
        for (const auto& [name, tally] : m_tallies) print(name, tally);
    }

private:
    static void print(const std::string& name, const Tally& tally) {
        std::cout << std::left << std::setw(32) << name << std::right << std::setw(8) << tally.times.size();
        for (const int count : tally.counts) std::cout << std::setw(9) << count;
        const int found = tally.get(Outcome::Found) + tally.get(Outcome::Another);
        const int judged =
            static_cast<int>(tally.times.size()) - tally.get(Outcome::Unknown) - tally.get(Outcome::Said);
        std::cout << std::setw(9) << tally.alarms << std::fixed << std::setprecision(2) << std::setw(9)
                  << (judged ? 100.0 * found / judged : 100.0) << std::setprecision(1);
        for (const double q : {0.5, 0.99, 1.0}) std::cout << std::setw(12) << 1e6 * calcQuantile(tally.times, q);
        std::cout << std::setprecision(0) << std::setw(8) << calcQuantile(tally.shots, 0.5);
        for (const double q : {0.99, 1.0}) std::cout << std::setw(9) << calcQuantile(tally.shots, q);
        std::cout << "\n" << std::defaultfloat << std::setprecision(6);
    }

    int m_examples;
    std::map<std::string, Tally> m_tallies;
    std::map<std::string, int> m_shown;
};

std::string describeSeed(unsigned seed) {
    return "seed " + std::to_string(seed);
}

void askOne(Asking asking, unsigned seed, Report& report) {
    const AskedScene scene = AskedSceneMaker(asking, seed).getScene();
    PathSolver solver;
    PathSolution path;
    TimedSolve solve;
    solve(solver, scene.problem, scene.pose, path);
    report.add(getName(asking), scene.kind, judge(scene, path), path, solve.seconds,
               [&] { return describeSeed(seed) + ", " + scene.description; });
}

/** The continued answer at each pose against the cold one: equal, or one of them says so, by the rule that costs
nothing or by PathSolverOptions::comparesWithCold. */
void walk(unsigned seed, bool comparesWithCold, Report& report) {
    constexpr int kPoses = 1000;
    const WalkedScene scene(seed);
    PathSolverOptions options;
    options.comparesWithCold = comparesWithCold;
    PathSolver solver(options);
    PathSolution walked;
    TimedSolve solve;
    constexpr const char* kKinds[] = {"near", "side", "winding", "hole", "three, no hints", "three, sides"};
    for (int i = 0; i < kPoses; ++i) {
        const PathPose pose = scene.calcPose(static_cast<double>(i) / kPoses);
        solve(solver, scene.getProblem(), pose, walked);
        const PathSolution cold = solvePath(scene.getProblem(), pose);
        const auto isSaid = [](const PathSolution& path) {
            return path.status != PathStatus::Solved || !path.followsHints() || path.dependsOnHistory();
        };
        const bool isEqual = std::abs(walked.length / cold.length - 1) < 1e-9 && walked.status == cold.status;
        const Outcome other = isSaid(walked) || isSaid(cold) ? Outcome::Said : Outcome::Silent;
        report.add(comparesWithCold ? "walk, compared" : "walk", kKinds[seed % 6], isEqual ? Outcome::Found : other,
                   walked, solve.seconds, [&] {
                       return describeSeed(seed) + ", pose " + std::to_string(i) + ", cold " +
                              std::to_string(cold.length);
                   });
    }
}

/** A string in a groove, which is not one arc per surface, may be solved nowhere else, said or not. */
Outcome judgeGroove(const GrooveScene& scene, const PathSolution& path) {
    if (path.status != PathStatus::Solved) return Outcome::Said;
    const double length = scene.calcLength();
    if (!std::isfinite(length)) return Outcome::Unknown;
    if (std::abs(path.length / length - 1) < 1e-4) return Outcome::Found;
    return path.followsHints() ? Outcome::Silent : Outcome::Missed;
}

/** One cold scene, or for the first seed of a run the continued sweep of the insertion. */
void solveGrooves(unsigned seed, Report& report) {
    PathSolver solver;
    TimedSolve solve;
    const auto add = [&](const char* kind, const GrooveScene& scene, PathSolution& path) {
        solve(solver, scene.path.problem, scene.path.pose, path);
        report.add("groove", kind, judgeGroove(scene, path), path, solve.seconds, [&] {
            std::ostringstream text;
            text << describeSeed(seed) << ", from " << scene.path.pose.X_GE[0].p.transpose() << " to "
                 << scene.path.pose.X_GE[3].p.transpose() << ": " << scene.calcLength();
            return text.str();
        });
    };
    SeededRandom random(seed);
    PathSolution cold;
    add("cold",
        GrooveScene(Vector3(random.uniform(0, 0.03), 0.2, random.uniform(-2e-3, 2e-3)),
                    Vector3(random.uniform(-0.1, 0.03), -0.2, random.uniform(-2e-3, 2e-3))),
        cold);
    if (seed % 100 != 1) return;
    PathSolution swept;
    for (int i = 0; i <= 200; ++i)
        add("swept", GrooveScene(Vector3(0.03, 0.2, 0), Vector3(0.03 - 5e-4 * i, -0.2, 0)), swept);
}

/** Long chains without hints, and with the sides of what was found so. */
void solveChains(unsigned seed, Report& report) {
    for (const int count : {10, 20, 30, 60}) {
        const PosedPath chain = UserChain(count, UserChain::Hints::None, seed).getPath();
        PathSolver solver;
        PathSolution free, sided;
        TimedSolve solve;
        solve(solver, chain.problem, chain.pose, free);
        const bool isSolved = free.status == PathStatus::Solved;
        const auto describe = [&] { return describeSeed(seed); };
        const std::string kind = std::to_string(count);
        report.add("chain", kind + ", no hints", isSolved ? Outcome::Found : Outcome::Missed, free, solve.seconds,
                   describe);
        if (!isSolved) continue;
        solve(solver, addSides(chain.problem, free), chain.pose, sided);
        const bool isSaid = sided.status != PathStatus::Solved || !sided.followsHints();
        const bool isSame = sided.status == PathStatus::Solved && std::abs(sided.length / free.length - 1) < 1e-6;
        const Outcome other = isSaid ? Outcome::Missed : Outcome::Another;
        report.add("chain", kind + ", sides", isSame ? Outcome::Found : other, sided, solve.seconds, describe);
    }
}

/** Steps of so many radians, until the drum has turned by a hundred. */
void turnDrum(unsigned, Report& report) {
    const DrumScene drum;
    for (const double step : {0.5, 1.0, 1.3, 1.5, 2.0, 2.5, 3.0}) {
        PathSolver solver;
        PathSolution path;
        TimedSolve solve;
        for (double turned = 0; turned < 100; turned += step) {
            solve(solver, drum.getProblem(), drum.calcPose(turned), path);
            const double length = drum.calcLength(turned);
            const bool isSaid = path.status != PathStatus::Solved || !path.followsHints();
            const bool isFound = !isSaid && std::abs(path.length - length) < 1e-6;
            std::ostringstream kind;
            kind << "steps of " << step;
            report.add("drum", kind.str(),
                       isFound  ? Outcome::Found
                       : isSaid ? Outcome::Missed
                                : Outcome::Silent,
                       path, solve.seconds,
                       [&] { return "turned " + std::to_string(turned) + ": " + std::to_string(length); });
        }
    }
}

/** A scene of obstacles of 3 cm at the origin and shifted: the same to the rounding of the coordinates. */
void shift(unsigned seed, Report& report) {
    const PosedPath near = UserChain(3, UserChain::Hints::None, seed, 0.1).getPath();
    const PathSolution expected = solvePath(near.problem, near.pose);
    if (expected.status != PathStatus::Solved) return;
    for (const double distance : {1e2, 1e4, 1e5}) {
        PosedPath far = near;
        for (Pose& X_GE : far.pose.X_GE) X_GE.p += distance * Vector3(0.6, -0.64, 0.48);
        PathSolver solver;
        PathSolution path;
        TimedSolve solve;
        solve(solver, far.problem, far.pose, path);
        const bool isSame =
            path.status == PathStatus::Solved && std::abs(path.length - expected.length) < 1e-10 + 1e-14 * distance;
        const bool isSaid = path.status != PathStatus::Solved || !path.followsHints();
        std::ostringstream kind;
        kind << distance << " m";
        report.add("far", kind.str(),
                   isSame   ? Outcome::Found
                   : isSaid ? Outcome::Missed
                            : Outcome::Silent,
                   path, solve.seconds,
                   [&] { return describeSeed(seed) + ", at the origin " + std::to_string(expected.length); });
    }
}

struct Family {
    const char* name;
    int mostScenes;
    std::function<void(unsigned seed, Report&)> solve;
};

std::vector<Family> makeFamilies() {
    constexpr int kAny = 1000000000;
    std::vector<Family> families;
    for (const Asking asking : kAskings)
        families.push_back({getName(asking), kAny, [asking](unsigned seed, Report& r) { askOne(asking, seed, r); }});
    families.push_back({"walk", 50, [](unsigned seed, Report& report) {
                            walk(seed, false, report);
                            walk(seed, true, report);
                        }});
    families.push_back({"groove", 672, solveGrooves});
    families.push_back({"chain", 20, solveChains});
    families.push_back({"drum", 1, turnDrum});
    families.push_back({"far", 300, shift});
    return families;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Solves random scenes that are asked for in every way, and counts the answers that are as asked"};
    std::string family;
    int scenes = 300, examples = 0;
    unsigned seed = 1;
    app.add_option("--family", family, "only this one")
        ->check(CLI::IsMember({"near", "side", "winding", "hole", "walk", "groove", "chain", "drum", "far"}));
    app.add_option("--scenes", scenes, "of each family at most")->check(CLI::PositiveNumber);
    app.add_option("--seed", seed, "of the first scene; the next ones follow");
    app.add_option("--examples", examples, "print so many scenes of each kind that are answered poorly");
    CLI11_PARSE(app, argc, argv);
    std::cout << scenes << " scenes of each family at most, from seed " << seed << "\n";
    Report::printHead();
    for (const Family& f : makeFamilies()) {
        if (!family.empty() && family != f.name) continue;
        Report report(examples);
        for (int i = 0; i < std::min(scenes, f.mostScenes); ++i) f.solve(seed + static_cast<unsigned>(i), report);
        report.print();
    }
}
