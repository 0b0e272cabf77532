// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "report_page.h"
#include "tautline/surfaces/solid_fit.h"

namespace tautline {

/** A page with the mesh that a solid was fitted to, in the color of how far it stands out of the solid, a needle at the
place that is farthest off, and a table of distances. */
ReportPage makeFitPage(const std::string& title, const SolidFit& fit);

}  // namespace tautline
