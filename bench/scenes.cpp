/** Report on a folder of wrapping scenes with verified answers: `scenes FOLDER [--out FILE] [--no-hints]`. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>

#include "support/scene_runner.h"
#include "tautline/paths/path_explanation.h"

namespace {

using namespace tautline;
using namespace tautline::testing;
using nlohmann::json;

/** Counts of verdicts for one tag or difficulty. */
struct Tally {
    int total = 0, solved = 0, other = 0, wrong = 0, unconverged = 0;

    void add(Verdict verdict) {
        ++total;
        solved += verdict == Verdict::Solved;
        other += verdict == Verdict::OtherMinimum;
        wrong += verdict == Verdict::Wrong;
        unconverged += verdict == Verdict::NotConverged;
    }
};

double calcQuantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * (values.size() - 1))];
}

json toJson(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

json toJson(const SceneStep& step, const PathPose& pose) {
    json contact = json::array(), segments = json::array();
    for (std::size_t e = 1; e + 1 < step.path.contacts.size(); ++e) {
        const ObstacleContact& c = step.path.contacts[e];
        contact.push_back(c.isTouched);
        if (c.isTouched)
            segments.push_back({{"P", toJson(Vec3(pose.X_GE[e] * c.geodesic.P.x))},
                                {"Q", toJson(Vec3(pose.X_GE[e] * c.geodesic.Q.x))},
                                {"arc", c.start.length}});
        else
            segments.push_back(nullptr);
    }
    return {{"status", getName(step.path.status)},
            {"length", step.path.length},
            {"rate", step.rate},
            {"contact", contact},
            {"segments", segments},
            {"iterations", step.path.iterations},
            {"time_s", step.time_s}};
}

json toJson(const Scene& scene, const SceneResult& result) {
    PathPose pose;
    calcPose(scene, scene.start, pose);
    json out = toJson(result.steps.front(), pose);
    out["id"] = scene.id;
    if (!scene.isMoving()) return out;
    out["steps"] = json::array();
    for (const SceneStep& step : result.steps) {
        calcPose(scene, step.t, pose);
        out["steps"].push_back(toJson(step, pose));
        out["steps"].back()["t"] = step.t;
    }
    out["events"] = json::array();
    for (const FoundEvent& e : result.events)
        out["events"].push_back({{"time", e.time}, {"obstacle", e.obstacle}, {"kind", e.kind}});
    return out;
}

/** Worst verdict over all steps of a scene, with its first failing step in words. */
Verdict judgeScene(const Scene& scene, const PathProblem& problem, const SceneResult& result, std::string& where) {
    PathPose pose;
    for (std::size_t k = 0; k < result.steps.size(); ++k) {
        calcPose(scene, result.steps[k].t, pose);
        const Verdict verdict = judge(scene, problem, pose, result.steps[k].path, static_cast<int>(k), k == 0);
        if (verdict == Verdict::Solved) continue;
        const PathVerification verification = verifyPath(problem, pose, result.steps[k].path);
        where = "step " + std::to_string(k) + ": " + getName(verdict) + ", " + describe(verification, problem) +
                ", length off by " + std::to_string(result.steps[k].path.length / scene.length[k] - 1);
        return verdict;
    }
    return Verdict::Solved;
}

double calcLargestRateError(const Scene& scene, const SceneResult& result) {
    double largest = 0;
    for (std::size_t k = 0; k < scene.rate.size(); ++k)
        largest = std::max(largest, std::abs(result.steps[k].rate - scene.rate[k]));
    return largest;
}

/** Largest difference of event times, or infinity if the lists differ in number, obstacle or kind. */
double calcLargestEventError(const Scene& scene, const SceneResult& result) {
    if (scene.events.size() != result.events.size()) return kInfinity;
    double largest = 0;
    for (std::size_t i = 0; i < scene.events.size(); ++i) {
        const EventTruth& truth = scene.events[i];
        const FoundEvent& found = result.events[i];
        if (truth.obstacle != found.obstacle || truth.kind.substr(0, 4) != found.kind.substr(0, 4)) return kInfinity;
        largest = std::max(largest, std::abs(truth.time - found.time));
    }
    return largest;
}

void printTallies(const std::map<std::string, Tally>& tallies) {
    std::cout << std::left << std::setw(24) << "tag" << std::right << std::setw(8) << "scenes" << std::setw(8)
              << "solved" << std::setw(8) << "other" << std::setw(8) << "wrong" << std::setw(15) << "not converged"
              << "\n";
    for (const auto& [name, tally] : tallies)
        std::cout << std::left << std::setw(24) << name << std::right << std::setw(8) << tally.total << std::setw(8)
                  << tally.solved << std::setw(8) << tally.other << std::setw(8) << tally.wrong << std::setw(15)
                  << tally.unconverged << "\n";
}

void printTimes(const char* what, const std::vector<double>& times) {
    if (times.empty()) return;
    std::cout << what << ": median " << calcQuantile(times, 0.5) * 1e6 << " us, 99th percentile "
              << calcQuantile(times, 0.99) * 1e6 << " us\n";
}

/** Runs all scenes of one file. @return number of wrong or unconverged ones */
int report(const std::vector<Scene>& scenes, bool withHints, json& out) {
    std::map<std::string, Tally> tallies;
    std::vector<double> cold, warm;
    double rateError = 0, eventError = 0;
    int failures = 0, shorter = 0, others = 0;
    for (const Scene& scene : scenes) {
        SceneRunner runner(scene, withHints);
        const SceneResult result = runner.run();
        std::string where;
        const Verdict verdict = judgeScene(scene, runner.getProblem(), result, where);
        if (!where.empty()) std::cout << scene.id << " (" << scene.difficulty << ") " << where << "\n";
        failures += verdict == Verdict::Wrong || verdict == Verdict::NotConverged;
        if (verdict == Verdict::OtherMinimum) {
            ++others;
            shorter += result.steps.front().path.length <= scene.length.front() * (1 + 1e-9);
        }
        for (const std::string& tag : scene.tags) tallies[tag].add(verdict);
        tallies["[" + scene.difficulty + "]"].add(verdict);
        tallies["[all]"].add(verdict);
        cold.push_back(result.steps.front().time_s);
        for (std::size_t k = 1; k < result.steps.size(); ++k) warm.push_back(result.steps[k].time_s);
        if (scene.isMoving() && verdict == Verdict::Solved) {
            rateError = std::max(rateError, calcLargestRateError(scene, result));
            const double error = calcLargestEventError(scene, result);
            if (!(error < 1e-6)) std::cout << scene.id << " events differ (largest time error " << error << " s)\n";
            eventError = std::max(eventError, error);
        }
        out["scenes"].push_back(toJson(scene, result));
    }
    printTallies(tallies);
    if (others > 0)
        std::cout << "other minima no longer than the listed answer: " << shorter << " of " << others << "\n";
    printTimes("cold solve", cold);
    printTimes("warm solve", warm);
    if (!warm.empty())
        std::cout << "largest error of rate " << rateError << ", of event times " << eventError << " s\n";
    return failures;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Solves the wrapping scenes of a folder and compares them with their verified answers"};
    std::string folder, outFile;
    bool noHints = false;
    app.add_option("FOLDER", folder, "folder with static.json and motion.json")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--out", outFile, "write all answers to this JSON file");
    app.add_flag("--no-hints", noHints, "solve without the scenes' hints");
    CLI11_PARSE(app, argc, argv);
    try {
        json out = {{"scenes", json::array()}};
        int failures = 0;
        for (const char* name : {"static.json", "motion.json"}) {
            const std::filesystem::path file = std::filesystem::path(folder) / name;
            if (!std::filesystem::exists(file)) continue;
            std::cout << "== " << name << (noHints ? ", without hints" : "") << "\n";
            failures += report(readScenes(file), !noHints, out);
        }
        if (!outFile.empty()) {
            std::ofstream file(outFile);
            if (!(file << out.dump() << "\n")) throw std::runtime_error("cannot write '" + outFile + "'");
        }
        return failures == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "scenes: " << error.what() << "\n";
        return 2;
    }
}
