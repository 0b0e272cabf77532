// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <sstream>

#include "storage_file.h"
#include "text_table.h"

namespace tautline {
namespace {

/** In quotes where a comma, a quote or an end of line stands in it. */
std::string toCell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/** The columns of values of all runs, in the order in which they come up. */
std::vector<std::string> findColumns(const std::map<int, SweepResult>& results) {
    std::vector<std::string> columns;
    std::set<std::string> known;
    for (const auto& [run, result] : results)
        for (const auto& [name, value] : result.values)
            if (known.insert(name).second) columns.push_back(name);
    return columns;
}

/** A run's values under the columns; NaN where it has none. */
std::vector<double> alignValues(const SweepResult& result, const std::vector<std::string>& columns) {
    const std::map<std::string, double> values(result.values.begin(), result.values.end());
    std::vector<double> row;
    for (const std::string& column : columns) {
        const auto value = values.find(column);
        row.push_back(value == values.end() ? std::numeric_limits<double>::quiet_NaN() : value->second);
    }
    return row;
}

std::string makeCsv(const SweepPlan& plan, const std::map<int, SweepResult>& results) {
    const std::vector<std::string> columns = findColumns(results);
    std::ostringstream text;
    text << "run,outcome";
    for (const SweepVariable& variable : plan.variables) text << "," << toCell(variable.getLabel());
    for (const std::string& column : columns) text << "," << toCell(column);
    for (const auto& [run, result] : results) {
        text << "\n" << run << "," << result.getOutcome();
        for (const std::string& value : plan.runs[static_cast<std::size_t>(run)]) text << "," << toCell(value);
        for (const double value : alignValues(result, columns))
            text << "," << (result.values.empty() ? "" : toText(value));
    }
    text << "\n";
    return text.str();
}

/** What a variable's value is in a table of numbers. */
double toNumber(const SweepPlan& plan, std::size_t variable, const std::string& value) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const std::string rest(end, value.data() + value.size());
    if (error == std::errc() && (rest.empty() || rest == "deg")) return number;
    std::vector<std::string> seen;
    for (const std::vector<std::string>& run : plan.runs) {
        if (run[variable] == value) break;
        if (std::find(seen.begin(), seen.end(), run[variable]) == seen.end()) seen.push_back(run[variable]);
    }
    return static_cast<double>(seen.size());
}

StorageTable makeStorage(const SweepPlan& plan, const std::map<int, SweepResult>& results) {
    const std::vector<std::string> columns = findColumns(results);
    StorageTable table;
    table.name = "sweep";
    table.labels = {"time", "exit_code"};
    const auto addLabel = [&table](std::string label) {
        std::replace(label.begin(), label.end(), ' ', '.');
        table.labels.push_back(label);
    };
    for (const SweepVariable& variable : plan.variables) addLabel(variable.getLabel());
    for (const std::string& column : columns) addLabel(column);
    for (const auto& [run, result] : results) {
        std::vector<double> row{static_cast<double>(run), static_cast<double>(result.exitCode)};
        const std::vector<std::string>& values = plan.runs[static_cast<std::size_t>(run)];
        for (std::size_t i = 0; i < values.size(); ++i) row.push_back(toNumber(plan, i, values[i]));
        for (const double value : alignValues(result, columns)) row.push_back(value);
        table.rows.push_back(row);
    }
    return table;
}

/** Empty if none has failed. */
std::string makeFailures(const SweepPlan& plan, const std::map<int, SweepResult>& results) {
    std::string text;
    for (const auto& [run, result] : results) {
        if (result.exitCode == 0) continue;
        std::string row = std::to_string(run) + "," + result.getOutcome();
        for (const std::string& value : plan.runs[static_cast<std::size_t>(run)]) row += "," + toCell(value);
        text += row + "," + toCell(result.reason) + "\n";
    }
    if (text.empty()) return "";
    std::string heading = "run,outcome";
    for (const SweepVariable& variable : plan.variables) heading += "," + toCell(variable.getLabel());
    return heading + ",reason\n" + text;
}

}  // namespace

std::vector<std::filesystem::path> writeSweepTable(const SweepPlan& plan, const std::map<int, SweepResult>& results,
                                                   const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files{folder / "sweep.csv", folder / "sweep.sto"};
    writeWhole(makeCsv(plan, results), files[0]);
    writeStorage(makeStorage(plan, results), files[1]);
    const std::filesystem::path failures = folder / "failed.csv";
    std::filesystem::remove(failures);
    if (const std::string text = makeFailures(plan, results); !text.empty()) {
        writeWhole(text, failures);
        files.push_back(failures);
    }
    return files;
}

void printSweepSummary(const SweepPlan& plan, const std::map<int, SweepResult>& results, std::ostream& out) {
    TextTable table;
    table.addColumn("outcome", "", true);
    table.addColumn("runs");
    table.addColumn("the first of them", "", true);
    std::map<std::string, std::pair<int, const SweepResult*>> outcomes;
    for (const auto& [run, result] : results) {
        auto& [count, first] = outcomes[result.getOutcome()];
        if (count++ == 0) first = &result;
    }
    for (const auto& [outcome, counted] : outcomes)
        table.addRow({outcome, std::to_string(counted.first),
                      std::to_string(counted.second->run) +
                          (counted.second->reason.empty() ? "" : ": " + counted.second->reason)});
    if (const std::size_t left = plan.runs.size() - results.size(); left > 0)
        table.addRow({"not done", std::to_string(left), ""});
    table.print(out);
}

}  // namespace tautline
