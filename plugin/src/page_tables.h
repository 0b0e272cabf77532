// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What the page shows of results beside the scene: curves, events and its table. */
#include <vector>

#include "report_page.h"
#include "simulation.h"
#include "tautline/models/path_study.h"

namespace tautline {

/** Of a run. @param model   in the state in which the run has ended */
ReportPage makeRunPage(const models::ModelSystem& model, const SimulationResult& result);

/** Of poses. Their events are changes from one pose to the next. */
ReportPage makeStudyPage(const models::PathStudy& study, const std::vector<double>& times,
                         const std::vector<models::PoseAnswer>& answers);

}  // namespace tautline
