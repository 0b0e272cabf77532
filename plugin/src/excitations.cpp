// SPDX-License-Identifier: Apache-2.0
#include "excitations.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "name_pattern.h"
#include "storage_file.h"
#include "tautline/models/control_set.h"

namespace tautline {
namespace {

void requireUnitInterval(double value, const std::string& what) {
    if (!(value >= 0 && value <= 1))
        throw std::runtime_error(what + " is " + std::to_string(value) + ", but an excitation lies in [0, 1]");
}

bool isMuscle(const std::vector<std::string>& muscles, const std::string& name) {
    return std::find(muscles.begin(), muscles.end(), name) != muscles.end();
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

/** One excitation of a file. */
struct FileEntry {
    std::string label;
    models::Control control;
    std::size_t numClipped = 0;  ///< of its values: outside [0, 1], or no numbers
};

void clip(FileEntry& entry) {
    for (auto& [time, value] : entry.control.nodes) {
        if (value >= 0 && value <= 1) continue;
        value = value > 1 ? 1.0 : 0.0;
        ++entry.numClipped;
    }
}

std::vector<FileEntry> readColumns(const std::filesystem::path& file) {
    const StorageTable table = readStorage(file);
    std::vector<FileEntry> entries;
    for (std::size_t column = 1; column < table.labels.size(); ++column) {
        entries.push_back({table.labels[column], {}});
        for (const std::vector<double>& row : table.rows) entries.back().control.nodes.push_back({row[0], row[column]});
        entries.back().control.extrapolates = false;
    }
    return entries;
}

std::vector<FileEntry> readControls(const std::filesystem::path& file) {
    std::vector<FileEntry> entries;
    for (models::Control& control : models::readControlSet(file)) entries.push_back({control.name, std::move(control)});
    return entries;
}

void readFile(const std::filesystem::path& file, const std::vector<std::string>& muscles,
              std::map<std::string, Excitation>& excitations, std::vector<std::string>& notes) {
    std::vector<FileEntry> entries = file.extension() == ".xml" ? readControls(file) : readColumns(file);
    std::vector<std::string> unused, clipped;
    for (FileEntry& entry : entries) {
        const std::string name = findMuscleOf(entry.label, muscles);
        if (name.empty()) {
            unused.push_back(entry.label);
            continue;
        }
        clip(entry);
        if (entry.numClipped > 0)
            clipped.push_back(name + " (" + std::to_string(entry.numClipped) + " of " +
                              std::to_string(entry.control.nodes.size()) + ")");
        // Lines that go on beyond the nodes may leave the unit interval.
        excitations[name] = [control = std::move(entry.control)](double t) {
            return std::clamp(control.calcValue(t), 0.0, 1.0);
        };
    }
    if (unused.size() == entries.size())
        throw std::runtime_error(file.string() + ": nothing in it is a muscle of the model; it has " +
                                 listNames(muscles));
    if (!unused.empty()) notes.push_back(file.string() + ": of no muscle and not used: " + listNames(unused));
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
