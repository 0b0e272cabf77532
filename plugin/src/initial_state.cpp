// SPDX-License-Identifier: Apache-2.0
#include "initial_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "name_pattern.h"
#include "storage_file.h"

namespace tautline {
namespace {

constexpr double kConstraintTolerance = 1e-8;  ///< of the initial pose; the integrator keeps its own afterwards

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** The muscle of a label such as /forceset/<muscle>/activation or <muscle>.activation; empty if it is none. */
std::string findMuscleOf(const std::string& label, const std::string& quantity,
                         const models::ModelDescription& description) {
    for (const char separator : {'/', '.'}) {
        const std::string end = separator + quantity;
        if (!endsWith(label, end)) continue;
        std::string name = label.substr(0, label.size() - end.size());
        const std::string folder = "/forceset/";
        if (name.rfind(folder, 0) == 0) name = name.substr(folder.size());
        if (findMuscle(description, name)) return name;
    }
    return "";
}

/** The numbers of a row, or between two rows. */
std::vector<double> findRow(const StorageTable& table, const std::filesystem::path& file, std::optional<double> time) {
    if (!time) return table.rows.front();
    const auto after = std::lower_bound(table.rows.begin(), table.rows.end(), *time,
                                        [](const std::vector<double>& row, double t) { return row[0] < t; });
    if (after == table.rows.end() || (after == table.rows.begin() && *time < table.rows.front()[0]))
        throw std::runtime_error(file.string() + ": has no states at " + toText(*time) + " s, but from " +
                                 toText(table.rows.front()[0]) + " to " + toText(table.rows.back()[0]) + " s");
    if (after == table.rows.begin()) return *after;
    const auto before = after - 1;
    const double share = (*time - (*before)[0]) / ((*after)[0] - (*before)[0]);
    std::vector<double> row;
    for (std::size_t i = 0; i < before->size(); ++i) row.push_back((*before)[i] + share * ((*after)[i] - (*before)[i]));
    row[0] = *time;
    return row;
}

void requireIn(bool isIn, const std::filesystem::path& file, const std::string& label, double value,
               const char* limits) {
    if (!isIn)
        throw std::runtime_error(file.string() + ": '" + label + "' is " + toText(value) + ", but must be " + limits);
}

}  // namespace

InitialState readStates(const std::filesystem::path& file, const models::ModelDescription& description,
                        std::optional<double> time, std::vector<std::string>& notes) {
    const StorageTable table = readStorage(file);
    const std::vector<double> row = findRow(table, file, time);
    InitialState initial;
    initial.time = row[0];
    std::vector<std::string> unused;
    for (std::size_t i = 1; i < row.size(); ++i) {
        const std::string& label = table.labels[i];
        if (const auto column = findCoordinateColumn(label, description)) {
            const double value = row[i] * getUnit(table, description, column->coordinate);
            requireIn(std::isfinite(value), file, label, value, "finite");
            (column->isSpeed ? initial.speeds : initial.values)[column->coordinate] = value;
        } else if (const std::string active = findMuscleOf(label, "activation", description); !active.empty()) {
            requireIn(row[i] >= 0 && row[i] <= 1, file, label, row[i], "in [0, 1]");
            initial.activations[active] = row[i];
        } else if (const std::string fiber = findMuscleOf(label, "fiber_length", description); !fiber.empty()) {
            requireIn(row[i] > 0 && std::isfinite(row[i]), file, label, row[i], "positive and finite");
            initial.fiberLengths[fiber] = row[i];
        } else {
            unused.push_back(label);
        }
    }
    if (unused.size() + 1 == table.labels.size())
        throw std::runtime_error(file.string() + ": no column is a state of the model");
    if (!unused.empty())
        notes.push_back(file.string() + ": columns that are no states of the model, not used: " + listNames(unused));
    return initial;
}

void InitialState::setPose(const models::ModelSystem& model, SimTK::State& state) const {
    state.setTime(time);
    const models::BuiltModel& built = model.getModel();
    built.setDefaultPose(state);
    for (const auto& [name, value] : values) built.setCoordinate(state, name, value);
    for (const auto& [name, speed] : speeds) built.setCoordinateSpeed(state, name, speed);
    built.applyCouplers(state);
    model.getSystem().realize(state, SimTK::Stage::Position);
    model.requireRegularPose(state);
    try {
        model.getSystem().project(state, kConstraintTolerance);
    } catch (const std::exception&) {
        throw models::ModelError("the constraints of the model cannot be met near the initial pose");
    }
    model.getSystem().realize(state, SimTK::Stage::Position);
}

std::vector<MuscleEquilibrium> InitialState::setMuscles(const models::ModelSystem& model, SimTK::State& state) const {
    for (const models::ModelSystem::MuscleSlot& slot : model.getMuscles()) {
        const auto activation = activations.find(slot.name);
        if (activation != activations.end() && !slot.muscle.getParameters().ignoresActivationDynamics)
            slot.muscle.setActivation(state, activation->second);
    }
    const std::vector<MuscleEquilibrium> found = model.equilibrateMuscles(state);
    for (const models::ModelSystem::MuscleSlot& slot : model.getMuscles()) {
        const auto length = fiberLengths.find(slot.name);
        if (length != fiberLengths.end() && !slot.muscle.getModel().hasRigidTendon())
            slot.muscle.setFiberLength(state, length->second);
    }
    return found;
}

}  // namespace tautline
