#include "tautline/path_passages.h"

namespace tautline {
namespace {

/** Calls visit(surface, contact, passage, element) for every obstacle with a hole, with its passages in `path`. */
template <class Visitor>
void visitHoles(const PathProblem& problem, const PathPose& pose, const PathSolution& path, Visitor visit) {
    std::size_t in = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e)) continue;
        while (in + 1 < path.segments.size() && path.segments[in].toElement < e) ++in;
        if (!hasHole(*element.surface)) continue;
        const ObstacleContact& contact = path.contacts[e];
        const StraightSegment& out = path.segments[contact.isTouched ? in + 1 : in];
        visit(element, contact, calcHolePassage(*element.surface, pose.X_GE[e], contact, path.segments[in], out), e);
    }
}

}  // namespace

bool hasRightPassages(const PathProblem& problem, const PathPose& pose, PassageRule rule, const PathSolution& path) {
    bool isRight = true;
    visitHoles(problem, pose, path,
               [&](const PathElement& element, const ObstacleContact& contact, const HolePassage& passage, int) {
                   const auto* thread = std::get_if<ThreadHole>(&element.hint);
                   if (rule == PassageRule::AsBefore)
                       isRight = isRight && !hasLeftHole(*element.surface, contact.passage, passage);
                   else if (thread)
                       isRight = isRight && passage.count == thread->passages;
               });
    return isRight;
}

void updatePassages(const PathProblem& problem, const PathPose& pose, bool isConverged, PathSolution& path) {
    visitHoles(problem, pose, path,
               [&](const PathElement& element, const ObstacleContact& contact, const HolePassage& passage, int e) {
                   path.contacts[e].hasLeftHole = hasLeftHole(*element.surface, contact.passage, passage);
                   if (isConverged && !path.contacts[e].hasLeftHole) path.contacts[e].passage = passage;
               });
}

}  // namespace tautline
