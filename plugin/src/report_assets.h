// SPDX-License-Identifier: Apache-2.0
#pragma once

/** The parts of the report's page; those of other libraries are empty where they were missing at build time. */
namespace tautline::report {

extern const char* const kPage;
extern const char* const kStyle;
extern const char* const kScript;
extern const char* const kThree;
extern const char* const kControls;
extern const char* const kLines;
extern const char* const kChart;
extern const char* const kThreeLicense;
extern const char* const kChartLicense;

}  // namespace tautline::report
