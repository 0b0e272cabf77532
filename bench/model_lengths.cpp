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
};

/** Sets each frame, and times what is realized after that: the bodies, then all lengths, then all moment arms. */
FrameTimes timeFrames(models::ModelSystem& model, const Motion& motion) {
    FrameTimes times;
    SimTK::State state = model.makeDefaultState();
    SimTK::Vector unitForces;
    double sum = 0;
    for (const models::ModelPose& pose : motion.poses) {
        for (const auto& [name, value] : pose.values) model.getModel().setCoordinate(state, name, value);
        model.getModel().applyCouplers(state);
        model.getSystem().realize(state, SimTK::Stage::Time);
        const Clock::time_point begin = Clock::now();
        model.getModel().getMatter().getSubsystemGuts().realizeSubsystemPosition(state);
        const Clock::time_point posed = Clock::now();
        model.getSystem().realize(state, SimTK::Stage::Position);
        for (const auto& path : model.getPaths()) sum += path.cable.getLength(state);
        const Clock::time_point measured = Clock::now();
        const models::CoordinateCoupling coupling(model.getModel(), state);
        for (const auto& path : model.getPaths()) {
            path.cable.calcUnitMobilityForces(state, unitForces);
            for (int i = 0; i < coupling.getNumCoordinates(); ++i) sum += coupling.calcEffectiveArm(unitForces, i);
        }
        const Clock::time_point end = Clock::now();
        times.bodies.push_back(calcMicroseconds(posed - begin));
        times.lengths.push_back(calcMicroseconds(measured - posed));
        times.arms.push_back(calcMicroseconds(end - measured));
    }
    if (sum == 0) std::cout << "\n";  // so that nothing is optimized away
    return times;
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
    for (const char* what : {"bodies", "lengths", "moment arms"}) table.addColumn(what, "[us]");
    try {
        for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
            const models::ModelDescription description = models::readOsimFile(files[i]);
            const Motion motion = readMotion(files[i + 1], description, {});
            models::ModelSystem model(description);
            const FrameTimes times = timeFrames(model, motion);
            table.addRow({description.name, std::to_string(model.getPaths().size()),
                          std::to_string(motion.poses.size()), format(calcMedian(times.bodies), 1),
                          format(calcMedian(times.lengths), 1), format(calcMedian(times.arms), 1)});
        }
    } catch (const std::exception& error) {
        std::cerr << "model_lengths: " << error.what() << "\n";
        return 1;
    }
    table.print(std::cout);
    return 0;
}
