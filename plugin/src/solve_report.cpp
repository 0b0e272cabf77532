// SPDX-License-Identifier: Apache-2.0
#include "solve_report.h"

#include <algorithm>
#include <cmath>

#include "storage_file.h"
#include "text_table.h"

namespace tautline {
namespace {

using models::PathAnswer;
using models::PathStudy;
using models::PoseAnswer;
using models::StudiedPath;

void printPose(const PathStudy& study, const PoseAnswer& answer, std::ostream& out) {
    TextTable table;
    table.addColumn("path", "", true);
    table.addColumn("length", "[m]");
    table.addColumn("rate", "[m/s]");
    table.addColumn("status", "", true);
    table.addColumn("touches", "", true);
    table.addColumn("moment arms", "[m/rad or 1]", true);
    for (std::size_t p = 0; p < answer.paths.size(); ++p) {
        const StudiedPath& studied = study.getPaths()[p];
        const PathAnswer& path = answer.paths[p];
        std::string touched, arms;
        for (std::size_t o = 0; o < path.obstacles.size(); ++o)
            if (path.obstacles[o].isTouched) touched += (touched.empty() ? "" : ", ") + studied.obstacles[o];
        for (std::size_t c = 0; c < path.effectiveArms.size(); ++c)
            arms += (c ? ", " : "") + studied.coordinates[c] + " " + format(path.effectiveArms[c], 5);
        table.addRow({studied.name, format(path.length, 6), format(path.rate, 5), getName(path.status),
                      touched.empty() ? "-" : touched, arms.empty() ? "-" : arms});
    }
    table.print(out);
}

/** "elbow 62 %, capsule 100 %": in how many poses each obstacle is touched that ever is. */
std::string describeContacts(const StudiedPath& studied, std::size_t p, const std::vector<PoseAnswer>& answers) {
    std::string text;
    for (std::size_t o = 0; o < studied.obstacles.size(); ++o) {
        std::size_t touched = 0;
        for (const PoseAnswer& answer : answers) touched += answer.paths[p].obstacles[o].isTouched;
        if (touched == 0) continue;
        text += (text.empty() ? "" : ", ") + studied.obstacles[o] + " " + formatShare(touched, answers.size());
    }
    return text.empty() ? "-" : text;
}

void printMotion(const PathStudy& study, const std::vector<PoseAnswer>& answers, std::ostream& out) {
    TextTable table;
    table.addColumn("path", "", true);
    table.addColumn("shortest", "[m]");
    table.addColumn("longest", "[m]");
    table.addColumn("fastest", "[m/s]");
    table.addColumn("touches", "", true);
    for (std::size_t p = 0; p < study.getPaths().size(); ++p) {
        double shortest = SimTK::Infinity, longest = 0, fastest = 0;
        for (const PoseAnswer& answer : answers) {
            const PathAnswer& path = answer.paths[p];
            shortest = std::min(shortest, path.length), longest = std::max(longest, path.length);
            if (std::abs(path.rate) > std::abs(fastest)) fastest = path.rate;
        }
        table.addRow({study.getPaths()[p].name, format(shortest, 6), format(longest, 6), format(fastest, 5),
                      describeContacts(study.getPaths()[p], p, answers)});
    }
    table.print(out);
}

/** How many frames have an answer of some kind, and the first of them. */
template <class IsKind>
void printFrames(const PathStudy& study, const std::vector<double>& times, const std::vector<PoseAnswer>& answers,
                 const std::string& heading, IsKind isKind, std::ostream& out) {
    for (std::size_t p = 0; p < study.getPaths().size(); ++p) {
        std::size_t count = 0, first = 0;
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (isKind(answers[i].paths[p]) && count++ == 0) first = i;
        if (count == 0) continue;
        const PathAnswer& path = answers[first].paths[p];
        out << heading << ": " << study.getPaths()[p].name << ": ";
        if (answers.size() > 1)
            out << count << " of " << answers.size() << " frames, first at " << toText(times[first]) << " s: ";
        out << getName(path.status) << ", " << path.explanation << "\n";
    }
}

}  // namespace

void printStudy(const PathStudy& study, const std::vector<double>& times, const std::vector<PoseAnswer>& answers,
                std::ostream& out) {
    if (answers.size() == 1)
        printPose(study, answers.front(), out);
    else
        printMotion(study, answers, out);
    printFrames(
        study, times, answers, "warning", [](const PathAnswer& path) { return !path.isSound(); }, out);
    printFrames(
        study, times, answers, "note",
        [](const PathAnswer& path) {
            return path.isSound() &&
                   (path.status == PathStatus::EndInside || path.deviation == RouteDeviation::Kind::Near);
        },
        out);
    std::size_t numFaults = 0, first = 0;
    for (std::size_t i = 0; i < answers.size(); ++i)
        if (!answers[i].constraintFault.empty() && numFaults++ == 0) first = i;
    if (numFaults > 0)
        out << "warning: " << numFaults << " of " << answers.size() << " frames, first at " << toText(times[first])
            << " s: " << answers[first].constraintFault << "\n";
}

}  // namespace tautline
