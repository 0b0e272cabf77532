// SPDX-License-Identifier: Apache-2.0
/** Report on a folder of wrapping scenes with verified answers: `scenes FOLDER [--out FILE] [--no-hints]`. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "support/scene_runner.h"
#include "tautline/paths/path_explanation.h"

namespace {

using namespace tautline;
using namespace tautline::testing;
using nlohmann::json;

constexpr double kRateTolerance = 1e-7;   ///< of dL/dt [m/s]
constexpr double kEventTolerance = 1e-6;  ///< of the time of an event [s]

/** Counts of verdicts for one tag or difficulty. */
struct Tally {
    int total = 0;
    std::map<Verdict, int> counts;

    void add(Verdict verdict) { ++total, ++counts[verdict]; }
    int getCount(Verdict verdict) const {
        const auto entry = counts.find(verdict);
        return entry == counts.end() ? 0 : entry->second;
    }
};

double calcQuantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * (values.size() - 1))];
}

std::string toText(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

json toJson(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

json toJson(const SceneStep& step, const PathPose& pose) {
    json contact = json::array(), segments = json::array();
    for (std::size_t e = 1; e + 1 < step.path.contacts.size(); ++e) {
        const ObstacleContact& c = step.path.contacts[e];
        contact.push_back(c.isTouched);
        if (c.isTouched)
            segments.push_back({{"P", toJson(Vector3(pose.X_GE[e] * c.geodesic.P.x))},
                                {"Q", toJson(Vector3(pose.X_GE[e] * c.geodesic.Q.x))},
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

/** A scene's verdict, with what is not as listed in words. */
struct SceneReport {
    Verdict verdict = Verdict::Solved;
    std::string where;
    double rateError = 0, eventError = 0;  ///< of a moving scene that is as listed at every step

    void worsenTo(Verdict other, const std::string& why) {
        if (other > verdict) verdict = other, where = why;
    }
};

std::string describeStep(const Scene& scene, const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                         std::size_t step, Verdict verdict) {
    return "step " + std::to_string(step) + ": " + getName(verdict) + ", " +
           describe(verifyPath(problem, pose, path), problem) + ", length off by " +
           std::to_string(path.length / scene.length[step] - 1);
}

/** Worst verdict over all steps. A scene may lie in another minimum than the listed one, but may not leave the listed
one on its way: such a step is wrong. */
SceneReport judgeSteps(const Scene& scene, const PathProblem& problem, const SceneResult& result) {
    SceneReport report;
    PathPose pose;
    for (std::size_t k = 0; k < result.steps.size(); ++k) {
        const PathSolution& path = result.steps[k].path;
        calcPose(scene, result.steps[k].t, pose);
        const Verdict verdict = judge(scene, problem, pose, path, static_cast<int>(k), k == 0);
        if (verdict <= report.verdict) continue;
        const bool isLeaving = k > 0 && report.verdict == Verdict::Solved && verdict == Verdict::OtherMinimum;
        report.worsenTo(isLeaving ? Verdict::Wrong : verdict, describeStep(scene, problem, pose, path, k, verdict));
    }
    return report;
}

/** Rates and events of a moving scene whose paths are the listed ones. */
void judgeMotion(const Scene& scene, const SceneResult& result, SceneReport& report) {
    report.rateError = calcLargestRateError(scene, result);
    report.eventError = calcLargestEventError(scene, result);
    if (!(report.rateError < kRateTolerance))
        report.worsenTo(Verdict::Wrong, "rates differ (largest error " + toText(report.rateError) + " m/s)");
    if (!(report.eventError < kEventTolerance))
        report.worsenTo(Verdict::Wrong, "events differ (largest time error " + toText(report.eventError) + " s)");
}

/** There is nothing to judge, but a path that was not found is worth a word. */
SceneReport reportUnlisted(const SceneResult& result) {
    const auto unsolved = std::count_if(result.steps.begin(), result.steps.end(),
                                        [](const SceneStep& step) { return step.path.status != PathStatus::Solved; });
    if (unsolved == 0) return {Verdict::Unlisted, ""};
    return {Verdict::Unlisted, "no listed answer, " + std::to_string(unsolved) + " of " +
                                   std::to_string(result.steps.size()) + " steps not solved"};
}

SceneReport judgeScene(const Scene& scene, const PathProblem& problem, const SceneResult& result) {
    if (!scene.hasAnswer()) return reportUnlisted(result);
    SceneReport report = judgeSteps(scene, problem, result);
    if (scene.isMoving() && report.verdict == Verdict::Solved) judgeMotion(scene, result, report);
    return report;
}

struct Column {
    const char* title;
    int width;
    Verdict verdict;
};

constexpr Column kColumns[] = {
    {"solved", 8, Verdict::Solved},
    {"other", 8, Verdict::OtherMinimum},
    {"groove", 8, Verdict::NoSmoothString},
    {"wrong", 8, Verdict::Wrong},
    {"threw", 8, Verdict::Threw},
    {"not converged", 15, Verdict::NotConverged},
    {"no answer listed", 18, Verdict::Unlisted},
};

void printTallies(const std::map<std::string, Tally>& tallies) {
    std::cout << std::left << std::setw(24) << "tag" << std::right << std::setw(8) << "scenes";
    for (const Column& column : kColumns) std::cout << std::setw(column.width) << column.title;
    std::cout << "\n";
    for (const auto& [name, tally] : tallies) {
        std::cout << std::left << std::setw(24) << name << std::right << std::setw(8) << tally.total;
        for (const Column& column : kColumns) std::cout << std::setw(column.width) << tally.getCount(column.verdict);
        std::cout << "\n";
    }
}

void printTimes(const char* what, const std::vector<double>& times) {
    if (times.empty()) return;
    std::cout << what << ": median " << calcQuantile(times, 0.5) * 1e6 << " us, 99th percentile "
              << calcQuantile(times, 0.99) * 1e6 << " us\n";
}

/** Solves the scenes of one file and tells how they stand to their listed answers. */
class FileReport {
public:
    explicit FileReport(bool withHints) : m_withHints(withHints) {}

    /** @param answers   a list, to which the scene's answer is added, or what was thrown instead */
    void add(const Scene& scene, json& answers) {
        try {
            SceneRunner runner(scene, m_withHints);
            const SceneResult result = runner.run();
            const SceneReport report = judgeScene(scene, runner.getProblem(), result);
            answers.push_back(toJson(scene, result));
            addVerdict(scene, report);
            addFigures(scene, report, result);
        } catch (const std::exception& error) {
            answers.push_back({{"id", scene.id}, {"status", getName(Verdict::Threw)}, {"error", error.what()}});
            addVerdict(scene, {Verdict::Threw, std::string("threw: ") + error.what()});
        }
    }

    void print() const {
        printTallies(m_tallies);
        if (m_all.getCount(Verdict::OtherMinimum) > 0)
            std::cout << "other minima no longer than the listed answer: " << m_numShorter << " of "
                      << m_all.getCount(Verdict::OtherMinimum) << "\n";
        if (hasTooManyOthers()) std::cout << "other minima are more than the 3 in 100 that are allowed\n";
        printTimes("cold solve", m_cold);
        printTimes("warm solve", m_warm);
        if (m_numFollowed > 0)
            std::cout << "largest error of rate " << m_rateError << ", of event times " << m_eventError << " s\n";
    }

    bool isPassed() const {
        return m_all.getCount(Verdict::Wrong) == 0 && m_all.getCount(Verdict::NotConverged) == 0 &&
               m_all.getCount(Verdict::Threw) == 0 && !hasTooManyOthers();
    }

private:
    void addVerdict(const Scene& scene, const SceneReport& report) {
        if (!report.where.empty()) std::cout << scene.id << " (" << scene.difficulty << ") " << report.where << "\n";
        for (const std::string& tag : scene.tags) m_tallies[tag].add(report.verdict);
        m_tallies["[" + scene.difficulty + "]"].add(report.verdict);
        m_tallies["[all]"].add(report.verdict);
        m_all.add(report.verdict);
    }

    void addFigures(const Scene& scene, const SceneReport& report, const SceneResult& result) {
        m_cold.push_back(result.steps.front().time_s);
        for (std::size_t k = 1; k < result.steps.size(); ++k) m_warm.push_back(result.steps[k].time_s);
        if (report.verdict == Verdict::OtherMinimum)
            m_numShorter += result.steps.front().path.length <= scene.length.front() * (1 + 1e-9);
        m_numFollowed += scene.isMoving() && report.verdict == Verdict::Solved;
        m_rateError = std::max(m_rateError, report.rateError);
        m_eventError = std::max(m_eventError, report.eventError);
    }

    /** Which minimum is meant is told by the hints: without them, any will do. */
    bool hasTooManyOthers() const {
        const int judged = m_all.total - m_all.getCount(Verdict::Unlisted);
        return m_withHints && 100 * m_all.getCount(Verdict::OtherMinimum) > 3 * judged;
    }

    bool m_withHints;
    std::map<std::string, Tally> m_tallies;
    Tally m_all;
    std::vector<double> m_cold, m_warm;
    double m_rateError = 0, m_eventError = 0;
    int m_numShorter = 0, m_numFollowed = 0;
};

/** The scene files of a folder. @throws runtime_error if there is none */
std::vector<std::filesystem::path> findSceneFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"static.json", "motion.json"})
        if (std::filesystem::exists(folder / name)) files.push_back(folder / name);
    if (files.empty()) throw std::runtime_error("neither static.json nor motion.json is in '" + folder.string() + "'");
    return files;
}

/** @return true if all scenes passed */
bool report(const std::filesystem::path& file, bool withHints, json& answers) {
    std::cout << "== " << file.filename().string() << (withHints ? "" : ", without hints") << "\n";
    FileReport fileReport(withHints);
    for (const Scene& scene : readScenes(file)) fileReport.add(scene, answers);
    fileReport.print();
    return fileReport.isPassed();
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
        bool isPassed = true;
        for (const std::filesystem::path& file : findSceneFiles(folder))
            isPassed = report(file, !noHints, out["scenes"]) && isPassed;
        if (!outFile.empty()) {
            std::ofstream file(outFile);
            if (!(file << out.dump() << "\n")) throw std::runtime_error("cannot write '" + outFile + "'");
        }
        return isPassed ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "scenes: " << error.what() << "\n";
        return 2;
    }
}
