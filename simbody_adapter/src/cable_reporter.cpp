// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_reporter.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tautline/error.h"

namespace tautline {

using SimTK::Real;

namespace {

Real checkInterval(Real interval) {
    require(std::isfinite(interval) && interval > 0,
            "cable reporter: the interval must be positive and finite, but is ", interval);
    return interval;
}

}  // namespace

CableReporter::CableReporter(const CablePathSubsystem& cables, Real interval)
    : PeriodicEventReporter(checkInterval(interval)), m_cables(cables) {}

void CableReporter::addForce(const CableForce& force) {
    require(!force.isEmptyHandle(), "cable reporter: the force is an empty handle");
    require(m_rows.empty(), "cable reporter: a force was added after the first report");
    m_forces.push_back(force);
}

std::vector<std::string> CableReporter::getLabels() const {
    std::vector<std::string> labels{"time"};
    for (CableIndex c(0); c < m_cables.getNumCables(); ++c) {
        const Cable& cable = m_cables.getCable(c);
        labels.push_back(cable.getName() + "|length");
        labels.push_back(cable.getName() + "|rate");
        for (int i = 0; i < cable.getNumObstacles(); ++i)
            labels.push_back(cable.getName() + "|contact." + cable.getElementName(cable.getObstacle(i)));
    }
    for (const CableForce& force : m_forces) labels.push_back(force.getCable().getName() + "|tension");
    return labels;
}

void CableReporter::handleEvent(const SimTK::State& state) const {
    m_cables.getMultibodySystem().realize(state, SimTK::Stage::Velocity);
    std::vector<Real> row{state.getTime()};
    for (CableIndex c(0); c < m_cables.getNumCables(); ++c) {
        const Cable& cable = m_cables.getCable(c);
        const bool isDisabled = cable.isDisabled(state);
        row.push_back(isDisabled ? SimTK::NaN : cable.getLength(state));
        row.push_back(isDisabled ? SimTK::NaN : cable.getLengthRate(state));
        for (int i = 0; i < cable.getNumObstacles(); ++i)
            row.push_back(isDisabled ? SimTK::NaN : Real(cable.isTouched(state, cable.getObstacle(i))));
    }
    for (const CableForce& force : m_forces) row.push_back(force.getTension(state));
    m_rows.push_back(std::move(row));
}

void CableReporter::writeStorage(const std::string& file) const {
    const std::vector<std::string> labels = getLabels();
    std::ofstream out(file);
    out.precision(std::numeric_limits<Real>::max_digits10);
    out << "cables\nversion=1\nnRows=" << m_rows.size() << "\nnColumns=" << labels.size()
        << "\ninDegrees=no\nendheader\n";
    for (std::size_t i = 0; i < labels.size(); ++i) out << (i > 0 ? "\t" : "") << labels[i];
    out << "\n";
    for (const std::vector<Real>& row : m_rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0) out << "\t";
            if (std::isnan(row[i]))
                out << "nan";  // of either sign
            else
                out << row[i];
        }
        out << "\n";
    }
    if (!out.flush()) throw std::runtime_error("cannot write '" + file + "'");
}

}  // namespace tautline
