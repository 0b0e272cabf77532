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

void readFile(const std::filesystem::path& file, const std::vector<std::string>& muscles,
              std::map<std::string, Excitation>& excitations) {
    const StorageTable table = readStorage(file);
    for (std::size_t column = 1; column < table.labels.size(); ++column) {
        std::string name = table.labels[column];
        const std::string folder = "/forceset/";
        if (name.rfind(folder, 0) == 0) name = name.substr(folder.size());
        if (!isMuscle(muscles, name))
            throw std::runtime_error(file.string() + ": column '" + table.labels[column] +
                                     "' is no muscle of the model; it has " + listNames(muscles));
        for (const std::vector<double>& row : table.rows)
            requireUnitInterval(row[column], file.string() + ": '" + name + "' at time " + std::to_string(row[0]));
        excitations[name] = interpolate(table, column);
    }
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

}  // namespace

std::map<std::string, Excitation> makeExcitations(const ExcitationOptions& options,
                                                  const std::vector<std::string>& muscles, int& numDefault) {
    std::map<std::string, Excitation> excitations = options.prescribed;
    if (!options.file.empty()) readFile(options.file, muscles, excitations);
    std::vector<std::string> assigned;
    for (const std::string& text : options.assignments) {
        const auto [name, value] = parseAssignment(text);
        if (!isMuscle(muscles, name))
            throw std::runtime_error("--excitation '" + text + "': the model has no muscle '" + name + "'; it has " +
                                     listNames(muscles));
        if (isMuscle(assigned, name)) throw std::runtime_error("--excitation: '" + name + "' is given twice");
        assigned.push_back(name);
        excitations[name] = [constant = value](double) { return constant; };
    }
    numDefault = 0;
    for (const std::string& name : muscles) {
        const bool isNew = excitations.emplace(name, [](double) { return kDefaultExcitation; }).second;
        numDefault += isNew;
    }
    return excitations;
}

}  // namespace tautline
