// SPDX-License-Identifier: Apache-2.0
#include "motion_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

#include "name_pattern.h"
#include "tautline/models/scalar_function.h"

namespace tautline {
namespace {

using models::ModelDescription;

constexpr double kDegree = 3.14159265358979323846 / 180;
/** An angle beyond this in a file of radians is more likely one in degrees: four turns. */
constexpr double kLargestAngle = 8 * 3.14159265358979323846;

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** Of muscles and other forces, as OpenSim's states files have them beside coordinates. */
bool isStateOfForce(const std::string& label) {
    if (label.rfind("/forceset/", 0) == 0) return true;
    for (const char* end : {"/activation", "/fiber_length", ".activation", ".fiber_length", "/normalized_tendon_force"})
        if (endsWith(label, end)) return true;
    return false;
}

bool isDependent(const ModelDescription& description, const std::string& coordinate) {
    for (const models::ModelConstraint& constraint : description.constraints)
        if (const auto* coupler = std::get_if<models::CoordinateCoupler>(&constraint))
            if (coupler->dependentCoordinate == coordinate) return true;
    return false;
}

/** Which columns of a table are values and speeds of which coordinates. */
struct Columns {
    std::map<std::string, std::size_t> values, speeds;
};

Columns findColumns(const StorageTable& table, const std::filesystem::path& file, const ModelDescription& description,
                    const std::vector<std::string>& ignored, std::vector<std::string>& notes) {
    Columns columns;
    std::vector<std::string> unknown, states, asked;
    for (std::size_t i = 1; i < table.labels.size(); ++i) {
        const std::string& label = table.labels[i];
        const std::optional<CoordinateColumn> column = findCoordinateColumn(label, description);
        if (column) {
            auto& map = column->isSpeed ? columns.speeds : columns.values;
            if (!map.emplace(column->coordinate, i).second)
                throw std::runtime_error(file.string() + ": coordinate '" + column->coordinate +
                                         "' has two columns, '" + table.labels[map[column->coordinate]] + "' and '" +
                                         label + "'");
        } else if (matchesAny(label, ignored)) {
            asked.push_back(label);
        } else {
            (isStateOfForce(label) ? states : unknown).push_back(label);
        }
    }
    if (!unknown.empty())
        throw std::runtime_error(file.string() + ": the model has no coordinates for these columns: " +
                                 listNames(unknown) + "; --ignore NAME leaves a column out");
    if (columns.values.empty()) throw std::runtime_error(file.string() + ": no column is a coordinate of the model");
    if (!states.empty())
        notes.push_back(file.string() + ": columns of forces' states, which play no part here: " + listNames(states));
    std::vector<std::string> dependent;
    for (auto* map : {&columns.values, &columns.speeds})
        for (auto at = map->begin(); at != map->end();) {
            if (!isDependent(description, at->first)) {
                ++at;
                continue;
            }
            dependent.push_back(table.labels[at->second]);
            at = map->erase(at);
        }
    if (!dependent.empty())
        notes.push_back(file.string() +
                        ": columns of coordinates that couplers determine, not used: " + listNames(dependent));
    if (!asked.empty()) notes.push_back(file.string() + ": columns ignored as asked: " + listNames(asked));
    return columns;
}

/** One column in radians or meters. */
std::vector<double> getNumbers(const StorageTable& table, std::size_t column, double factor) {
    std::vector<double> numbers;
    for (const std::vector<double>& row : table.rows) numbers.push_back(factor * row[column]);
    return numbers;
}

models::ScalarFunction makeSpline(const std::vector<double>& times, const std::vector<double>& values) {
    if (times.size() < 2) return models::ScalarFunction::constant(values.front());
    return models::ScalarFunction::simmSpline(times, values);
}

}  // namespace

std::optional<CoordinateColumn> findCoordinateColumn(const std::string& label, const ModelDescription& description) {
    if (findCoordinate(description, label)) return CoordinateColumn{label, false};
    for (const auto& [end, isSpeed] : {std::pair("/value", false), std::pair("/speed", true), std::pair("_u", true)}) {
        if (!endsWith(label, end)) continue;
        std::string name = label.substr(0, label.size() - std::string(end).size());
        if (findCoordinate(description, name)) return CoordinateColumn{name, isSpeed};
        name = name.substr(name.find_last_of('/') + 1);
        if (findCoordinate(description, name)) return CoordinateColumn{name, isSpeed};
    }
    return {};
}

double getUnit(const StorageTable& table, const ModelDescription& description, const std::string& coordinate) {
    return table.isInDegrees && isRotational(description, coordinate) ? kDegree : 1.0;
}

Motion readMotion(const std::filesystem::path& file, const ModelDescription& description,
                  const std::vector<std::string>& ignored) {
    const StorageTable table = readStorage(file);
    Motion motion;
    const Columns columns = findColumns(table, file, description, ignored, motion.notes);
    const std::vector<double> times = getNumbers(table, 0, 1.0);
    motion.poses.resize(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) motion.poses[i].time = times[i];
    std::vector<std::string> turned;
    for (const auto& [name, column] : columns.values) {
        const bool isAngle = isRotational(description, name);
        const double factor = getUnit(table, description, name);
        const std::vector<double> values = getNumbers(table, column, factor);
        const auto speeds = columns.speeds.find(name);
        const models::ScalarFunction spline = makeSpline(times, values);
        for (std::size_t i = 0; i < times.size(); ++i) {
            motion.poses[i].values[name] = values[i];
            motion.poses[i].speeds[name] = speeds == columns.speeds.end() ? spline.calcDerivative(times[i])
                                                                          : factor * table.rows[i][speeds->second];
        }
        const auto isLarge = [](double angle) { return std::abs(angle) > kLargestAngle; };
        if (isAngle && !table.isInDegrees && std::any_of(values.begin(), values.end(), isLarge)) turned.push_back(name);
    }
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates)
            if (!columns.values.count(coordinate.name) && !isDependent(description, coordinate.name))
                motion.missing.push_back(coordinate.name);
    if (!turned.empty())
        motion.notes.push_back(file.string() + ": the header " +
                               (table.saysUnits ? "says radians" : "does not say inDegrees, read as radians") +
                               ", but these turn by more than four turns: " + listNames(turned));
    return motion;
}

std::vector<CoordinateValue> parseCoordinateValues(const std::vector<std::string>& texts, const std::string& option,
                                                   const ModelDescription& description) {
    std::vector<CoordinateValue> parsed;
    std::set<std::string> names;
    for (const std::string& text : texts) {
        const std::string given = option + " '" + text + "'";
        const std::size_t equals = text.rfind('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error(given + " is not of the form NAME=VALUE");
        CoordinateValue value{text.substr(0, equals)};
        if (!findCoordinate(description, value.name)) {
            std::vector<std::string> all;
            for (const models::Joint& joint : description.joints)
                for (const models::Coordinate& coordinate : joint.coordinates) all.push_back(coordinate.name);
            throw std::runtime_error(given + ": the model has no coordinate '" + value.name + "'; it has " +
                                     listNames(all));
        }
        if (!names.insert(value.name).second)
            throw std::runtime_error(option + ": '" + value.name + "' is given twice");
        const char *begin = text.data() + equals + 1, *end = text.data() + text.size();
        const auto result = std::from_chars(begin, end, value.value);
        const std::string unit(result.ptr, end);
        if (result.ptr == begin || result.ec != std::errc() || !std::isfinite(value.value) ||
            (!unit.empty() && unit != "deg"))
            throw std::runtime_error(given + ": '" + std::string(begin, end) + "' is not a number");
        if (unit == "deg" && !isRotational(description, value.name))
            throw std::runtime_error(given + ": the coordinate is a length, not an angle");
        if (unit == "deg") value.value *= kDegree;
        parsed.push_back(value);
    }
    return parsed;
}

}  // namespace tautline
