// SPDX-License-Identifier: Apache-2.0
#include "excitations.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "name_pattern.h"
#include "storage_file.h"

namespace tautline {
namespace {

void requireUnitInterval(double value, const std::string& what) {
    if (!(value >= 0 && value <= 1))
        throw std::runtime_error(what + " is " + std::to_string(value) + ", but an excitation lies in [0, 1]");
}

bool isMuscle(const std::vector<std::string>& muscles, const std::string& name) {
    return std::find(muscles.begin(), muscles.end(), name) != muscles.end();
}

/** Linear between the rows of two columns of a table. */
Excitation interpolate(const StorageTable& table, std::size_t column) {
    std::vector<std::pair<double, double>> points;
    for (const std::vector<double>& row : table.rows) points.emplace_back(row[0], row[column]);
    return [points](double t) {
        const auto after = std::upper_bound(points.begin(), points.end(), t,
                                            [](double time, const auto& point) { return time < point.first; });
        if (after == points.begin()) return points.front().second;
        if (after == points.end()) return points.back().second;
        const auto before = after - 1;
        return before->second + (t - before->first) / (after->first - before->first) * (after->second - before->second);
    };
}

/** The muscle of a column; empty if it is of none. */
std::string findMuscleOf(std::string label, const std::vector<std::string>& muscles) {
    const std::string folder = "/forceset/", end = ".excitation";
    if (label.rfind(folder, 0) == 0) label = label.substr(folder.size());
    if (isMuscle(muscles, label)) return label;
    if (label.size() > end.size() && label.compare(label.size() - end.size(), end.size(), end) == 0)
        label = label.substr(0, label.size() - end.size());
    return isMuscle(muscles, label) ? label : "";
}

/** Puts the numbers of a column into [0, 1]. @return how many were outside, or no numbers */
std::size_t clipColumn(StorageTable& table, std::size_t column) {
    std::size_t numClipped = 0;
    for (std::vector<double>& row : table.rows) {
        if (row[column] >= 0 && row[column] <= 1) continue;
        row[column] = row[column] > 1 ? 1.0 : 0.0;
        ++numClipped;
    }
    return numClipped;
}

void readFile(const std::filesystem::path& file, const std::vector<std::string>& muscles,
              std::map<std::string, Excitation>& excitations, std::vector<std::string>& notes) {
    if (file.extension() == ".xml")
        throw std::runtime_error(file.string() +
                                 ": control sets (.xml) are not read; give the controls as a storage file (.sto)");
    StorageTable table = readStorage(file);
    std::vector<std::string> unused, clipped;
    for (std::size_t column = 1; column < table.labels.size(); ++column) {
        const std::string name = findMuscleOf(table.labels[column], muscles);
        if (name.empty()) {
            unused.push_back(table.labels[column]);
            continue;
        }
        if (const std::size_t count = clipColumn(table, column); count > 0)
            clipped.push_back(name + " (" + std::to_string(count) + " of " + std::to_string(table.rows.size()) + ")");
        excitations[name] = interpolate(table, column);
    }
    if (unused.size() + 1 == table.labels.size())
        throw std::runtime_error(file.string() + ": no column is a muscle of the model; it has " + listNames(muscles));
    if (!unused.empty()) notes.push_back(file.string() + ": columns of no muscle, not used: " + listNames(unused));
    if (!clipped.empty())
        notes.push_back(file.string() + ": excitations outside [0, 1] are clipped: " + listNames(clipped));
}

std::pair<std::string, double> parseAssignment(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0)
        throw std::runtime_error("--excitation '" + text + "' is not of the form NAME=VALUE");
    double value = 0;
    const char *begin = text.data() + equals + 1, *end = text.data() + text.size();
    const auto result = std::from_chars(begin, end, value);
    if (begin == end || result.ec != std::errc() || result.ptr != end)
        throw std::runtime_error("--excitation '" + text + "': '" + std::string(begin, end) + "' is not a number");
    requireUnitInterval(value, "--excitation '" + text + "'");
    return {text.substr(0, equals), value};
}

/** Patterns first, in their order, then names. */
void assign(const std::vector<std::string>& assignments, const std::vector<std::string>& muscles,
            std::map<std::string, Excitation>& excitations) {
    std::vector<std::string> assigned;
    for (const bool isPattern : {true, false}) {
        for (const std::string& text : assignments) {
            const auto [given, value] = parseAssignment(text);
            if (isMuscle(muscles, given) == isPattern) continue;
            if (!isPattern && isMuscle(assigned, given))
                throw std::runtime_error("--excitation: '" + given + "' is given twice");
            assigned.push_back(given);
            bool isUsed = false;
            for (const std::string& name : muscles) {
                if (isPattern ? !matchesPattern(name, given) : name != given) continue;
                isUsed = true;
                excitations[name] = [constant = value](double) { return constant; };
            }
            if (!isUsed)
                throw std::runtime_error("--excitation '" + text + "': the model has no muscle '" + given +
                                         "'; it has " + listNames(muscles));
        }
    }
}

}  // namespace

std::map<std::string, Excitation> makeExcitations(const ExcitationOptions& options,
                                                  const std::vector<std::string>& muscles, int& numDefault,
                                                  std::vector<std::string>& notes) {
    std::map<std::string, Excitation> excitations = options.prescribed;
    if (!options.file.empty()) readFile(options.file, muscles, excitations, notes);
    assign(options.assignments, muscles, excitations);
    numDefault = 0;
    for (const std::string& name : muscles) {
        const bool isNew = excitations.emplace(name, [](double) { return kDefaultExcitation; }).second;
        numDefault += isNew;
    }
    return excitations;
}

}  // namespace tautline
