// SPDX-License-Identifier: Apache-2.0
#include "paths/search/threading.h"

#include <algorithm>

#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

/** Walks along a portion of a path and counts. */
class PassageCounter {
public:
    PassageCounter(const Hole& hole, HolePassage& passage) : m_hole(hole), m_passage(passage) {}

    void start(const Vector3& p_S) { m_last = p_S; }
    void goTo(const Vector3& p_S) {
        const int crossings = m_hole.countCrossings(m_last, p_S);
        if (crossings != 0) m_passage.through_S = m_hole.calcPlaneCrossing(m_last, p_S);
        m_passage.count += crossings;
        m_last = p_S;
    }

private:
    const Hole m_hole;
    HolePassage& m_passage;
    Vector3 m_last = Vector3::Zero();
};

/** The chord of a short arc passes the hole where the arc does; a long one is followed.
@param surface, contact   whose arc it is
@param X_HS               its frame in that of the surface with the hole
@param holeSize           of that surface [m] */
void followArc(const Surface& surface, const ContactArc& contact, const Pose& X_HS, double holeSize,
               PassageCounter& counter) {
    const double size = std::min(surface.getSize(), holeSize);
    const int pieces =
        contact.start.length > size ? 1 + static_cast<int>(std::min(1000.0, 2 * contact.start.length / size)) : 1;
    counter.goTo(X_HS * contact.geodesic.P.x);
    ArcWalker walker(surface, contact.start, kRoughlyAlong, pieces);
    for (int i = 1; i < pieces; ++i) counter.goTo(X_HS * walker.next().Q.x);
    counter.goTo(X_HS * contact.geodesic.Q.x);
}

/** The passage of a portion that reaches as far as one before it did, where the path still goes by its ends. */
HolePassage calcComparablePassage(const PosedProblem& scene, const PathSolution& path, int e, const HolePassage& before,
                                  const HolePassage& own) {
    if (!before.isKnown() || (before.from >= own.from && before.to <= own.to)) return own;
    const auto find = [&](int StraightSegment::*end, int element) {
        std::size_t k = 0;
        while (k < path.segments.size() && path.segments[k].*end != element) ++k;
        return k;
    };
    std::size_t first = find(&StraightSegment::fromElement, std::min(before.from, own.from));
    std::size_t last = find(&StraightSegment::toElement, std::max(before.to, own.to));
    if (first == path.segments.size()) first = find(&StraightSegment::fromElement, own.from);
    if (last == path.segments.size()) last = find(&StraightSegment::toElement, own.to);
    return calcHolePassage(scene, path, e, first, last);
}

/** Calls visit(e, passage, isLeft) for every obstacle with a hole: its passages in `path`, and whether that has left
the hole since the passages that are kept. */
template <class Visitor>
void visitHoles(const PosedProblem& scene, const PathSolution& path, Visitor visit) {
    if (!scene.problem.hasHoles()) return;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        if (!scene.problem.getElement(e).hasHole) return;
        const std::optional<Hole> hole = scene.getSurface(e).getHole();
        const HolePassage passage = calcHolePassage(scene, path, e, in, out), &kept = path.contacts[e].passage;
        const HolePassage comparable = calcComparablePassage(scene, path, e, kept, passage);
        visit(e, passage, hasLeftHole(*hole, kept, comparable));
    });
}

}  // namespace

HolePassage calcHolePassage(const PosedProblem& scene, const PathSolution& path, int e, std::size_t first,
                            std::size_t last) {
    const Pose& X_GH = scene.getPose(e);
    HolePassage passage;
    passage.from = path.segments[first].fromElement, passage.to = path.segments[last].toElement;
    passage.A_S = X_GH.shiftBack(path.segments[first].A), passage.B_S = X_GH.shiftBack(path.segments[last].B);
    PassageCounter counter(*scene.getSurface(e).getHole(), passage);
    counter.start(passage.A_S);
    for (std::size_t k = first; k < last; ++k) {
        const int between = path.segments[k].toElement;
        if (scene.isPoint(between)) {
            counter.goTo(X_GH.shiftBack(path.segments[k].B));
            continue;
        }
        const Pose& X_GS = scene.getPose(between);
        const Pose X_HS(X_GH.R.transpose() * X_GS.R, X_GH.shiftBack(X_GS.p));
        followArc(scene.getSurface(between), path.getArcAfter(path.segments[k]), X_HS, scene.getSurface(e).getSize(),
                  counter);
    }
    counter.goTo(passage.B_S);
    return passage;
}

bool hasLeftHole(const Hole& hole, const HolePassage& before, const HolePassage& after) {
    if (!before.isKnown()) return false;
    return hole.countCrossings(before.A_S, after.A_S) + after.count + hole.countCrossings(after.B_S, before.B_S) -
               before.count !=
           0;
}

bool hasRightPassages(const PosedProblem& scene, const PassageRule& rule, const PathSolution& path) {
    bool isRight = true;
    visitHoles(scene, path, [&](int e, const HolePassage& passage, bool isLeft) {
        if (rule.counts.empty())
            isRight = isRight && !isLeft;
        else if (rule.counts[e] != PassageRule::kAny)
            isRight = isRight && passage.count == rule.counts[e];
    });
    return isRight;
}

void updatePassages(const PosedProblem& scene, bool isConverged, PathSolution& path) {
    visitHoles(scene, path, [&](int e, const HolePassage& passage, bool isLeft) {
        ObstacleContact& contact = path.contacts[e];
        contact.hasLeftHole = isLeft || (contact.hasLeftHole && !contact.passage.isKnown());
        if (isConverged && !contact.hasLeftHole) contact.passage = passage;
    });
}

bool hasLeftAnyHole(const PathSolution& path) {
    return std::any_of(path.contacts.begin(), path.contacts.end(),
                       [](const ObstacleContact& contact) { return contact.hasLeftHole; });
}

void giveUpLostHoles(PathSolution& path) {
    for (ObstacleContact& contact : path.contacts)
        if (contact.hasLeftHole) contact.passage = HolePassage();
}

}  // namespace tautline
