// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/function_based_path.h"

#include <utility>

namespace tautline::models {

FunctionBasedPath::FunctionBasedPath(PathFunctions functions, const BuiltModel& model)
    : m_functions(std::move(functions)), m_model(model) {}

std::vector<double> FunctionBasedPath::getValues(const SimTK::State& state) const {
    std::vector<double> values;
    for (const std::string& name : m_functions.coordinates) values.push_back(m_model.getCoordinate(state, name));
    return values;
}

std::vector<double> FunctionBasedPath::getSpeeds(const SimTK::State& state) const {
    std::vector<double> speeds;
    for (const std::string& name : m_functions.coordinates) speeds.push_back(m_model.getCoordinateSpeed(state, name));
    return speeds;
}

double FunctionBasedPath::calcLength(const SimTK::State& state) const {
    return m_functions.length.calcValue(getValues(state).data());
}

std::vector<double> FunctionBasedPath::calcMomentArms(const SimTK::State& state) const {
    const std::vector<double> values = getValues(state);
    std::vector<double> arms(values.size());
    if (m_functions.momentArms.empty()) {
        m_functions.length.calcValueAndGradient(values.data(), arms.data());
        for (double& arm : arms) arm = -arm;
    } else {
        for (std::size_t i = 0; i < arms.size(); ++i) arms[i] = m_functions.momentArms[i].calcValue(values.data());
    }
    return arms;
}

double FunctionBasedPath::calcLengthRate(const SimTK::State& state) const {
    const std::vector<double> speeds = getSpeeds(state);
    if (m_functions.lengtheningSpeed) {
        std::vector<double> arguments = getValues(state);
        arguments.insert(arguments.end(), speeds.begin(), speeds.end());
        return m_functions.lengtheningSpeed->calcValue(arguments.data());
    }
    const std::vector<double> arms = calcMomentArms(state);
    double rate = 0.0;
    for (std::size_t i = 0; i < arms.size(); ++i) rate -= arms[i] * speeds[i];
    return rate;
}

}  // namespace tautline::models
