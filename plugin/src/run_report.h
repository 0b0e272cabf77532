// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ostream>

#include "simulation.h"

namespace tautline {

/** The table of muscles at the end of a run, and what the run cost. */
void printRunTable(const models::ModelSystem& model, const SimulationResult& result, std::ostream& out);

}  // namespace tautline
