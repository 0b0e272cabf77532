// SPDX-License-Identifier: Apache-2.0
#include "check_report.h"

#include <cmath>

#include "model_report.h"
#include "text_table.h"

namespace tautline {
namespace {

using models::CheckedDeviation;
using models::CheckedMuscle;
using models::CheckedObstacle;
using models::CheckedPath;

void printUnknown(const CheckedModel& model, std::ostream& out) {
    if (model.unknown.empty()) return;
    out << "not supported; `tautline run` needs --ignore for each, and then leaves it out:\n";
    for (const models::UnknownElement& element : model.unknown) {
        out << "  line " << element.line << ": " << element.kind << " " << element.type;
        if (!element.name.empty()) out << " '" << element.name << "'";
        out << (element.effect == models::Effect::None     ? ", changes nothing"
                : element.effect == models::Effect::Forces ? ", changes forces"
                                                           : ", may change poses, lengths and forces")
            << "\n";
    }
}

void printCoordinates(const models::ModelDescription& description, std::ostream& out) {
    TextTable table;
    table.addColumn("coordinate", "", true);
    table.addColumn("default");
    table.addColumn("from");
    table.addColumn("to");
    table.addColumn("unit", "", true);
    table.addColumn("", "", true);
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates) {
            std::string kind = coordinate.locked ? "locked" : coordinate.prescribedMotion ? "driven" : "";
            for (const models::ModelConstraint& constraint : description.constraints)
                if (const auto* coupler = std::get_if<models::CoordinateCoupler>(&constraint))
                    if (coupler->dependentCoordinate == coordinate.name) kind = "coupled";
            const auto formatLimit = [](double limit) { return std::isfinite(limit) ? format(limit, 3) : "-"; };
            table.addRow({coordinate.name, format(coordinate.defaultValue, 3), formatLimit(coordinate.range[0]),
                          formatLimit(coordinate.range[1]), isRotational(description, coordinate.name) ? "rad" : "m",
                          kind});
        }
    table.print(out);
}

void printPaths(const models::ModelCheck& check, std::ostream& out) {
    TextTable table;
    table.addColumn("path", "", true);
    table.addColumn("type", "", true);
    table.addColumn("points");
    table.addColumn("shortest", "[m]");
    table.addColumn("longest", "[m]");
    table.addColumn("not solved", "of poses");
    for (const CheckedPath& path : check.paths)
        table.addRow({path.name, path.type, std::to_string(path.numPoints), format(path.shortest, 4),
                      format(path.longest, 4),
                      formatShare(path.numUnsound, check.numPoses - check.numBrokenConstraints)});
    table.print(out);
}

void printObstacles(const models::ModelCheck& check, std::ostream& out) {
    TextTable table;
    table.addColumn("wrap", "", true);
    table.addColumn("object", "", true);
    table.addColumn("shape", "", true);
    table.addColumn("segment");
    table.addColumn("touched", "of poses");
    table.addColumn("point inside", "of poses");
    table.addColumn("passed over", "of poses");
    const int numPoses = check.numPoses - check.numBrokenConstraints;
    bool isEmpty = true;
    for (const CheckedPath& path : check.paths)
        for (const CheckedObstacle& obstacle : path.obstacles) {
            isEmpty = false;
            table.addRow({path.name, obstacle.name, obstacle.shape,
                          std::to_string(obstacle.segment) + "-" + std::to_string(obstacle.segment + 1),
                          formatShare(obstacle.numTouched, numPoses), formatShare(obstacle.numEntered, numPoses),
                          formatShare(obstacle.numPassedOver, numPoses)});
        }
    if (isEmpty) return;
    out << "\n";
    table.print(out);
}

void printMuscles(const models::ModelCheck& check, std::ostream& out) {
    TextTable table;
    table.addColumn("muscle at rest", "", true);
    table.addColumn("fiber", "shortest");
    table.addColumn("[optimal]", "longest");
    table.addColumn("tendon force", "of the largest isometric");
    table.addColumn("path too short", "of poses");
    table.addColumn("longest at", "", true);
    const int numPoses = check.numPoses - check.numBrokenConstraints;
    bool isEmpty = true;
    for (const CheckedPath& path : check.paths) {
        if (!path.muscle) continue;
        isEmpty = false;
        table.addRow({path.name, format(path.muscle->shortestFiber, 2), format(path.muscle->longestFiber, 2),
                      format(path.muscle->largestTendonForce, 2), formatShare(path.muscle->numTooShort, numPoses),
                      path.muscle->longestAt});
    }
    if (isEmpty) return;
    out << "\n";
    table.print(out);
}

void printDeviations(const models::ModelCheck& check, std::ostream& out) {
    using Kind = CheckedDeviation::Kind;
    TextTable table;
    table.addColumn("differs from OpenSim", "", true);
    table.addColumn("object", "", true);
    table.addColumn("how", "", true);
    table.addColumn("poses");
    table.addColumn("length by", "[mm]");
    table.addColumn("at", "", true);
    bool hasSeveral = false, hasSections = false;
    for (const CheckedPath& path : check.paths)
        for (const CheckedDeviation& deviation : path.deviations) {
            const bool isSection = deviation.kind == Kind::PlaneSection;
            (isSection ? hasSections : hasSeveral) = true;
            table.addRow({path.name, deviation.obstacle, isSection ? "section" : "several",
                          std::to_string(deviation.numPoses), format(1e3 * deviation.byLength, 3), deviation.where});
        }
    if (!hasSeveral && !hasSections) return;
    out << "\n";
    table.print(out);
    if (hasSections)
        out << "section: in OpenSim a path over an ellipsoid lies in a plane, here it is a geodesic (estimated with "
               "the "
               "plane through the middle of the line)\n";
    if (hasSeveral)
        out << "several: the path passes the object on several segments at once; in OpenSim it goes through it on all "
               "but "
               "one\n";
}

void printWarnings(const models::ModelCheck& check, std::ostream& out) {
    if (check.numBrokenConstraints > 0)
        out << "warning: in " << check.numBrokenConstraints << " of " << check.numPoses
            << " poses the constraints of the model cannot be met\n";
    for (const CheckedPath& path : check.paths)
        if (path.numUnsound > 0)
            out << "warning: " << path.name << ": " << path.numUnsound << " poses are not solved, first "
                << path.firstFault << "\n";
    std::string tooLong;
    for (const CheckedPath& path : check.paths)
        if (path.muscle && path.muscle->canBeTooLong()) tooLong += (tooLong.empty() ? "" : ", ") + path.name;
    if (!tooLong.empty())
        out << "warning: the path can be longer than fiber and tendon allow: fibers beyond "
            << format(CheckedMuscle::kLongFiber, 1) << " optimal lengths, where curves are only continued: " << tooLong
            << "\n";
}

}  // namespace

void printCheck(const CheckedModel& model, std::ostream& out) {
    printModelSummary(model.description, out);
    printUnknown(model, out);
    printReadingNotes(model.description, out);
    printMuscleTypes(model.description, out);
    out << "\n";
    printCoordinates(model.description, out);
    out << "\nchecked in " << model.check.numPoses
        << " poses: the default one, along each free coordinate alone, and random ones over all ranges\n\n";
    printPaths(model.check, out);
    printObstacles(model.check, out);
    printMuscles(model.check, out);
    printDeviations(model.check, out);
    out << "\n";
    printWarnings(model.check, out);
}

}  // namespace tautline
