// SPDX-License-Identifier: Apache-2.0
/** Time per frame of a motion for all lengths of a model, and for all moment arms besides; README.md says how to read
it. */
#include <CLI/CLI.hpp>
#include <iostream>

#include "frame_times.h"
#include "tautline/models/osim_reader.h"
#include "tautline/models/path_study.h"
#include "text_table.h"

namespace {

using namespace tautline;
using Clock = std::chrono::steady_clock;

/** Of each frame: all that `tautline solve` has of it [us]. */
std::vector<double> timeStudy(const models::ModelDescription& description, const Motion& motion) {
    models::PathStudy study(description);
    std::vector<double> times;
    for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
        const Clock::time_point begin = Clock::now();
        study.solve(motion.poses[frame], static_cast<int>(frame));
        times.push_back(calcMicroseconds(Clock::now() - begin));
    }
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
    for (const char* what : {"bodies", "lengths", "moment arms", "study"}) table.addColumn(what, "[us]");
    table.addColumn("anew");
    try {
        for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
            const models::ModelDescription description = models::readOsimFile(files[i]);
            const Motion motion = readMotion(files[i + 1], description, {});
            models::ModelSystem model(description);
            const FrameTimes times = timeFrames(model, motion);
            table.addRow({description.name, std::to_string(model.getPaths().size()),
                          std::to_string(motion.poses.size()), format(calcMedian(times.bodies), 1),
                          format(calcMedian(times.lengths), 1), format(calcMedian(times.arms), 1),
                          format(calcMedian(timeStudy(description, motion)), 1),
                          format(100 * times.coldShare, 1) + " %"});
        }
    } catch (const std::exception& error) {
        std::cerr << "model_lengths: " << error.what() << "\n";
        return 1;
    }
    table.print(std::cout);
    return 0;
}
