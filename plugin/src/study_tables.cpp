// SPDX-License-Identifier: Apache-2.0
#include "study_tables.h"

namespace tautline {
namespace {

using models::PathAnswer;
using models::PathStudy;
using models::PoseAnswer;
using models::StudiedPath;

/** Fills the rows of a table: addNumbers(row, answer) for each pose. */
template <class AddNumbers>
void addRows(const std::vector<double>& times, const std::vector<PoseAnswer>& answers, StorageTable& table,
             AddNumbers addNumbers) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
        table.rows.push_back({times[i]});
        table.rows.back().reserve(table.labels.size());
        addNumbers(table.rows.back(), answers[i]);
    }
}

/** A field of a csv file, quoted if it must be. */
std::string quote(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

StorageTable makePathTable(const PathStudy& study, const std::vector<double>& times,
                           const std::vector<PoseAnswer>& answers) {
    StorageTable table;
    table.name = "paths";
    table.labels = {"time"};
    for (const StudiedPath& path : study.getPaths()) {
        for (const char* quantity : {"|length", "|rate", "|status", "|follows_hints"})
            table.labels.push_back(path.path + quantity);
        for (const std::string& obstacle : path.obstacles)
            for (const char* quantity : {"|contact.", "|switched_off."})
                table.labels.push_back(path.path + quantity + obstacle);
    }
    addRows(times, answers, table, [](std::vector<double>& row, const PoseAnswer& answer) {
        for (const PathAnswer& path : answer.paths) {
            row.insert(row.end(),
                       {path.length, path.rate, static_cast<double>(path.status), 1.0 * path.followsHints()});
            for (const models::ObstacleAnswer& obstacle : path.obstacles)
                row.insert(row.end(), {1.0 * obstacle.numArcs, 1.0 * obstacle.isSwitchedOff});
        }
    });
    return table;
}

StorageTable makeMomentArmTable(const PathStudy& study, const std::vector<double>& times,
                                const std::vector<PoseAnswer>& answers) {
    StorageTable table;
    table.name = "moment_arms";
    table.labels = {"time"};
    for (const StudiedPath& path : study.getPaths())
        for (const std::string& coordinate : path.coordinates)
            for (const char* quantity : {"|moment_arm.", "|geometric_moment_arm."})
                table.labels.push_back(path.path + quantity + coordinate);
    addRows(times, answers, table, [](std::vector<double>& row, const PoseAnswer& answer) {
        for (const PathAnswer& path : answer.paths)
            for (std::size_t i = 0; i < path.effectiveArms.size(); ++i)
                row.insert(row.end(), {path.effectiveArms[i], path.geometricArms[i]});
    });
    return table;
}

StorageTable makeCoordinateTable(const PathStudy& study, const std::vector<double>& times,
                                 const std::vector<PoseAnswer>& answers) {
    StorageTable table;
    table.name = "coordinates";
    table.labels = {"time"};
    for (const std::string& path : study.getCoordinatePaths())
        for (const char* quantity : {"/value", "/speed"}) table.labels.push_back(path + quantity);
    addRows(times, answers, table, [](std::vector<double>& row, const PoseAnswer& answer) {
        for (std::size_t i = 0; i < answer.values.size(); ++i)
            row.insert(row.end(), {answer.values[i], answer.speeds[i]});
    });
    return table;
}

std::string makeStatusText(const PathStudy& study, const std::vector<double>& times,
                           const std::vector<PoseAnswer>& answers) {
    std::string text = "time,path,status,explanation\n";
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (!answers[i].constraintFault.empty())
            text += toText(times[i]) + ",,constraints," + quote(answers[i].constraintFault) + "\n";
        for (std::size_t p = 0; p < answers[i].paths.size(); ++p) {
            const PathAnswer& path = answers[i].paths[p];
            if (path.explanation.empty()) continue;
            text += toText(times[i]) + "," + quote(study.getPaths()[p].path) + "," + getName(path.status) + "," +
                    quote(path.explanation) + "\n";
        }
    }
    return text;
}

}  // namespace tautline
