// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>

#include "simulation.h"

namespace tautline {

/** Says what was read over and how the file's muscles and wraps were understood. */
void printModelNotes(const models::ModelDescription& description, const models::ModelSystem& model, std::ostream& out);

/** The table of muscles at the end of a run, and what the run cost. */
void printRunTable(const models::ModelSystem& model, const SimulationResult& result, std::ostream& out);

/** A bar on a terminal, nothing elsewhere. */
class ProgressBar {
public:
    explicit ProgressBar(std::ostream& out, bool isShown) : m_out(out), m_isShown(isShown) {}
    void show(double share);
    void clear();

private:
    std::ostream& m_out;
    bool m_isShown;
    int m_percent = -1;
};

}  // namespace tautline
