// SPDX-License-Identifier: Apache-2.0
// moment_arms MODEL.osim: lengths and moment arms of a model's paths over the flexion of its elbow.
#include <tautline/models/osim_reader.h>
#include <tautline/models/path_study.h>

#include <iostream>
using namespace tautline::models;

int main(int, char** argv) {
    ReadingOptions options;
    options.lengthsOnly = true;  // what only makes forces is not in the way
    PathStudy study(readOsimFile(argv[1], options));
    int numUnsound = 0;
    for (double angle = 1.6; angle < 2.2; angle += 0.2) {
        ModelPose pose;  // coordinates that it does not name stand at their defaults
        pose.values["elbow_flexion"] = angle;
        const PoseAnswer answer = study.solve(pose);
        for (std::size_t i = 0; i < answer.paths.size(); ++i) {
            const StudiedPath& path = study.getPaths()[i];
            const PathAnswer& found = answer.paths[i];
            std::cout << "elbow_flexion " << angle << ": " << path.name << " " << found.length << " m";
            for (std::size_t c = 0; c < path.coordinates.size(); ++c)
                std::cout << ", arm about " << path.coordinates[c] << " " << found.effectiveArms[c] << " m";
            std::cout << "\n";
            if (found.isSound()) continue;
            std::cout << "    " << found.explanation << "\n";
            ++numUnsound;
        }
    }
    return numUnsound;
}
