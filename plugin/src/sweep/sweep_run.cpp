// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_run.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "name_pattern.h"
#include "storage_file.h"

namespace tautline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLog = "log.txt";

fs::path makeFolder(const fs::path& folder) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/** The value that a column of the table has for the rows of a result; NaN where nothing is defined. */
double calcValue(const std::string& kind, const StorageTable& table, std::size_t column) {
    if (kind == "first") return table.rows.front()[column];
    if (kind == "last") return table.rows.back()[column];
    double sum = 0, least = std::numeric_limits<double>::infinity(), most = -least;
    int count = 0;
    for (const std::vector<double>& row : table.rows) {
        if (std::isnan(row[column])) continue;
        sum += row[column], least = std::min(least, row[column]), most = std::max(most, row[column]);
        ++count;
    }
    if (count == 0) return std::numeric_limits<double>::quiet_NaN();
    return kind == "min" ? least : kind == "max" ? most : sum / count;
}

std::vector<StorageTable> readResults(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".sto") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<StorageTable> tables;
    for (const fs::path& file : files) tables.push_back(readStorage(file));
    return tables;
}

void addValues(const SweepColumns& columns, const std::vector<StorageTable>& tables, SweepResult& result) {
    const std::size_t before = result.values.size();
    for (const StorageTable& table : tables)
        for (std::size_t i = 1; i < table.labels.size() && !table.rows.empty(); ++i)
            if (matchesPattern(table.labels[i], columns.pattern))
                for (const std::string& kind : columns.values)
                    result.values.emplace_back(table.labels[i] + " " + kind, calcValue(kind, table, i));
    if (result.values.size() == before)
        throw std::runtime_error("no column of the results matches '" + columns.pattern + "' of the table");
}

/** The last line that the program has said, or what signal it got. */
std::string findReason(int exitCode, const fs::path& logFile) {
    if (exitCode < 0) return "ended by signal " + std::to_string(-exitCode);
    std::ifstream log(logFile);
    std::string line, last;
    while (std::getline(log, line))
        if (!line.empty()) last = line;
    return last.empty() ? "exit code " + std::to_string(exitCode) : last;
}

}  // namespace

const char* SweepResult::getOutcome() const {
    switch (exitCode) {
        case 0:
            return "done";
        case 3:
            return "degraded";
        case 4:
            return "stuck";
        case 1:
            return "refused";
        default:
            return "crashed";
    }
}

SweepRun::SweepRun(const SweepPlan& plan, int run, const fs::path& modelFile, const fs::path& folder)
    : m_plan(&plan),
      m_run(run),
      m_folder(makeFolder(folder)),
      m_process(findProgram(), plan.makeArguments(run, modelFile, folder), folder / kLog) {}

SweepResult SweepRun::collect(int exitCode) const {
    SweepResult result;
    result.run = m_run, result.exitCode = exitCode;
    if (exitCode != 0) result.reason = findReason(exitCode, m_folder / kLog);
    if (result.isFailed()) return result;
    try {
        const std::vector<StorageTable> tables = readResults(m_folder);
        for (const SweepColumns& columns : m_plan->table) addValues(columns, tables, result);
    } catch (const std::exception& error) {
        result.exitCode = 1, result.reason = error.what(), result.values.clear();
    }
    return result;
}

std::optional<SweepResult> SweepRun::poll() {
    const std::optional<int> exitCode = m_process.poll();
    if (!exitCode) return {};
    const SweepResult result = collect(*exitCode);
    const bool stays =
        m_plan->keep == SweepPlan::Keep::All || (m_plan->keep == SweepPlan::Keep::Failed && result.exitCode != 0);
    if (!stays) fs::remove_all(m_folder);
    return result;
}

}  // namespace tautline
