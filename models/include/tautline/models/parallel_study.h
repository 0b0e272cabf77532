// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "tautline/models/path_study.h"

namespace tautline::models {

/** The paths of a model in many poses, on several threads: a PathStudy for each thread, which share the poses block by
block. The answers are those of one PathStudy that solves the row from its beginning, to the last bit, whatever the
number of threads. */
class ParallelStudy {
public:
    /** As of PathStudy. */
    explicit ParallelStudy(ModelDescription description, std::function<bool(const std::string&)> isWanted = nullptr);

    /** For the names of paths and coordinates; valid as long as this. */
    const PathStudy& getStudy() const { return m_studies.front(); }

    /** @param makePose   of each place in the row; called by several threads at once
    @param answers   one for each pose
    @return false if it was interrupted: what `answers` holds then is not whole
    @throws as PathStudy::solve() does for the first pose that is refused */
    bool solveMany(int count, const std::function<ModelPose(int place)>& makePose, std::vector<PoseAnswer>& answers,
                   const Threads& threads = {});

private:
    ModelDescription m_description;
    std::function<bool(const std::string&)> m_isWanted;
    std::deque<PathStudy> m_studies;  ///< by worker; made once they are needed, without moving the others
};

}  // namespace tautline::models
