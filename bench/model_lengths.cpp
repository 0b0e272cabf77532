// SPDX-License-Identifier: Apache-2.0
/** Time per frame of a motion for all lengths of a model, and for all moment arms besides; README.md says how to read
it. */
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>

#include "motion_file.h"
#include "tautline/models/coordinate_coupling.h"
#include "tautline/models/model_system.h"
#include "tautline/models/osim_reader.h"
#include "tautline/models/path_study.h"
#include "tautline/simbody/mobility_screws.h"
#include "text_table.h"

namespace {

using namespace tautline;
using Clock = std::chrono::steady_clock;

double calcMicroseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::micro>(duration).count();
}

double calcMedian(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

struct FrameTimes {
    std::vector<double> bodies, lengths, arms;  ///< [us]
    std::vector<double> study;                  ///< all of a frame as `tautline solve` has it [us]
    double coldShare = 0;                       ///< of the solves over obstacles: found anew
};

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

/** Sets each frame, and times what is realized after that: the bodies, then all lengths, then all moment arms. Paths
are continued from frame to frame as PathStudy does. */
FrameTimes timeFrames(models::ModelSystem& model, const Motion& motion) {
    FrameTimes times;
    SimTK::State state = model.makeDefaultState();
    model.getCables().setContactMode(state, ContactMode::Free);
    const auto paths = model.getPaths();
    const std::vector<std::vector<int>> crossed = findCrossed(model);
    models::CoordinateCoupling coupling(model.getModel());
    MobilityScrews screws;
    SimTK::Vector unitForces;
    double sum = 0;
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
        for (const auto& path : paths) sum += path.cable.getLength(state);
        const Clock::time_point measured = Clock::now();
        coupling.update(state);
        screws.update(model.getModel().getMatter(), state);
        for (std::size_t p = 0; p < paths.size(); ++p) {
            paths[p].cable.calcUnitMobilityForces(state, screws, unitForces);
            for (const int coordinate : crossed[p]) sum += coupling.calcEffectiveArm(unitForces, coordinate);
        }
        const Clock::time_point end = Clock::now();
        times.bodies.push_back(calcMicroseconds(posed - begin));
        times.lengths.push_back(calcMicroseconds(measured - posed));
        times.arms.push_back(calcMicroseconds(end - measured));
    }
    times.coldShare = calcColdShare(model);
    if (sum == 0) std::cout << "\n";  // so that nothing is optimized away
    return times;
}

void timeStudy(const models::ModelDescription& description, const Motion& motion, FrameTimes& times) {
    models::PathStudy study(description);
    for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
        const Clock::time_point begin = Clock::now();
        study.solve(motion.poses[frame], static_cast<int>(frame));
        times.study.push_back(calcMicroseconds(Clock::now() - begin));
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Time per frame of a motion for all lengths and moment arms of a model (median)"};
    std::vector<std::string> files;
    app.add_option("MODEL MOTION", files, "pairs of a model and a motion")->required();
    CLI11_PARSE(app, argc, argv);
    TextTable table;
    table.addColumn("model", "", true);
    table.addColumn("paths");
    table.addColumn("frames");
    for (const char* what : {"bodies", "lengths", "moment arms", "study"}) table.addColumn(what, "[us]");
    table.addColumn("anew");
    try {
        for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
            const models::ModelDescription description = models::readOsimFile(files[i]);
            const Motion motion = readMotion(files[i + 1], description, {});
            models::ModelSystem model(description);
            FrameTimes times = timeFrames(model, motion);
            timeStudy(description, motion, times);
            table.addRow({description.name, std::to_string(model.getPaths().size()),
                          std::to_string(motion.poses.size()), format(calcMedian(times.bodies), 1),
                          format(calcMedian(times.lengths), 1), format(calcMedian(times.arms), 1),
                          format(calcMedian(times.study), 1), format(100 * times.coldShare, 1) + " %"});
        }
    } catch (const std::exception& error) {
        std::cerr << "model_lengths: " << error.what() << "\n";
        return 1;
    }
    table.print(std::cout);
    return 0;
}
