// SPDX-License-Identifier: Apache-2.0
#include "solve_command.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <stdexcept>

#include "command_options.h"
#include "model_report.h"
#include "motion_file.h"
#include "name_pattern.h"
#include "progress_bar.h"
#include "solve_report.h"
#include "study_tables.h"
#include "study_watcher.h"
#include "tautline/models/osim_reader.h"
#include "tautline/models/parallel_study.h"
#include "text_table.h"

namespace tautline {
namespace {

std::vector<std::string> getPathNames(const models::ModelDescription& description) {
    std::vector<std::string> names;
    for (const auto& muscle : description.muscles) names.push_back(muscle.name);
    for (const auto& spring : description.springs) names.push_back(spring.name);
    for (const auto& force : description.pathForces) names.push_back(force.name);
    return names;
}

void printMotion(const std::filesystem::path& file, const Motion& motion, const std::vector<CoordinateValue>& held,
                 std::ostream& out) {
    out << "motion: " << file.string() << ": " << motion.poses.size() << " frames from "
        << toText(motion.poses.front().time) << " to " << toText(motion.poses.back().time) << " s\n";
    std::vector<std::string> defaults;
    for (const std::string& name : motion.missing) {
        const bool isHeld =
            std::any_of(held.begin(), held.end(), [&](const auto& given) { return given.name == name; });
        if (!isHeld) defaults.push_back(name);
    }
    if (!defaults.empty()) out << "note: not in it and so at their defaults: " << listNames(defaults) << "\n";
    for (const std::string& note : motion.notes) out << "note: " << note << "\n";
}

/** The poses of a motion, or a single one, with the values that are given. */
Motion placeFrames(Motion motion, const std::vector<CoordinateValue>& held) {
    if (motion.poses.empty()) motion.poses.resize(1);
    for (models::ModelPose& frame : motion.poses)
        for (const CoordinateValue& given : held) {
            frame.values[given.name] = given.value;
            frame.speeds[given.name] = 0.0;
        }
    return motion;
}

/** On several threads. */
void solveFrames(models::ParallelStudy& study, const std::vector<models::ModelPose>& frames, int numThreads,
                 ProgressBar& bar, std::vector<models::PoseAnswer>& answers) {
    std::atomic<int> numBegun{0};
    const auto makePose = [&](int place) {
        ++numBegun;
        return frames[static_cast<std::size_t>(place)];
    };
    const auto showProgress = [&] {
        bar.show(static_cast<double>(numBegun) / static_cast<double>(frames.size()));
        return false;
    };
    study.solveMany(static_cast<int>(frames.size()), makePose, answers, {numThreads, showProgress});
}

/** One after the other, each shown to the watcher. */
void watchFrames(models::PathStudy& study, const std::vector<models::ModelPose>& frames, StudyWatcher& watcher,
                 ProgressBar& bar, std::vector<models::PoseAnswer>& answers) {
    for (const models::ModelPose& frame : frames) {
        answers.push_back(study.solve(frame, static_cast<int>(answers.size())));
        watcher.watch(frame.time, answers.back());
        bar.show(static_cast<double>(answers.size()) / static_cast<double>(frames.size()));
    }
}

bool isSound(const models::PoseAnswer& answer) {
    return answer.constraintFault.empty() && std::all_of(answer.paths.begin(), answer.paths.end(),
                                                         [](const models::PathAnswer& path) { return path.isSound(); });
}

}  // namespace

void SolveCommand::declare(CLI::App& app) {
    addModelOptions(app, modelFile, ignored, settings, "name or type of an element, or pattern of columns,");
    app.add_option("--motion", motionFile, "motion or states file (.mot, .sto): solve in each of its frames");
    addRepeatable(app, "--pose", pose,
                  "value of a coordinate, NAME=VALUE in rad or m (30deg: degrees), over the motion's");
    addRepeatable(app, "--muscles", patterns, "only paths whose names match, such as 'rect_fem*'");
    app.add_option("--out", outFolder, "folder of the results, made if missing")->capture_default_str();
    app.add_option("--threads", numThreads, "threads that share the frames; default: as many as there are cores")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--allow-degraded", allowsDegraded, "exit with 0 even if some paths are no verified shortest ones");
    page.declare(app, "the poses: model, paths, curves, statuses");
}

int SolveCommand::run(std::ostream& out, bool isTerminal) const {
    const models::ModelDescription description = models::readOsimFile(modelFile, {ignored, true, settings});
    const std::vector<std::string> names = getPathNames(description);
    if (names.empty()) throw std::runtime_error(modelFile.string() + ": the model has no paths");
    requireMatches(patterns, names, "--muscles");
    const std::vector<CoordinateValue> held = parseCoordinateValues(pose, "--pose", description);
    const Motion motion =
        placeFrames(motionFile.empty() ? Motion() : readMotion(motionFile, description, ignored), held);
    if (!page.report.empty()) requireReportAssets();
    const auto isWanted = [this](const std::string& name) { return patterns.empty() || matchesAny(name, patterns); };
    models::ParallelStudy threads(description, isWanted);
    const models::PathStudy& study = threads.getStudy();
    printModelSummary(description, out);
    printReadingNotes(description, out);
    if (!motionFile.empty()) printMotion(motionFile, motion, held, out);
    std::vector<double> times;
    for (const models::ModelPose& frame : motion.poses) times.push_back(frame.time);
    std::optional<models::PathStudy> watched;  // by one thread, for the page
    std::optional<StudyWatcher> watcher;
    if (!page.report.empty()) {
        watched.emplace(description, isWanted);
        watcher.emplace(page, description, *watched, out);
    }

    std::vector<models::PoseAnswer> answers;
    ProgressBar bar(out, isTerminal);
    const auto begin = std::chrono::steady_clock::now();
    if (watcher)
        watchFrames(*watched, motion.poses, *watcher, bar, answers);
    else
        solveFrames(threads, motion.poses, numThreads, bar, answers);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    bar.clear();

    std::filesystem::create_directories(outFolder);
    writeStorage(makePathTable(study, times, answers), outFolder / "paths.sto");
    writeStorage(makeMomentArmTable(study, times, answers), outFolder / "moment_arms.sto");
    writeStorage(makeCoordinateTable(study, times, answers), outFolder / "coordinates.sto");
    writeWhole(makeStatusText(study, times, answers), outFolder / "statuses.csv");
    printStudy(study, times, answers, out);
    out << answers.size() << (answers.size() == 1 ? " pose" : " frames") << " of " << study.getPaths().size()
        << " paths in " << format(seconds, 3) << " s\n";
    out << "results: " << (outFolder / "paths.sto").string() << ", " << (outFolder / "moment_arms.sto").string() << ", "
        << (outFolder / "coordinates.sto").string() << ", " << (outFolder / "statuses.csv").string() << "\n";
    if (watcher) watcher->finish(times, answers, out);

    return allowsDegraded || std::all_of(answers.begin(), answers.end(), isSound) ? 0 : 3;
}

}  // namespace tautline
