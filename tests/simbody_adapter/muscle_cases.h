// SPDX-License-Identifier: Apache-2.0
#pragma once
/** One of each muscle model, and variants that take another way through the equations. */
#include <memory>
#include <string>
#include <vector>

#include "tautline/muscles/curve_muscles.h"
#include "tautline/muscles/de_groote_fregly_2016.h"
#include "tautline/muscles/millard_2012.h"
#include "tautline/muscles/thelen_2003.h"
#include "tautline/muscles/thelen_2003_deprecated.h"

namespace tautline::testing {

struct MuscleCase {
    std::string name;
    std::shared_ptr<const MuscleModel> model;
};

/** Pennated, and no parameter at its default that all models share. */
template <class Parameters>
Parameters makeTypical() {
    Parameters p;
    p.maxIsometricForce = 730;
    p.optimalFiberLength = 0.08;
    p.tendonSlackLength = 0.21;
    p.pennationAtOptimal = 0.3;
    p.maxContractionVelocity = 9;
    return p;
}

/** Smooth stand-ins for SIMM's tables. */
inline CurveMuscleParameters makeTypicalCurves() {
    auto p = makeTypical<CurveMuscleParameters>();
    p.activeForceLength = [](double l) { return std::exp(-(l - 1) * (l - 1) / 0.3); };
    p.passiveForceLength = [](double l) { return l > 1 ? 4 * (l - 1) * (l - 1) * (l - 1) : 0; };
    p.tendonForceStrain = [](double e) { return 900 * e * e / (1 + 20 * e); };
    p.fiberDamping = 0.1;
    p.defaultActivation = 0.05;
    return p;
}

inline double calcTypicalForceVelocity(double v) {
    return v <= 0 ? (1 + v) / (1 - 4 * v) : 1 + 0.7 * v / (v + 0.14);
}

inline std::vector<MuscleCase> makeMuscleCases() {
    std::vector<MuscleCase> cases;
    const auto add = [&](const std::string& name, std::shared_ptr<const MuscleModel> model) {
        cases.push_back({name, std::move(model)});
    };
    add("Thelen2003", std::make_shared<Thelen2003>(makeTypical<Thelen2003Parameters>()));
    add("Thelen2003Deprecated", std::make_shared<Thelen2003Deprecated>(makeTypical<Thelen2003DeprecatedParameters>()));
    add("DeGrooteFregly2016", std::make_shared<DeGrooteFregly2016>(makeTypical<DeGrooteFregly2016Parameters>()));
    auto damped = makeTypical<DeGrooteFregly2016Parameters>();
    damped.fiberDamping = 0.05;
    add("DeGrooteFregly2016 damped", std::make_shared<DeGrooteFregly2016>(damped));
    auto millard = makeTypical<Millard2012Parameters>();
    add("Millard2012", std::make_shared<Millard2012>(millard));
    millard.fiberDamping = 0;
    add("Millard2012 classic", std::make_shared<Millard2012>(millard));
    millard.fiberDamping = 0.1, millard.ignoresTendonCompliance = true;
    add("Millard2012 rigid", std::make_shared<Millard2012>(millard));
    auto tendonless = makeTypical<Thelen2003Parameters>();
    tendonless.tendonSlackLength = 0;
    add("Thelen2003 tendonless", std::make_shared<Thelen2003>(tendonless));
    auto straight = makeTypical<Thelen2003Parameters>();
    straight.pennationAtOptimal = 0;
    add("Thelen2003 straight", std::make_shared<Thelen2003>(straight));
    add("Schutte1993", std::make_shared<Schutte1993>(makeTypicalCurves()));
    add("Delp1990", std::make_shared<Delp1990>(makeTypicalCurves(), calcTypicalForceVelocity));
    add("RigidTendonMuscle", std::make_shared<RigidTendonMuscle>(makeTypicalCurves(), calcTypicalForceVelocity));
    return cases;
}

}  // namespace tautline::testing
