// SPDX-License-Identifier: Apache-2.0
/** Random scenes of every way of asking, against what is asked: `asks [--family F] [--scenes N] [--seed S]`. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "support/asked_scenes.h"

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
    int alarms = 0;  ///< found, but said not to follow the hints
    std::vector<double> times, shots;

    int get(Outcome outcome) const { return counts[static_cast<int>(outcome)]; }
};

void printHead() {
    std::cout << std::left << std::setw(30) << "asked" << std::right << std::setw(8) << "scenes";
    for (int i = 0; i < kNumOutcomes; ++i) std::cout << std::setw(9) << getName(static_cast<Outcome>(i));
    std::cout << std::setw(9) << "alarms" << std::setw(10) << "found %" << std::setw(12) << "median us" << std::setw(12)
              << "99 % us" << std::setw(10) << "shots" << std::setw(10) << "99 %\n";
}

void print(const std::string& name, const Tally& tally) {
    std::cout << std::left << std::setw(30) << name << std::right << std::setw(8) << tally.times.size();
    for (const int count : tally.counts) std::cout << std::setw(9) << count;
    const int found = tally.get(Outcome::Found) + tally.get(Outcome::Another);
    const int judged = static_cast<int>(tally.times.size()) - tally.get(Outcome::Unknown) - tally.get(Outcome::Said);
    std::cout << std::setw(9) << tally.alarms << std::fixed << std::setprecision(2) << std::setw(10)
              << (judged ? 100.0 * found / judged : 100.0) << std::setprecision(1) << std::setw(12)
              << 1e6 * calcQuantile(tally.times, 0.5) << std::setw(12) << 1e6 * calcQuantile(tally.times, 0.99)
              << std::setprecision(0) << std::setw(10) << calcQuantile(tally.shots, 0.5) << std::setw(9)
              << calcQuantile(tally.shots, 0.99) << "\n"
              << std::defaultfloat << std::setprecision(6);
}

void report(Asking asking, int scenes, unsigned seed, int examples) {
    std::map<std::string, Tally> tallies;
    std::map<std::string, int> shown;
    std::string text;
    PathSolver solver;
    for (int i = 0; i < scenes; ++i) {
        const unsigned sceneSeed = seed + static_cast<unsigned>(i);
        const AskedScene scene = AskedSceneMaker(asking, sceneSeed).getScene();
        PathSolution path;
        const auto start = std::chrono::steady_clock::now();
        solver.solve(scene.problem, scene.pose, path);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        const Outcome outcome = judge(scene, path);
        for (const std::string& name : {std::string(getName(asking)), getName(asking) + (", " + scene.kind)}) {
            Tally& tally = tallies[name];
            ++tally.counts[static_cast<int>(outcome)];
            tally.alarms += outcome == Outcome::Found && !path.followsHints();
            tally.times.push_back(elapsed.count());
            tally.shots.push_back(path.shots);
        }
        const std::string key = scene.kind + getName(outcome);
        const bool isPoor = outcome == Outcome::Silent || outcome == Outcome::Missed || outcome == Outcome::Unknown;
        if (!isPoor || ++shown[key] > examples) continue;
        std::cout << "  seed " << sceneSeed << ", " << getName(outcome) << ": " << scene.description << "; got "
                  << std::setprecision(12) << path.length << std::setprecision(6) << ", "
                  << tautline::getName(path.status) << (path.followsHints() ? "" : ", not where the hints lead")
                  << "\n";
    }
    for (const auto& [name, tally] : tallies) print(name, tally);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Solves random scenes that are asked for in every way, and counts the answers that are as asked"};
    std::string family;
    int scenes = 300, examples = 0;
    unsigned seed = 1;
    app.add_option("--family", family, "only this one: near, side, winding or hole");
    app.add_option("--scenes", scenes, "of each family")->check(CLI::PositiveNumber);
    app.add_option("--seed", seed, "of the first scene; the next ones follow");
    app.add_option("--examples", examples, "print so many scenes of each kind that are answered poorly");
    CLI11_PARSE(app, argc, argv);
    std::cout << scenes << " scenes of each family from seed " << seed << "\n";
    printHead();
    for (const Asking asking : kAskings)
        if (family.empty() || family == getName(asking)) report(asking, scenes, seed, examples);
}
