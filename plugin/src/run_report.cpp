// SPDX-License-Identifier: Apache-2.0
#include "run_report.h"

#include <algorithm>
#include <iomanip>

#include "text_table.h"

namespace tautline {
namespace {

/** What the muscles' forces rest on where that is far from what was measured. */
void printMuscleNotes(const models::ModelSystem& model, const SimulationResult& result, std::ostream& out) {
    constexpr double kLongFiber = 1.6;  // passive curves are measured up to there, and active force ends near it
    for (std::size_t i = 0; i < model.getMuscles().size(); ++i) {
        const MuscleSummary& summary = result.muscleSummaries[i];
        const std::string& name = model.getMuscles()[i].name;
        if (summary.start.status == EquilibriumStatus::FiberAtLowerBound)
            out << "note: " << name << ": at the start the path is too short for it, the fiber is at its shortest, "
                << (summary.start.tendonForce > 0 ? "the tendon pulls less than the fiber could"
                                                  : "the tendon is slack")
                << "\n";
        if (summary.longestFiber > kLongFiber)
            out << "note: " << name << ": the fiber reaches " << format(summary.longestFiber, 2)
                << " optimal lengths (at " << format(summary.longestAt, 3) << " s); beyond " << kLongFiber
                << " its curves are only continued\n";
    }
}

}  // namespace

void printRunTable(const models::ModelSystem& model, const SimulationResult& result, std::ostream& out) {
    const auto paths = model.getPaths();
    std::size_t width = 6;
    for (const auto& slot : paths) width = std::max(width, slot.name.size());
    const int name = static_cast<int>(width) + 2;
    out << std::left << std::setw(name) << "path" << std::right << std::setw(10) << "length" << std::setw(10) << "rate"
        << std::setw(10) << "tension" << std::setw(13) << "path error" << std::setw(7) << "made" << std::setw(7)
        << "lost" << std::setw(12) << "iterations" << std::setw(10) << "degraded"
        << "\n"
        << std::left << std::setw(name) << "" << std::right << std::setw(10) << "[m]" << std::setw(10) << "[m/s]"
        << std::setw(10) << "[N]" << std::setw(13) << "largest" << std::setw(14) << "contacts" << std::setw(12) << ""
        << std::setw(10) << "steps"
        << "\n";
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto& slot = paths[i];
        const PathSummary& summary = result.summaries[i];
        out << std::left << std::setw(name) << slot.name << std::right << std::setw(10)
            << format(slot.cable.getLength(result.finalState), 5) << std::setw(10)
            << format(slot.cable.getLengthRate(result.finalState), 5) << std::setw(10)
            << format(slot.force.getTension(result.finalState), 3) << std::setw(13)
            << format(summary.statistics.largestPathError, 1, true) << std::setw(7) << summary.contactsMade
            << std::setw(7) << summary.contactsLost << std::setw(12) << summary.statistics.numIterations
            << std::setw(10) << summary.degradedSteps << "\n";
    }
    out << result.acceptedSteps << " steps, " << format(result.seconds, 3) << " s, of which "
        << format(100 * result.wrappingSeconds / std::max(result.seconds, 1e-9), 1) << " % in wrapping\n";
    printMuscleNotes(model, result, out);
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (const PathSummary& summary = result.summaries[i]; summary.slips > 0)
            out << "note: " << paths[i].name << ": " << summary.slips << (summary.slips == 1 ? " slip" : " slips")
                << ", shorter by " << format(summary.slippedLength, 1, true)
                << " m in all; what its force had stored in that length is lost\n";
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (const int switches = result.summaries[i].switches; switches > 0)
            out << "note: " << paths[i].name << ": a wrap object was switched off or on " << switches
                << (switches == 1 ? " time" : " times")
                << ", where a point entered or left it or the path passed beyond its end, as in OpenSim; the length "
                   "jumps there (events.csv)\n";
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (const long numDegraded = result.summaries[i].degradedSteps; numDegraded > 0)
            out << "warning: " << paths[i].name << ": " << numDegraded << " steps without a verified minimum; first "
                << result.summaries[i].firstDegradation << "\n";
}

}  // namespace tautline
