// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <vector>

#include "motion_file.h"
#include "tautline/models/model_system.h"

namespace tautline {

/** What the frames of a motion take, each [us]. */
struct FrameTimes {
    std::vector<double> bodies;   ///< their poses
    std::vector<double> lengths;  ///< of all paths, besides
    std::vector<double> arms;     ///< all effective moment arms, besides
    double coldShare = 0;         ///< of the solves over obstacles: found anew
};

/** What the paths of a model are in a frame. */
struct FrameAnswers {
    std::vector<double> lengths;                  ///< by path [m]
    std::vector<std::vector<double>> momentArms;  ///< by path and coordinate that it crosses, effective [m]
};

/** Sets each frame, and times what is realized after that: the bodies, then all lengths, then all moment arms. Paths
are continued from frame to frame as PathStudy does.
@param answers   if not null, by frame: what was timed */
FrameTimes timeFrames(models::ModelSystem& model, const Motion& motion, std::vector<FrameAnswers>* answers = nullptr);

double calcMicroseconds(std::chrono::steady_clock::duration duration);
double calcMedian(std::vector<double> numbers);

}  // namespace tautline
