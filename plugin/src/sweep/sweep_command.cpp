// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_command.h"

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "interruption.h"
#include "progress_bar.h"
#include "run_command.h"
#include "solve_command.h"
#include "sweep/local_pool.h"
#include "sweep/sweep_journal.h"
#include "sweep/sweep_loop.h"
#include "sweep/sweep_table.h"

namespace tautline {
namespace {

/** What the command says of its arguments. @throws CLI::ParseError */
template <class Command>
void tryArguments(std::vector<std::string> arguments) {
    CLI::App app;
    Command command;
    command.declare(app);
    arguments.erase(arguments.begin());                // the name of the command
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app.parse(arguments);
}

void checkRuns(const SweepPlan& plan, const SweepCommand& command) {
    for (int run = 0; run < plan.getNumRuns(); ++run) try {
            const std::vector<std::string> arguments = plan.makeArguments(run, command.modelFile, command.outFolder);
            if (plan.command == "run")
                tryArguments<RunCommand>(arguments);
            else
                tryArguments<SolveCommand>(arguments);
        } catch (const CLI::ParseError& error) {
            throw std::runtime_error(command.sweepFile.string() + ": run " + std::to_string(run) + ": " + error.what());
        }
}

int calcExitCode(const SweepPlan& plan, const std::map<int, SweepResult>& results) {
    const bool isWhole = results.size() == plan.runs.size();
    const bool isGood =
        std::all_of(results.begin(), results.end(), [](const auto& r) { return r.second.exitCode == 0; });
    return isWhole && isGood ? 0 : 3;
}

}  // namespace

void SweepCommand::declare(CLI::App& app) {
    app.option_defaults()->take_last();
    app.add_option("MODEL", modelFile, "model file (.osim)")->required();
    app.add_option("SWEEP", sweepFile, "what varies (.json)")->required();
    app.add_option("--out", outFolder, "folder of the results; a sweep that was begun there goes on")
        ->capture_default_str();
    app.add_option("--jobs", numJobs, "runs at a time; default: as many as the machine has cores")
        ->check(CLI::Range(1, 10000));
    app.add_flag("--retry", retries, "do runs that have failed once more");
}

SweepPlan SweepCommand::readPlan() const {
    SweepPlan plan = readSweepPlan(sweepFile);
    checkRuns(plan, *this);
    return plan;
}

int SweepCommand::run(std::ostream& out, bool isTerminal) const {
    const SweepPlan plan = readPlan();
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    LocalPool pool(plan, modelFile, outFolder, numJobs > 0 ? numJobs : cores);
    return run(plan, pool, out, isTerminal);
}

int SweepCommand::run(const SweepPlan& plan, RunPool& pool, std::ostream& out, bool isTerminal) const {
    SweepJournal journal(outFolder, calcFingerprint(modelFile, sweepFile));
    if (retries) journal.forgetFailed();
    out << plan.getNumRuns() << " runs of " << modelFile.string();
    if (!journal.getResults().empty()) out << ", " << journal.getResults().size() << " of them done before";
    out << "\n";
    ProgressBar bar(out, isTerminal);
    const Interruption interruption;
    const bool isWhole = doRuns(
        plan, journal, pool, [&bar](double share) { bar.show(share); },
        [&interruption] { return interruption.isRequested(); });
    bar.clear();
    const std::vector<std::filesystem::path> files = writeSweepTable(plan, journal.getResults(), outFolder);
    printSweepSummary(plan, journal.getResults(), out);
    out << "results: ";
    for (std::size_t i = 0; i < files.size(); ++i) out << (i ? ", " : "") << files[i].string();
    out << "\n";
    if (isWhole) return calcExitCode(plan, journal.getResults());
    out << "interrupted; the same command goes on from here\n";
    return 130;
}

}  // namespace tautline
