// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <string>
#include <vector>

#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** Keeps what all cables of a subsystem do, at equal intervals of a study, and writes it as an OpenSim storage file:

    auto* reporter = new CableReporter(cables, 0.01);
    system.addEventReporter(reporter);          // which owns it then
    ...
    reporter->writeStorage("cables.sto");

Columns: `time`, and for each cable `<cable>|length` [m], `<cable>|rate` [m/s], and for each of its obstacles
`<cable>|contact.<obstacle>` (1 while touched); for each force that was added, `<cable>|tension` [N]. A cable that is
disabled has nan. */
class CableReporter : public SimTK::PeriodicEventReporter {
public:
    /** @param interval   [s], positive */
    CableReporter(const CablePathSubsystem& cables, SimTK::Real interval);
    /** Adds a column of tension; before the study. */
    void addForce(const CableForce& force);

    void handleEvent(const SimTK::State& state) const override;

    int getNumRows() const { return static_cast<int>(m_rows.size()); }
    std::vector<std::string> getLabels() const;
    const std::vector<SimTK::Real>& getRow(int row) const { return m_rows.at(row); }
    void clear() { m_rows.clear(); }

    /** @throws std::runtime_error naming the file if it cannot be written */
    void writeStorage(const std::string& file) const;

private:
    const CablePathSubsystem& m_cables;
    std::vector<CableForce> m_forces;
    mutable std::vector<std::vector<SimTK::Real>> m_rows;  ///< Simbody reports through const functions
};

}  // namespace tautline
