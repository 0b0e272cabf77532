// SPDX-License-Identifier: Apache-2.0
#include "solve_command.h"

#include <algorithm>
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

}  // namespace

void SolveCommand::declare(CLI::App& app) {
    addModelOptions(app, modelFile, ignored, settings, "name or type of an element, or pattern of columns,");
    app.add_option("--motion", motionFile, "motion or states file (.mot, .sto): solve in each of its frames");
    addRepeatable(app, "--pose", pose,
                  "value of a coordinate, NAME=VALUE in rad or m (30deg: degrees), over the motion's");
    addRepeatable(app, "--muscles", patterns, "only paths whose names match, such as 'rect_fem*'");
    app.add_option("--out", outFolder, "folder of the results, made if missing")->capture_default_str();
    app.add_flag("--allow-degraded", allowsDegraded, "exit with 0 even if some paths are no verified shortest ones");
    page.declare(app, "the poses: model, paths, curves, statuses");
}

int SolveCommand::run(std::ostream& out, bool isTerminal) const {
    const models::ModelDescription description = models::readOsimFile(modelFile, {ignored, true, settings});
    const std::vector<std::string> names = getPathNames(description);
    if (names.empty()) throw std::runtime_error(modelFile.string() + ": the model has no paths");
    requireMatches(patterns, names, "--muscles");
    const std::vector<CoordinateValue> held = parseCoordinateValues(pose, "--pose", description);
    Motion motion;
    if (motionFile.empty())
        motion.poses.resize(1);
    else
        motion = readMotion(motionFile, description, ignored);
    for (models::ModelPose& frame : motion.poses)
        for (const CoordinateValue& given : held) {
            frame.values[given.name] = given.value;
            frame.speeds[given.name] = 0.0;
        }
    if (!page.report.empty()) requireReportAssets();
    models::PathStudy study(description,
                            [this](const std::string& name) { return patterns.empty() || matchesAny(name, patterns); });
    printModelSummary(description, out);
    printReadingNotes(description, out);
    if (!motionFile.empty()) printMotion(motionFile, motion, held, out);
    std::optional<StudyWatcher> watcher;
    if (!page.report.empty()) watcher.emplace(page, description, study, out);

    std::vector<double> times;
    std::vector<models::PoseAnswer> answers;
    ProgressBar bar(out, isTerminal);
    const auto begin = std::chrono::steady_clock::now();
    for (const models::ModelPose& frame : motion.poses) {
        times.push_back(frame.time);
        answers.push_back(study.solve(frame, static_cast<int>(answers.size())));
        if (watcher) watcher->watch(times.back(), answers.back());
        bar.show(static_cast<double>(answers.size()) / static_cast<double>(motion.poses.size()));
    }
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

    if (allowsDegraded) return 0;
    for (const models::PoseAnswer& answer : answers) {
        if (!answer.constraintFault.empty()) return 3;
        for (const models::PathAnswer& path : answer.paths)
            if (!path.isSound()) return 3;
    }
    return 0;
}

}  // namespace tautline
