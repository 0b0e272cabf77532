// SPDX-License-Identifier: Apache-2.0
#include "page_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "study_tables.h"
#include "text_table.h"

namespace tautline {
namespace {

using models::PathAnswer;
using models::PathStudy;
using models::PoseAnswer;

/** Columns of result files that are curves of the page: <path>|<key> or <path>|<key>.<of>. */
struct Quantity {
    const char* key;
    const char* name;
};
constexpr Quantity kQuantities[] = {{"length", "length [m]"},
                                    {"rate", "rate [m/s]"},
                                    {"tension", "tension [N]"},
                                    {"moment_arm", "moment arm [m/rad or 1]"},
                                    {"distance", "clearance of obstacles [m]"}};

const char* findQuantity(const std::string& key) {
    const auto found = std::find_if(std::begin(kQuantities), std::end(kQuantities),
                                    [&key](const Quantity& quantity) { return key == quantity.key; });
    return found == std::end(kQuantities) ? nullptr : found->name;
}

/** Adds the curves of a table. @param indices   of the paths, by what the table calls them */
void addCurves(const StorageTable& table, const std::map<std::string, std::size_t>& indices, ReportPage& page) {
    for (std::size_t column = 1; column < table.labels.size(); ++column) {
        const std::string& label = table.labels[column];
        const std::size_t bar = std::min(label.find('|'), label.size());
        const std::size_t dot = std::min(label.find('.', bar), label.size());
        const auto path = indices.find(label.substr(0, bar));
        if (path == indices.end() || bar == label.size()) continue;
        const char* quantity = findQuantity(label.substr(bar + 1, dot - bar - 1));
        if (!quantity) continue;
        ReportPage::Curve curve{path->second, quantity, dot < label.size() ? label.substr(dot + 1) : "", {}};
        for (const auto& row : table.rows) curve.values.push_back(row[column]);
        page.curves.push_back(std::move(curve));
    }
}

void addTimes(const StorageTable& table, ReportPage& page) {
    for (const auto& row : table.rows) page.curveTimes.push_back(row[0]);
}

/** Those of events.csv. */
void addEvents(const std::string& csv, ReportPage& page) {
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);  // the labels
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string time, path, obstacle, kind;
        std::getline(std::getline(std::getline(std::getline(cells, time, ','), path, ','), obstacle, ','), kind, ',');
        page.events.push_back({std::stod(time), path.substr(path.rfind('/') + 1), obstacle, kind});
    }
}

/** What a path does for the first time in a frame. */
void addChanges(const models::StudiedPath& path, double time, const PathAnswer& before, const PathAnswer& after,
                ReportPage& page) {
    for (std::size_t o = 0; o < path.obstacles.size(); ++o) {
        const models::ObstacleAnswer &was = before.obstacles[o], &is = after.obstacles[o];
        const auto add = [&](const char* kind) { page.events.push_back({time, path.name, path.obstacles[o], kind}); };
        if (was.isTouched != is.isTouched) add(is.isTouched ? "touchdown" : "liftoff");
        if (was.isSwitchedOff != is.isSwitchedOff) add(is.isSwitchedOff ? "switched_off" : "switched_on");
    }
    if (before.status != after.status) page.events.push_back({time, path.name, "", getName(after.status)});
}

/** A path over all poses: "a local minimum in every frame", or why not in how many. */
std::string describeStatuses(const std::vector<double>& times, const std::vector<PoseAnswer>& answers, std::size_t p,
                             std::size_t& numFaults) {
    const PathAnswer* first = nullptr;
    double time = 0;
    numFaults = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const PathAnswer& path = answers[i].paths[p];
        numFaults += !path.isSound();
        if (first || path.explanation.empty()) continue;
        first = &path;
        time = times[i];
    }
    if (!first) return answers.size() == 1 ? "a local minimum" : "a local minimum in every frame";
    return (answers.size() == 1 ? "" : "first at " + toText(time) + " s: ") + std::string(getName(first->status)) +
           ", " + first->explanation;
}

void addStudyRow(const PathStudy& study, const std::vector<double>& times, const std::vector<PoseAnswer>& answers,
                 std::size_t p, ReportPage& page) {
    double shortest = kInfinity, longest = 0, fastest = 0;
    for (const PoseAnswer& answer : answers) {
        shortest = std::min(shortest, answer.paths[p].length);
        longest = std::max(longest, answer.paths[p].length);
        if (std::abs(answer.paths[p].rate) > std::abs(fastest)) fastest = answer.paths[p].rate;
    }
    std::size_t numFaults = 0;
    const std::string words = describeStatuses(times, answers, p, numFaults);
    page.rows.push_back({{study.getPaths()[p].name, format(shortest, 5), format(longest, 5), format(fastest, 5),
                          std::to_string(numFaults), words},
                         numFaults > 0});
}

}  // namespace

ReportPage makeRunPage(const models::ModelSystem& model, const SimulationResult& result) {
    ReportPage page;
    std::map<std::string, std::size_t> indices;
    const auto paths = model.getPaths();
    page.headings = {"path",          "length [m]", "rate [m/s]",     "tension [N]", "contacts made",
                     "contacts lost", "slips",      "degraded steps", "status"};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        indices[paths[i].path] = i;
        const PathSummary& summary = result.summaries[i];
        page.rows.push_back(
            {{paths[i].name, format(paths[i].cable.getLength(result.finalState), 5),
              format(paths[i].cable.getLengthRate(result.finalState), 5),
              format(paths[i].force.getTension(result.finalState), 2), std::to_string(summary.contactsMade),
              std::to_string(summary.contactsLost), std::to_string(summary.slips),
              std::to_string(summary.degradedSteps),
              summary.firstDegradation.empty() ? "a local minimum in every step" : "first " + summary.firstDegradation},
             summary.degradedSteps > 0});
    }
    addTimes(result.paths, page);
    addCurves(result.paths, indices, page);
    addCurves(result.clearances, indices, page);
    addEvents(result.events, page);
    return page;
}

ReportPage makeStudyPage(const PathStudy& study, const std::vector<double>& times,
                         const std::vector<PoseAnswer>& answers) {
    ReportPage page;
    std::map<std::string, std::size_t> indices;
    page.headings = {"path", "shortest [m]", "longest [m]", "fastest [m/s]", "faulty frames", "status"};
    for (std::size_t p = 0; p < study.getPaths().size(); ++p) {
        indices[study.getPaths()[p].path] = p;
        addStudyRow(study, times, answers, p, page);
    }
    page.curveTimes = times;
    addCurves(makePathTable(study, times, answers), indices, page);
    addCurves(makeMomentArmTable(study, times, answers), indices, page);
    for (std::size_t i = 1; i < answers.size(); ++i)
        for (std::size_t p = 0; p < study.getPaths().size(); ++p)
            addChanges(study.getPaths()[p], times[i], answers[i - 1].paths[p], answers[i].paths[p], page);
    return page;
}

}  // namespace tautline
