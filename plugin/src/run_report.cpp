// SPDX-License-Identifier: Apache-2.0
#include "run_report.h"

#include <iomanip>
#include <map>
#include <sstream>

namespace tautline {
namespace {

std::string format(double value, int digits, bool isScientific = false) {
    std::ostringstream text;
    text << (isScientific ? std::scientific : std::fixed) << std::setprecision(digits) << value;
    return text.str();
}

/** How the muscles of each type are computed, and notes, each with the muscles that it is of. */
void printMuscleTypes(const models::ModelDescription& description, std::ostream& out) {
    std::map<std::string, int> types;
    std::map<std::string, std::string> notes;
    for (const models::Muscle& muscle : description.muscles) {
        ++types[muscle.type + ": the muscle model of " + muscle.model->getDescription()];
        for (const std::string& note : muscle.notes) notes[note] += (notes[note].empty() ? "" : ", ") + muscle.name;
    }
    for (const auto& [type, count] : types) out << count << " " << type << ", with the file's parameters\n";
    for (const auto& [note, muscles] : notes) out << "note: " << muscles << ": " << note << "\n";
}

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

/** What was left out with one effect: a line for each reason. */
void printSkipped(const models::ModelDescription& description, models::Effect effect, const char* heading,
                  std::ostream& out) {
    std::map<std::string, std::string> listOfReason;
    for (const models::SkippedElements& skipped : description.skipped) {
        if (skipped.effect != effect) continue;
        std::string& list = listOfReason[skipped.reason];
        list += (list.empty() ? "" : ", ") + std::to_string(skipped.count) + " " + skipped.element + " in " +
                skipped.owner + " (line " + std::to_string(skipped.firstLine) + ")";
    }
    if (!listOfReason.empty()) out << heading << ":\n";
    for (const auto& [reason, list] : listOfReason) out << "  " << reason << ": " << list << "\n";
}

}  // namespace

void printModelNotes(const models::ModelDescription& description, const models::ModelSystem& model, std::ostream& out) {
    out << description.fileName << ": model '" << description.name << "', " << description.bodies.size() << " bodies, "
        << model.getModel().getCoordinateNames().size() << " coordinates, " << description.muscles.size() << " muscles";
    if (!description.springs.empty()) out << ", " << description.springs.size() << " path springs";
    if (!description.pathForces.empty()) out << ", " << description.pathForces.size() << " other forces along paths";
    if (!description.bodyForces.empty()) out << ", " << description.bodyForces.size() << " forces without a path";
    out << "\n";
    printSkipped(description, models::Effect::None, "left out, changes nothing", out);
    printSkipped(description, models::Effect::Forces, "left out, changes forces", out);
    printSkipped(description, models::Effect::Motion, "left out, may change poses, lengths and forces", out);
    for (const models::ReadingNote& note : description.notes)
        out << "note: " << description.fileName << ":" << note.line << ": " << note.text << "\n";
    printMuscleTypes(description, out);
    for (const auto& slot : model.getPaths())
        for (const models::BoundWrap& wrap : slot.wraps)
            if (wrap.numElsewhere > 0)
                out << "note: " << slot.name << ": wrap " << wrap.wrap + 1 << " engages on segment " << wrap.segment + 1
                    << " in " << wrap.numEngaged << " sampled poses, on others in " << wrap.numElsewhere
                    << "; it is bound to segment " << wrap.segment + 1 << "\n";
}

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
            << std::setw(10) << summary.statistics.numDegradedSteps << "\n";
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
        if (const long numDegraded = result.summaries[i].statistics.numDegradedSteps; numDegraded > 0)
            out << "warning: " << paths[i].name << ": " << numDegraded << " steps without a verified minimum; first "
                << result.summaries[i].firstDegradation << "\n";
}

void ProgressBar::show(double share) {
    const int percent = static_cast<int>(100 * share);
    if (!m_isShown || percent == m_percent) return;
    m_percent = percent;
    const int filled = percent * 40 / 100;
    m_out << "\r[" << std::string(filled, '#') << std::string(40 - filled, '.') << "] " << percent << " %"
          << std::flush;
}

void ProgressBar::clear() {
    if (m_isShown) m_out << "\r" << std::string(50, ' ') << "\r" << std::flush;
}

}  // namespace tautline
