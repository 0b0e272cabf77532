// SPDX-License-Identifier: Apache-2.0
#include "model_report.h"

#include <map>
#include <string>

namespace tautline {
namespace {

/** "1 body", "2 bodies" */
std::string count(std::size_t number, const char* one, const char* many) {
    return std::to_string(number) + " " + (number == 1 ? one : many);
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

void printModelSummary(const models::ModelDescription& description, std::ostream& out) {
    std::size_t numCoordinates = 0;
    for (const models::Joint& joint : description.joints) numCoordinates += joint.coordinates.size();
    out << description.fileName << ": model '" << description.name << "', "
        << count(description.bodies.size(), "body", "bodies") << ", "
        << count(numCoordinates, "coordinate", "coordinates") << ", "
        << count(description.muscles.size(), "muscle", "muscles");
    if (!description.springs.empty()) out << ", " << count(description.springs.size(), "path spring", "path springs");
    if (!description.pathForces.empty())
        out << ", " << count(description.pathForces.size(), "other force along a path", "other forces along paths");
    if (!description.bodyForces.empty())
        out << ", " << count(description.bodyForces.size(), "force without a path", "forces without a path");
    out << "\n";
}

void printReadingNotes(const models::ModelDescription& description, std::ostream& out) {
    printSkipped(description, models::Effect::None, "left out, changes nothing", out);
    printSkipped(description, models::Effect::Forces, "left out, changes forces", out);
    printSkipped(description, models::Effect::Motion, "left out, may change poses, lengths and forces", out);
    for (const models::ReadingNote& note : description.notes)
        out << "note: " << description.fileName << ":" << note.line << ": " << note.text << "\n";
}

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

}  // namespace tautline
