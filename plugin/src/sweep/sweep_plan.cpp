// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_plan.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "storage_file.h"
#include "sweep/json_field.h"
#include "sweep/sampling.h"

namespace tautline {
namespace {

using nlohmann::ordered_json;

constexpr std::int64_t kMostRuns = 1'000'000;

/** A variable with the values that it may have. */
struct Range {
    SweepVariable variable;
    std::vector<std::string> values;  ///< one by one; empty: from a to b
    double from = 0, to = 0;
    bool isLogarithmic = false;
    std::string unit;  ///< "deg" or nothing

    std::string toText(double value) const { return tautline::toText(value) + unit; }

    /** At x in [0, 1] of the way from `from` to `to`. */
    std::string interpolate(double x) const {
        if (x == 1) return toText(to);
        return toText(isLogarithmic ? from * std::pow(to / from, x) : from + x * (to - from));
    }

    /** What x in [0, 1) stands for. */
    std::string pick(double x) const {
        if (values.empty()) return interpolate(x);
        return values[static_cast<std::size_t>(x * static_cast<double>(values.size()))];
    }
};

ordered_json parseFile(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    try {
        return ordered_json::parse(stream);
    } catch (const nlohmann::json::parse_error& error) {
        const std::string what =
            error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        throw std::runtime_error(file.string() + ": " + what.substr(what.find("] ") + 2));
    }
}

/** Options that all runs have. */
std::vector<std::string> readOptions(JsonField field) {
    std::vector<std::string> arguments;
    for (const std::string& name : field.getKeys()) {
        const JsonField value = field.require(name);
        for (const char* own : {"out", "resume", "visualize", "plot", "report", "help"})
            if (name == own) value.fail("cannot be given to the runs of a sweep");
        const std::string option = "--" + name;
        if (value.get().is_boolean()) {
            if (value.get().get<bool>()) arguments.push_back(option);
        } else if (!value.get().is_array()) {
            arguments.insert(arguments.end(), {option, value.getText()});
        } else {  // words one by one, numbers together
            bool isFirst = true;
            for (const JsonField& item : value.getItems()) {
                if (isFirst || item.get().is_string()) arguments.push_back(option);
                arguments.push_back(item.getText());
                isFirst = false;
            }
        }
    }
    return arguments;
}

/** @param needsCount   whether single values are asked for */
Range readRange(JsonField field, bool needsCount) {
    Range range;
    range.variable.option = field.require("option").getString();
    if (field.has("name")) range.variable.name = field.require("name").getString();
    if (field.has("unit")) range.unit = field.require("unit").getChoice({"deg"});
    if (field.has("values")) {
        for (const JsonField& value : field.require("values").getItems())
            range.values.push_back(value.getText() + (value.get().is_number() ? range.unit : ""));
        field.refuseUnknown();
        return range;
    }
    range.from = field.require("from").getNumber(), range.to = field.require("to").getNumber();
    if (field.has("scale")) range.isLogarithmic = field.require("scale").getChoice({"linear", "log"}) == "log";
    if (range.isLogarithmic && !(range.from > 0 && range.to > 0))
        field.fail("goes from " + tautline::toText(range.from) + " to " + tautline::toText(range.to) +
                   ", but both must be positive on a scale of logarithms");
    if (needsCount) {
        const auto count = field.require("count").getInteger(2, kMostRuns);
        for (std::int64_t i = 0; i < count; ++i)
            range.values.push_back(range.interpolate(static_cast<double>(i) / static_cast<double>(count - 1)));
    }
    field.refuseUnknown();
    return range;
}

/** Every value of each with every value of the others, those of the last one fastest. */
std::vector<std::vector<std::string>> makeGrid(const std::vector<Range>& ranges, const JsonField& field) {
    double count = 1;
    for (const Range& range : ranges) count *= static_cast<double>(range.values.size());
    if (count > kMostRuns) field.fail("asks for more than " + std::to_string(kMostRuns) + " runs");
    std::vector<std::vector<std::string>> runs{{}};
    for (const Range& range : ranges) {
        std::vector<std::vector<std::string>> longer;
        for (const std::vector<std::string>& run : runs)
            for (const std::string& value : range.values) {
                longer.push_back(run);
                longer.back().push_back(value);
            }
        runs.swap(longer);
    }
    return runs;
}

/** The first of each, the second of each, ... */
std::vector<std::vector<std::string>> makeList(const std::vector<Range>& ranges, const JsonField& field) {
    std::vector<std::vector<std::string>> runs(ranges.front().values.size());
    for (const Range& range : ranges) {
        if (range.values.size() != runs.size())
            field.fail("is a list, but '" + range.variable.getLabel() + "' has " + std::to_string(range.values.size()) +
                       " values and '" + ranges.front().variable.getLabel() + "' has " + std::to_string(runs.size()));
        for (std::size_t i = 0; i < runs.size(); ++i) runs[i].push_back(range.values[i]);
    }
    return runs;
}

std::vector<std::vector<std::string>> pickRuns(const std::vector<Range>& ranges, const UnitSamples& samples) {
    std::vector<std::vector<std::string>> runs(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t d = 0; d < ranges.size(); ++d) runs[i].push_back(ranges[d].pick(samples[i][d]));
    return runs;
}

/** The variables and their values in each run. */
void readRuns(JsonField& document, SweepPlan& plan) {
    static const ordered_json grid = {{"method", "grid"}};
    JsonField sampling = document.has("sampling") ? document.require("sampling") : JsonField(grid, "", "");
    const std::string method = sampling.require("method").getChoice({"grid", "list", "random", "latin_hypercube"});
    const bool isDrawn = method == "random" || method == "latin_hypercube";
    std::vector<Range> ranges;
    for (const JsonField& field : document.require("vary").getItems()) {
        ranges.push_back(readRange(field, !isDrawn));
        for (const SweepVariable& other : plan.variables)
            if (other.getLabel() == ranges.back().variable.getLabel())
                field.fail("varies '" + other.getLabel() + "', which another one does");
        plan.variables.push_back(ranges.back().variable);
    }
    if (isDrawn) {
        const int count = static_cast<int>(sampling.require("runs").getInteger(1, kMostRuns));
        const auto seed = static_cast<std::uint64_t>(sampling.require("seed").getInteger(0, INT64_MAX));
        const int dimensions = static_cast<int>(ranges.size());
        plan.runs = pickRuns(ranges, method == "random" ? drawRandom(count, dimensions, seed)
                                                        : drawLatinHypercube(count, dimensions, seed));
    } else {
        plan.runs = method == "grid" ? makeGrid(ranges, sampling) : makeList(ranges, sampling);
    }
    sampling.refuseUnknown();
}

std::vector<SweepColumns> readTable(JsonField& document, const std::string& command) {
    if (!document.has("table")) {
        if (command == "run") return {{"*|length", {"min", "max", "last"}}, {"*|tension", {"max"}}};
        return {{"*|length", {"min", "max"}}};
    }
    std::vector<SweepColumns> table;
    for (JsonField field : document.require("table").getItems()) {
        SweepColumns columns{field.require("columns").getString(), {}};
        for (const JsonField& value : field.require("values").getItems())
            columns.values.push_back(value.getChoice({"first", "last", "min", "max", "mean"}));
        field.refuseUnknown();
        table.push_back(columns);
    }
    return table;
}

SweepPlan::Keep readKeep(JsonField& document) {
    if (!document.has("keep")) return SweepPlan::Keep::Failed;
    const std::string keep = document.require("keep").getChoice({"none", "failed", "all"});
    return keep == "none" ? SweepPlan::Keep::None : keep == "all" ? SweepPlan::Keep::All : SweepPlan::Keep::Failed;
}

}  // namespace

std::vector<std::string> SweepPlan::makeArguments(int run, const std::filesystem::path& modelFile,
                                                  const std::filesystem::path& outFolder) const {
    std::vector<std::string> line{command, modelFile.string()};
    line.insert(line.end(), arguments.begin(), arguments.end());
    for (std::size_t i = 0; i < variables.size(); ++i) {
        const std::string& value = runs[static_cast<std::size_t>(run)][i];
        line.push_back("--" + variables[i].option);
        line.push_back(variables[i].name.empty() ? value : variables[i].name + "=" + value);
    }
    line.insert(line.end(), {"--out", outFolder.string()});
    return line;
}

SweepPlan readSweepPlan(const std::filesystem::path& file) {
    const ordered_json json = parseFile(file);
    JsonField document(json, file.string());
    SweepPlan plan;
    plan.command = document.has("command") ? document.require("command").getChoice({"run", "solve"}) : "run";
    if (plan.command == "solve") plan.arguments = {"--threads", "1"};  // runs are what is done side by side
    if (document.has("options"))
        for (const std::string& word : readOptions(document.require("options"))) plan.arguments.push_back(word);
    readRuns(document, plan);
    plan.table = readTable(document, plan.command);
    plan.keep = readKeep(document);
    document.refuseUnknown();
    return plan;
}

}  // namespace tautline
