// SPDX-License-Identifier: Apache-2.0
#include "run_command.h"

#include <algorithm>
#include <sstream>

#include "html_report.h"
#include "model_report.h"
#include "plots.h"
#include "progress_bar.h"
#include "run_report.h"
#include "simulation.h"
#include "tautline/models/osim_reader.h"

namespace tautline {

namespace {

/** Those of muscles that a controller of the model drives, kept in [0, 1]. */
std::map<std::string, Excitation> findPrescribedExcitations(const models::ModelDescription& description) {
    std::map<std::string, Excitation> excitations;
    for (const models::PrescribedControl& control : description.controls)
        if (findMuscle(description, control.actuator))
            excitations[control.actuator] = [function = control.control](double time) {
                return std::clamp(function.calcValue(time), 0.0, 1.0);
            };
    return excitations;
}

}  // namespace

void RunCommand::declare(CLI::App& app) {
    app.option_defaults()->take_last();  // so that what a script gives can be overridden
    app.add_option("MODEL", modelFile, "model file (.osim)")->required();
    app.add_option("--ignore", ignored, "name or type of an element to leave out though it is not known; repeatable")
        ->take_all();
    app.add_option("--duration", simulation.duration, "time to simulate [s]")->capture_default_str();
    app.add_option("--out", outFolder, "folder of the results, made if missing")->capture_default_str();
    app.add_option("--excitation", excitations.assignments,
                   "constant excitation of a muscle, NAME=VALUE in [0, 1]; repeatable; 0.05 for all others");
    app.add_option("--excitations", excitations.file, "storage file (.sto) with a column of excitations per muscle");
    app.add_option("--interval", simulation.interval, "time between rows of the results [s]")->capture_default_str();
    app.add_option("--accuracy", simulation.accuracy, "accuracy of the integrator, in [1e-14, 0.1]")
        ->capture_default_str();
    app.add_flag("--allow-degraded", allowsDegraded, "exit with 0 even if some steps had no verified shortest path");
    app.add_option("--report", report,
                   "write a page (.html) to look at the run: model, paths, curves, events, statuses");
    app.add_flag("--plot", drawsCurves, "draw the results with gnuplot: a picture (.svg) of each path's curves");
}

int RunCommand::run(std::ostream& out, bool isTerminal) const {
    simulation.validate();
    const models::ModelDescription description = models::readOsimFile(modelFile, {ignored, false});
    models::ModelSystem model(description);
    std::vector<std::string> names;
    for (const auto& slot : model.getMuscles()) names.push_back(slot.name);
    int numDefault = 0;
    ExcitationOptions given = excitations;
    given.prescribed = findPrescribedExcitations(description);
    const auto muscleExcitations = makeExcitations(given, names, numDefault);
    printModelSummary(description, out);
    printReadingNotes(description, out);
    printMuscleTypes(description, out);
    printWrapNotes(model, out);
    if (numDefault > 0)
        out << "excitation: " << kDefaultExcitation << " for "
            << (numDefault == static_cast<int>(names.size()) ? "all " : "") << numDefault << " muscles\n";
    if (drawsCurves) requireGnuplot();
    std::optional<ReportRecorder> page;
    if (!report.empty()) page.emplace(model, description.gravity);
    std::filesystem::create_directories(outFolder);

    ProgressBar bar(out, isTerminal);
    const SimulationResult result = simulate(
        model, muscleExcitations, simulation, [&bar](double share) { bar.show(share); },
        [&page](const SimTK::State& state) {
            if (page) page->recordFrame(state);
        });
    bar.clear();
    writeStorage(result.states, outFolder / "states.sto");
    writeStorage(result.paths, outFolder / "paths.sto");
    const bool hasMuscles = !names.empty();
    if (hasMuscles) writeStorage(result.muscles, outFolder / "muscles.sto");
    writeStorage(result.clearances, outFolder / "clearances.sto");
    writeWhole(result.events, outFolder / "events.csv");
    if (!result.starts.empty()) writeWhole(result.starts, outFolder / "start.csv");
    printRunTable(model, result, out);
    out << "results: " << (outFolder / "states.sto").string() << ", " << (outFolder / "paths.sto").string() << ", "
        << (hasMuscles ? (outFolder / "muscles.sto").string() + ", " : "") << (outFolder / "clearances.sto").string()
        << ", " << (outFolder / "events.csv").string();
    if (!result.starts.empty()) out << ", " << (outFolder / "start.csv").string();
    out << "\n";
    if (page) {
        std::ostringstream summary;
        printModelSummary(description, summary);
        if (report.has_parent_path()) std::filesystem::create_directories(report.parent_path());
        writeWhole(page->makePage(description.name, summary.str(), result), report);
        out << "page: " << report.string() << "\n";
    }
    if (drawsCurves)
        for (const std::filesystem::path& picture : drawCurves(model, result, outFolder))
            out << "curves: " << picture.string() << "\n";

    for (const PathSummary& summary : result.summaries)
        if (summary.statistics.numDegradedSteps > 0 && !allowsDegraded) return 3;
    return 0;
}

}  // namespace tautline
