// SPDX-License-Identifier: Apache-2.0
#include "frame_times.h"

#include <algorithm>
#include <iostream>

#include "tautline/models/coordinate_coupling.h"
#include "tautline/paths/parallel_blocks.h"
#include "tautline/simbody/mobility_screws.h"

namespace tautline {
namespace {

using Clock = std::chrono::steady_clock;

/** The coordinates that each path crosses. */
std::vector<std::vector<int>> findCrossed(const models::ModelSystem& model) {
    const std::vector<std::string>& names = model.getModel().getCoordinateNames();
    std::vector<std::vector<int>> crossed;
    for (const auto& path : model.getPaths()) {
        crossed.emplace_back();
        for (const std::string& name : path.coordinates)
            crossed.back().push_back(static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
    }
    return crossed;
}

double calcColdShare(const models::ModelSystem& model) {
    long cold = 0, all = 0;
    for (const auto& path : model.getPaths()) {
        if (path.cable.getNumObstacles() == 0) continue;
        cold += path.cable.getStatistics().numColdSolves;
        all += path.cable.getStatistics().numSolves;
    }
    return all == 0 ? 0 : static_cast<double>(cold) / static_cast<double>(all);
}

}  // namespace

double calcMicroseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::micro>(duration).count();
}

double calcMedian(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

FrameTimes timeFrames(models::ModelSystem& model, const Motion& motion, std::vector<FrameAnswers>* answers) {
    FrameTimes times;
    SimTK::State state = model.makeDefaultState();
    model.getCables().setContactMode(state, ContactMode::Free);
    const auto paths = model.getPaths();
    const std::vector<std::vector<int>> crossed = findCrossed(model);
    models::CoordinateCoupling coupling(model.getModel());
    MobilityScrews screws;
    SimTK::Vector unitForces;
    FrameAnswers found{std::vector<double>(paths.size()), {}};
    for (const std::vector<int>& coordinates : crossed) found.momentArms.emplace_back(coordinates.size());
    for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
        if (frame % kPosesPerBlock == 0)
            model.getCables().forgetPaths(state);
        else
            model.getCables().acceptPaths(state);
        for (const auto& [name, value] : motion.poses[frame].values) model.getModel().setCoordinate(state, name, value);
        model.getModel().applyCouplers(state);
        model.getSystem().realize(state, SimTK::Stage::Time);
        const Clock::time_point begin = Clock::now();
        model.getModel().getMatter().getSubsystemGuts().realizeSubsystemPosition(state);
        const Clock::time_point posed = Clock::now();
        model.getSystem().realize(state, SimTK::Stage::Position);
        for (std::size_t p = 0; p < paths.size(); ++p) found.lengths[p] = paths[p].cable.getLength(state);
        const Clock::time_point measured = Clock::now();
        coupling.update(state);
        screws.update(model.getModel().getMatter(), state);
        for (std::size_t p = 0; p < paths.size(); ++p) {
            paths[p].cable.calcUnitMobilityForces(state, screws, unitForces);
            for (std::size_t c = 0; c < crossed[p].size(); ++c)
                found.momentArms[p][c] = coupling.calcEffectiveArm(unitForces, crossed[p][c]);
        }
        const Clock::time_point end = Clock::now();
        times.bodies.push_back(calcMicroseconds(posed - begin));
        times.lengths.push_back(calcMicroseconds(measured - posed));
        times.arms.push_back(calcMicroseconds(end - measured));
        if (answers) answers->push_back(found);
    }
    times.coldShare = calcColdShare(model);
    return times;
}

}  // namespace tautline
