#include "tautline/path_problem.h"

#include "tautline/error.h"
#include "tautline/path_solution.h"

namespace tautline {

int PathProblem::addPoint(std::string name) {
    m_elements.push_back({std::move(name), nullptr, std::nullopt});
    return getNumElements() - 1;
}

int PathProblem::addObstacle(std::string name, std::shared_ptr<const Surface> surface, std::optional<Vec3> hint_S) {
    require(surface != nullptr, "path: obstacle '", name, "' has no surface");
    m_elements.push_back({std::move(name), std::move(surface), std::nullopt});
    setHint(getNumElements() - 1, hint_S);
    return getNumElements() - 1;
}

void PathProblem::setHint(int element, std::optional<Vec3> hint_S) {
    require(element >= 0 && element < getNumElements(), "path: no element ", element, " of ", getNumElements());
    require(!m_elements[element].isPoint(), "path: element '", m_elements[element].name,
            "' is a point and takes no hint");
    require(!hint_S || hint_S->allFinite(), "path: the hint of obstacle '", m_elements[element].name,
            "' is not finite");
    m_elements[element].hint_S = hint_S;
}

void PathProblem::validate() const {
    require(m_elements.size() >= 2, "path: needs an origin and an insertion, has ", m_elements.size(), " elements");
    require(m_elements.front().isPoint(), "path: begins with obstacle '", m_elements.front().name,
            "', not with a point");
    require(m_elements.back().isPoint(), "path: ends with obstacle '", m_elements.back().name, "', not with a point");
}

const char* getName(PathStatus status) {
    switch (status) {
        case PathStatus::Solved:
            return "solved";
        case PathStatus::NotMinimum:
            return "not_minimum";
        case PathStatus::LeftDomain:
            return "left_domain";
        case PathStatus::EndInside:
            return "end_inside";
        case PathStatus::NotConverged:
            return "not_converged";
    }
    return "unknown";
}

}  // namespace tautline
