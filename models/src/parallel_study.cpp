// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/parallel_study.h"

#include <utility>

namespace tautline::models {

ParallelStudy::ParallelStudy(ModelDescription description, std::function<bool(const std::string&)> isWanted)
    : m_description(std::move(description)), m_isWanted(std::move(isWanted)) {
    m_studies.emplace_back(m_description, m_isWanted);
}

bool ParallelStudy::solveMany(int count, const std::function<ModelPose(int)>& makePose,
                              std::vector<PoseAnswer>& answers, const Threads& threads) {
    const auto numWorkers = static_cast<std::size_t>(countWorkers(count, kPosesPerBlock, threads));
    while (m_studies.size() < numWorkers) m_studies.emplace_back(m_description, m_isWanted);
    answers.resize(static_cast<std::size_t>(count));
    return runBlocks(count, kPosesPerBlock, threads, [&](int worker, int place) {
        answers[static_cast<std::size_t>(place)] =
            m_studies[static_cast<std::size_t>(worker)].solve(makePose(place), place);
    });
}

}  // namespace tautline::models
