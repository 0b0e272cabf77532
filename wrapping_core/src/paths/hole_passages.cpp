#include "paths/hole_passages.h"

#include <algorithm>

#include "geodesics/arc_walker.h"
#include "paths/obstacle_walk.h"

namespace tautline {
namespace {

/** Walks along a portion of a path and counts. */
class PassageCounter {
public:
    PassageCounter(const Surface& surface, HolePassage& passage) : m_surface(surface), m_passage(passage) {}

    void start(const Vec3& p_S) { m_last = p_S; }
    void goTo(const Vec3& p_S) {
        const int crossings = m_surface.countHoleCrossings(m_last, p_S);
        if (crossings != 0) {
            const Vec3 axis = m_surface.getHoleAxis(), step = p_S - m_last;
            m_passage.through_S = m_last - axis.dot(m_last) / axis.dot(step) * step;
        }
        m_passage.count += crossings;
        m_last = p_S;
    }

private:
    const Surface& m_surface;
    HolePassage& m_passage;
    Vec3 m_last = Vec3::Zero();
};

/** The chord of a short arc passes the hole where the arc does; a long one is followed. */
void followArc(const Surface& surface, const ObstacleContact& contact, PassageCounter& counter) {
    const double size = surface.getSize();
    const int pieces =
        contact.start.length > size ? 1 + static_cast<int>(std::min(1000.0, 2 * contact.start.length / size)) : 1;
    ArcWalker walker(surface, contact.start, kRoughlyAlong, pieces);
    for (int i = 1; i < pieces; ++i) counter.goTo(walker.next().Q.x);
    counter.goTo(contact.geodesic.Q.x);
}

/** Calls visit(e, passage) for every obstacle with a hole, with its passages in `path`. */
template <class Visitor>
void visitHoles(const PathProblem& problem, const PathPose& pose, const PathSolution& path, Visitor visit) {
    visitObstaclesOnSegments(problem, pose, path, [&](int e, int in, int out) {
        const Surface& surface = *problem.getElement(e).surface;
        if (hasHole(surface))
            visit(e, calcHolePassage(surface, pose.X_GE[e], path.contacts[e], path.segments[in], path.segments[out]));
    });
}

}  // namespace

bool hasHole(const Surface& surface) {
    const Vec3 axis = surface.getHoleAxis();
    return surface.countHoleCrossings(-axis, axis) != 0;
}

HolePassage calcHolePassage(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact,
                            const StraightSegment& in, const StraightSegment& out) {
    HolePassage passage;
    passage.from = in.fromElement, passage.to = out.toElement;
    passage.A_S = X_GS.shiftBack(in.A), passage.B_S = X_GS.shiftBack(out.B);
    PassageCounter counter(surface, passage);
    counter.start(passage.A_S);
    if (contact.isTouched) {
        counter.goTo(contact.geodesic.P.x);
        followArc(surface, contact, counter);
    }
    counter.goTo(passage.B_S);
    return passage;
}

bool hasLeftHole(const Surface& surface, const HolePassage& before, const HolePassage& after) {
    if (!before.isKnown() || before.from != after.from || before.to != after.to) return false;
    return surface.countHoleCrossings(before.A_S, after.A_S) + after.count +
               surface.countHoleCrossings(after.B_S, before.B_S) - before.count !=
           0;
}

bool hasRightPassages(const PathProblem& problem, const PathPose& pose, const PassageRule& rule,
                      const PathSolution& path) {
    bool isRight = true;
    visitHoles(problem, pose, path, [&](int e, const HolePassage& passage) {
        if (rule.counts.empty())
            isRight = isRight && !hasLeftHole(*problem.getElement(e).surface, path.contacts[e].passage, passage);
        else if (rule.counts[e] != PassageRule::kAny)
            isRight = isRight && passage.count == rule.counts[e];
    });
    return isRight;
}

void updatePassages(const PathProblem& problem, const PathPose& pose, bool isConverged, PathSolution& path) {
    visitHoles(problem, pose, path, [&](int e, const HolePassage& passage) {
        ObstacleContact& contact = path.contacts[e];
        contact.hasLeftHole = hasLeftHole(*problem.getElement(e).surface, contact.passage, passage);
        if (isConverged && !contact.hasLeftHole) contact.passage = passage;
    });
}

}  // namespace tautline
