// SPDX-License-Identifier: Apache-2.0
#include "run_command.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "command_options.h"
#include "earlier_run.h"
#include "interruption.h"
#include "model_report.h"
#include "name_pattern.h"
#include "plots.h"
#include "progress_bar.h"
#include "run_report.h"
#include "run_watcher.h"
#include "simulation.h"
#include "tautline/models/external_loads.h"
#include "tautline/models/osim_reader.h"
#include "visualizer.h"

namespace tautline {

namespace {

constexpr double kLatestStart = 1e6;  ///< [s], either way: doubles still tell 1e-10 s apart there

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

/** Has coordinates stay where they begin. */
void lockCoordinates(const std::vector<std::string>& patterns, models::ModelDescription& description) {
    std::vector<std::string> names;
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates) names.push_back(coordinate.name);
    requireMatches(patterns, names, "--lock");
    for (models::Joint& joint : description.joints)
        for (models::Coordinate& coordinate : joint.coordinates)
            if (matchesAny(coordinate.name, patterns)) {
                coordinate.locked = true;
                coordinate.prescribedMotion.reset();
            }
}

void printEnding(const SimulationEnding& ending, double end, std::ostream& out) {
    if (ending.kind == SimulationEnding::Kind::Interrupted)
        out << "interrupted at " << toText(ending.time) << " of " << toText(end)
            << " s; the results up to there are written\n";
    if (ending.kind == SimulationEnding::Kind::Stuck)
        out << "warning: the simulation ended at " << toText(ending.time) << " of " << toText(end)
            << " s: " << ending.reason << "; the results up to there are written\n";
}

}  // namespace

void RunCommand::declare(CLI::App& app) {
    addModelOptions(app, modelFile, ignored, settings);
    CLI::Option* duration =
        app.add_option("--duration", simulation.duration, "time to simulate [s]")->capture_default_str();
    app.add_option("--from", startTime, "time at which to begin [s]; default: 0, or the first row of --states");
    app.add_option("--to", endTime, "time at which to end [s], in place of --duration")->excludes(duration);
    app.add_option("--out", outFolder, "folder of the results, made if missing")->capture_default_str();
    app.add_option("--states", statesFile,
                   "states file (.sto): begin with its row at the time of --from, or with its first");
    app.add_flag("--resume", resumes,
                 "go on from where an interrupted run into the folder of --out has ended; other options as then");
    addRepeatable(app, "--pose", pose,
                  "coordinate at the start, NAME=VALUE in rad or m (30deg: degrees), over the states file");
    addRepeatable(app, "--speed", speeds, "its speed at the start, NAME=VALUE in rad/s or m/s");
    addRepeatable(app, "--lock", locked, "coordinates that stay where they begin, by name or pattern");
    app.add_option("--gravity", gravity, "gravity in ground, three numbers [m/s^2], in place of the model's")
        ->expected(3)
        ->allow_extra_args(false);
    addRepeatable(app, "--excitation", excitations.assignments,
                  "constant excitation, NAME=VALUE in [0, 1], of all muscles that match NAME; names win "
                  "over patterns, the last pattern over those before; 0.05 for all others");
    app.add_option(
        "--excitations", excitations.file,
        "controls file with a column (.sto) or control (.xml) of excitations per muscle; its others are not used");
    app.add_option("--external-loads", externalLoadsFile,
                   "file of ExternalLoads (.xml) with measured forces, such as the ground's");
    app.add_option("--interval", simulation.interval, "time between rows of the results [s]")->capture_default_str();
    app.add_option("--accuracy", simulation.accuracy, "accuracy of the integrator, in [1e-14, 0.1]")
        ->capture_default_str();
    app.add_flag("--all", simulation.recordsAllArms,
                 "moment arms of all paths about all coordinates, not only those that a path crosses");
    app.add_flag("--allow-degraded", allowsDegraded, "exit with 0 even if some steps had no verified shortest path");
    page.declare(app, "the run: model, paths, curves, events, statuses");
    app.add_flag("--visualize", visualizes, "watch the run in a window of Simbody's visualizer (simbody-visualizer)");
    app.add_flag("--plot", drawsCurves, "draw the results with gnuplot: a picture (.svg) of each path's curves");
}

models::ModelDescription RunCommand::readModel() const {
    models::ModelDescription description = models::readOsimFile(modelFile, {ignored, false, settings});
    lockCoordinates(locked, description);
    if (gravity.empty()) return description;
    description.gravity = Vector3(gravity[0], gravity[1], gravity[2]);
    if (!description.gravity.allFinite())
        throw std::runtime_error("--gravity is " + toText(gravity[0]) + " " + toText(gravity[1]) + " " +
                                 toText(gravity[2]) + ", but must be finite");
    return description;
}

InitialState RunCommand::makeInitialState(const models::ModelDescription& description,
                                          std::vector<std::string>& notes) const {
    InitialState initial;
    if (resumes) {
        const std::filesystem::path file = outFolder / "states.sto", contacts = outFolder / "contacts.csv";
        initial = readStates(file, description, readStorage(file).rows.back()[0], notes);
        if (std::filesystem::exists(contacts))
            initial.contacts = readContacts(contacts);
        else
            notes.push_back(contacts.string() + " is missing: where paths touch obstacles is found anew");
        return initial;
    }
    if (!statesFile.empty()) initial = readStates(statesFile, description, startTime, notes);
    if (startTime) initial.time = *startTime;
    if (!(std::abs(initial.time) <= kLatestStart))
        throw std::runtime_error("the simulation would begin at " + toText(initial.time) +
                                 " s, but must begin within 1e6 s of 0");
    for (const CoordinateValue& given : parseCoordinateValues(pose, "--pose", description))
        initial.values[given.name] = given.value;
    for (const CoordinateValue& given : parseCoordinateValues(speeds, "--speed", description))
        initial.speeds[given.name] = given.value;
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates)
            if (coordinate.locked) initial.speeds[coordinate.name] = 0.0;
    return initial;
}

SimulationOptions RunCommand::makeOptions(double start, const std::optional<EarlierRun>& earlier) const {
    SimulationOptions options = simulation;
    if (!endTime) {
        if (earlier) options.duration -= start - earlier->getStart();
        return options;
    }
    if (!(*endTime > start))
        throw std::runtime_error("--to is " + toText(*endTime) + ", but must be after the start at " + toText(start) +
                                 " s");
    options.duration = *endTime - start;
    return options;
}

void RunCommand::addExternalLoads(const models::ModelDescription& description, models::ModelSystem& model,
                                  std::ostream& out) const {
    if (externalLoadsFile.empty()) return;
    const models::ExternalLoads loads = models::readExternalLoads(externalLoadsFile, description);
    const std::filesystem::path table = externalLoadsFile.parent_path() / loads.dataFile;
    const StorageTable data = readStorage(table);
    models::addExternalLoads(loads, {data.labels, data.rows}, model.getModel(), model.updForces());
    const auto applied = std::count_if(loads.forces.begin(), loads.forces.end(),
                                       [](const models::ExternalForce& force) { return force.appliesForce; });
    out << "external loads: " << applied << " of " << externalLoadsFile.string() << ", from " << table.string() << ", "
        << toText(data.rows.front()[0]) << " to " << toText(data.rows.back()[0]) << " s\n";
}

bool RunCommand::isDone(const EarlierRun& earlier, std::ostream& out) const {
    const double end = endTime ? *endTime : earlier.getStart() + simulation.duration;
    if (earlier.getEnd() < end - 1e-12 * std::abs(end)) return false;
    out << "nothing to resume: " << (outFolder / "states.sto").string() << " ends at " << toText(earlier.getEnd())
        << " s\n";
    return true;
}

std::vector<std::string> RunCommand::writeResults(const SimulationResult& result) const {
    std::vector<std::string> files;
    const auto add = [&](const char* name) {
        const std::filesystem::path file = outFolder / name;
        files.push_back(file.string());
        return file;
    };
    writeStorage(result.states, add("states.sto"));
    writeStorage(result.paths, add("paths.sto"));
    if (!result.muscleSummaries.empty()) writeStorage(result.muscles, add("muscles.sto"));
    writeStorage(result.clearances, add("clearances.sto"));
    writeWhole(result.events, add("events.csv"));
    writeWhole(result.contacts, add("contacts.csv"));
    if (!result.starts.empty()) writeWhole(result.starts, add("start.csv"));
    return files;
}

int RunCommand::run(std::ostream& out, bool isTerminal) const {
    simulation.validate();
    const models::ModelDescription description = readModel();
    std::vector<std::string> notes;
    std::optional<EarlierRun> earlier;
    if (resumes) earlier = readEarlierRun(outFolder);
    if (earlier && isDone(*earlier, out)) return 0;
    const InitialState initial = makeInitialState(description, notes);
    const SimulationOptions options = makeOptions(initial.time, earlier);
    options.validate();
    models::ModelSystem model(description);
    std::vector<std::string> names;
    for (const auto& slot : model.getMuscles()) names.push_back(slot.name);
    ExcitationOptions given = excitations;
    given.prescribed = findPrescribedExcitations(description);
    int numDefault = 0;
    const auto muscleExcitations = makeExcitations(given, names, numDefault, notes);
    if (drawsCurves) requireGnuplot();
    if (!page.report.empty()) requireReportAssets();
    if (visualizes) findVisualizer();
    printModelSummary(description, out);
    printReadingNotes(description, out);
    printMuscleTypes(description, out);
    for (const std::string& note : notes) out << "note: " << note << "\n";
    if (numDefault > 0)
        out << "excitation: " << kDefaultExcitation << " for "
            << (numDefault == static_cast<int>(names.size()) ? "all " : "") << numDefault << " muscles\n";
    addExternalLoads(description, model, out);
    RunWatcher watcher(page, visualizes, description, model, out);
    std::filesystem::create_directories(outFolder);

    ProgressBar bar(out, isTerminal);
    const Interruption interruption;
    SimulationResult result = simulate(
        model, muscleExcitations, options, [&bar](double share) { bar.show(share); },
        [&watcher](const SimTK::State& state) { watcher.watch(state); }, initial,
        [&interruption] { return interruption.isRequested(); });
    bar.clear();
    if (earlier) earlier->prependTo(result);
    const std::vector<std::string> files = writeResults(result);
    printRunTable(model, result, out);
    out << "results: ";
    for (std::size_t i = 0; i < files.size(); ++i) out << (i ? ", " : "") << files[i];
    out << "\n";
    watcher.finish(result, out);
    printEnding(result.ending, initial.time + options.duration, out);
    if (result.ending.kind == SimulationEnding::Kind::Interrupted) return 130;
    if (drawsCurves) {
        std::string said;
        for (const std::filesystem::path& picture : drawCurves(model, result, outFolder, said))
            out << "curves: " << picture.string() << "\n";
        if (!said.empty()) out << "gnuplot says:\n" << said;
    }
    if (result.ending.kind == SimulationEnding::Kind::Stuck) return 4;
    for (const PathSummary& summary : result.summaries)
        if (summary.degradedSteps > 0 && !allowsDegraded) return 3;
    return 0;
}

}  // namespace tautline
