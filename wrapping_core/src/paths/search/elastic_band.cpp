// SPDX-License-Identifier: Apache-2.0
#include "paths/search/elastic_band.h"

#include <algorithm>
#include <cmath>

#include "tautline/paths/contact_switch.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

constexpr double kSpacingPerRoom = 0.3;  ///< node spacing over (obstacle size + distance): 20 nodes per turn
constexpr double kMovePerRoom = 0.3;     ///< farthest move of a node in a sweep: cannot pass a thin obstacle
constexpr int kMaxNodes = 4000, kMaxNodesPerElement = 60;  ///< the larger of both is the limit
constexpr int kLayingDepth = 6;                 ///< bisections of an edge that would cross a surface: 64 pieces
constexpr double kLayingDepthTolerance = 0.02;  ///< crossings shallower than this (in sizes) are left to the sweeps
constexpr std::size_t kNeighbors = 4;           ///< obstacles before and after a portion that its mesh allows for
constexpr double kTouching = 0.01;              ///< height in sizes below which a node counts as resting on a surface
constexpr int kSweepsPerMesh = 20;
constexpr double kTrusted = 0.25;  ///< part of its height that a node may travel before it is asked for again
constexpr long kMaxHeightsPerElement = 300000;  ///< heights over surfaces that one laying may ask for: its time
constexpr long kMaxLayings = 2;                 ///< so many times that is what all layings of a search may ask for
constexpr double kMaxRelaxation = 1.9;
constexpr double kDisturbance = 1e-3;  ///< of the room of a node: well below its spacing, well above where it rests
constexpr double kNodesPerTurn = 20;   ///< at the default fineness

int calcMaxNodes(const PathProblem& problem) {
    return std::max(kMaxNodes, kMaxNodesPerElement * problem.getNumElements());
}

/** Where a line along e that dips deepest below a surface at D is bent to: the foot of D, straight across from it. If
it is not across, D lies on an axis or a centre, and the foot may lie in a plane of symmetry in which the string would
stay: then the foot of a point beside D, in a direction that is special for no shape. */
Vector3 findBend(const Surface& surface, const Vector3& D_S, const Vector3& e_S) {
    constexpr double kAskew = 0.1, kBeside = 1e-3;  // cosine of the angle to the line; in sizes
    const Vector3 foot = surface.findSurfacePoint(D_S).p;
    if (std::abs(e_S.dot(foot - D_S)) <= kAskew * (foot - D_S).norm()) return foot;
    const Vector3 beside = makeTangent(Vector3(0.48, 0.64, 0.6), e_S);
    return surface.findSurfacePoint(D_S + kBeside * surface.getSize() * beside).p;
}

}  // namespace

void ElasticBand::lay(const PosedProblem& scene, const Waypoints& waypoints) {
    m_goesRoundWalls = false;
    layAlong(scene, waypoints);
}

void ElasticBand::layAlong(const PosedProblem& scene, const Waypoints& waypoints) {
    const PathProblem& problem = scene.problem;
    const PathPose& pose = scene.pose;
    m_nodes.clear();
    m_isFixed.clear();
    m_holds.clear();
    const long fair = kMaxHeightsPerElement * problem.getNumElements();
    m_maxHeights = std::min(m_numHeights + fair, kMaxLayings * fair);
    std::size_t firstOpen = 0;          // holds whose strand has not met its end yet
    int lastFixed = 0, lastGuided = 0;  // lastGuided: the first hold whose surface the next edge may cross
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!pose.hasElement(e)) continue;
        const bool isPoint = problem.getElement(e).isPoint();
        if (!isPoint) {
            m_holds.emplace_back();
            m_holds.back().element = e, m_holds.back().X_GS = pose.X_GE[e], m_holds.back().from = lastFixed;
        }
        const int current = static_cast<int>(m_holds.size()) - 1;
        for (const Vector3& guide : waypoints[e]) {
            if (!m_nodes.empty()) layEdge(problem, lastGuided, m_nodes.back(), guide, kLayingDepth);
            addNode(guide, isPoint);
            if (!isPoint) noteContact(m_holds[current], static_cast<int>(m_nodes.size()) - 1);
            lastGuided = isPoint ? current + 1 : current;
        }
        if (!isPoint) continue;
        lastFixed = static_cast<int>(m_nodes.size()) - 1;
        for (; firstOpen < m_holds.size(); ++firstOpen) m_holds[firstOpen].to = lastFixed;
    }
    m_extent = 0;
    for (std::size_t k = 0; k + 1 < m_nodes.size(); ++k) m_extent += (m_nodes[k + 1] - m_nodes[k]).norm();
}

/** Lays the string from A, the last node, towards B around the surfaces that this edge would cross: it is
bent outwards where it is deepest, and so on for both halves. B itself is not added. */
void ElasticBand::layEdge(const PathProblem& problem, int firstHold, Vector3 A, const Vector3& B, int depth) {
    int crossed = -1;
    double deepest = -kLayingDepthTolerance;
    Vector3 bend = Vector3::Zero();
    const double length = (B - A).norm();
    if (depth == 0 || !(length > 0)) return;
    for (int i = firstHold; i < static_cast<int>(m_holds.size()); ++i) {
        const Surface& surface = *problem.getElement(m_holds[i].element).surface;
        const Pose& X_GS = m_holds[i].X_GS;
        const Vector3 A_S = X_GS.shiftBack(A), e_S = X_GS.R.transpose() * (B - A) / length;
        const double s = surface.findLowestPoint(A_S, e_S, length);
        const Vector3 D_S = A_S + s * e_S;
        const double depthThere = surface.calcHeight(D_S) / surface.getSize();
        // An end below the surface is no bend: that obstacle is switched off, or the guide lies in another.
        if (!(depthThere < deepest) || s <= 0 || s >= length) continue;
        deepest = depthThere, crossed = i;
        bend = X_GS * findBend(surface, D_S, e_S);
    }
    if (crossed < 0) return;
    if (m_goesRoundWalls && layCourse(problem, firstHold, crossed, A, B, depth)) return;
    layEdge(problem, firstHold, A, bend, depth - 1);
    addNode(bend, false);
    noteContact(m_holds[crossed], static_cast<int>(m_nodes.size()) - 1);
    layEdge(problem, firstHold, bend, B, depth - 1);
}

void ElasticBand::addNode(const Vector3& x, bool isFixed) {
    m_nodes.push_back(x);
    m_isFixed.push_back(isFixed);
}

void ElasticBand::noteContact(Hold& hold, int node) {
    hold.first = hold.first < 0 ? node : std::min(hold.first, node);
    hold.last = std::max(hold.last, node);
}

void ElasticBand::relax(const PathProblem& problem, const BandLevel& level) {
    if (!(m_extent > 0)) return;
    double relaxation = 1;
    m_isAtRest = false;
    for (int i = 0; i < level.maxSweeps && m_numHeights < m_maxHeights; ++i) {
        updatePortions(problem);
        if (i % kSweepsPerMesh == 0) {
            if (m_goesRoundWalls)
                remeshRoundWalls(problem, level.fineness);
            else
                remesh(problem, level.fineness);
            updatePortions(problem);
            forgetHeights();
        }
        const double move = sweep(problem, relaxation, i % 2 == 0);
        // Plain steps first, while the string falls into place; then over-relaxation for the long waves.
        if (i > 2 * kSweepsPerMesh) relaxation = std::min(kMaxRelaxation, relaxation + 0.05);
        m_isAtRest = i > kSweepsPerMesh && move < level.tolerance;
        if (m_isAtRest) break;
    }
    updatePortions(problem);
}

/** Portions begin and end in path order: the first hold whose portion goes beyond a node. */
std::size_t ElasticBand::findFirstHold(int node) const {
    const auto first = std::partition_point(m_holds.begin(), m_holds.end(),
                                            [node](const Hold& hold) { return hold.portionEnd <= node; });
    return static_cast<std::size_t>(first - m_holds.begin());
}

/** Room at a point after a node: least of (size + distance) over the obstacles that act there or may soon, when
a neighbour lifts and their portions grow. */
double ElasticBand::calcRoom(const PathProblem& problem, const Vector3& x, int node) {
    double room = m_extent;
    const std::size_t first = findFirstHold(node);
    int beyond = 0;
    for (std::size_t i = first > kNeighbors ? first - kNeighbors : 0; i < m_holds.size(); ++i) {
        const Hold& hold = m_holds[i];
        if (hold.portionBegin > node && ++beyond > static_cast<int>(kNeighbors)) break;
        if (node < hold.from || node > hold.to) continue;
        const Surface& surface = *problem.getElement(hold.element).surface;
        const double height = surface.calcHeight(hold.X_GS.shiftBack(x));
        ++m_numHeights;
        room = std::min(room, surface.getSize() + std::max(0.0, height));
    }
    return room;
}

/** @param node   before x */
double ElasticBand::calcSpacing(const PathProblem& problem, double fineness, const Vector3& x, int node) {
    const double least = m_extent / calcMaxNodes(problem);
    return std::max(least, fineness * kSpacingPerRoom * calcRoom(problem, x, node));
}

/** New nodes along the polygon, closer where room is small; contacts keep their place on the string. */
void ElasticBand::remesh(const PathProblem& problem, double fineness) {
    const int maxNodes = calcMaxNodes(problem);
    std::vector<Vector3> nodes;
    std::vector<char> isFixed;
    std::vector<int> newIndex(m_nodes.size());  // of the new node at or just after an old one
    for (std::size_t k = 0; k < m_nodes.size(); ++k) {
        newIndex[k] = static_cast<int>(nodes.size());
        if (k + 1 == m_nodes.size() || m_isFixed[k] || nodes.empty()) {
            nodes.push_back(m_nodes[k]);
            isFixed.push_back(m_isFixed[k]);
        }
        if (k + 1 == m_nodes.size()) break;
        const Vector3 edge = m_nodes[k + 1] - m_nodes[k];
        // March along the edge; what is left of a step carries over to the next edge.
        const double length = edge.norm();
        double at = 0;
        while (static_cast<int>(nodes.size()) < maxNodes) {
            const double spacing = calcSpacing(problem, fineness, nodes.back(), static_cast<int>(k));
            // Where the last node lies relative to this edge: step from it to the sphere of radius `spacing`.
            const Vector3 toStart = m_nodes[k] - nodes.back();
            const Vector3 direction = length > 0 ? Vector3(edge / length) : Vector3(Vector3::Zero());
            const double b = toStart.dot(direction), c = toStart.squaredNorm() - spacing * spacing;
            const double discriminant = b * b - c;
            if (!(discriminant > 0) || !(length > 0)) break;
            const double next = -b + std::sqrt(discriminant);
            const double end = m_isFixed[k + 1] ? length - 0.5 * spacing : length;
            if (!(next > at) || next >= end) break;
            at = next;
            nodes.push_back(m_nodes[k] + at * direction);
            isFixed.push_back(0);
        }
    }
    takeMesh(problem, nodes, isFixed, newIndex);
}

/** @param newIndex   of the new node at or just after an old one */
void ElasticBand::takeMesh(const PathProblem& problem, std::vector<Vector3>& nodes, std::vector<char>& isFixed,
                           const std::vector<int>& newIndex) {
    for (Hold& hold : m_holds) {
        hold.from = newIndex[hold.from], hold.to = newIndex[hold.to];
        if (!hold.touches()) continue;
        const int last = static_cast<int>(nodes.size()) - 2;
        hold.first = std::clamp(newIndex[hold.first], 1, std::max(1, last));
        hold.last = std::clamp(newIndex[hold.last], hold.first, std::max(hold.first, last));
    }
    m_nodes.swap(nodes);
    m_isFixed.swap(isFixed);
    m_room.assign(m_nodes.size(), m_extent);
    const double least = m_extent / calcMaxNodes(problem);
    m_stiffness.resize(m_nodes.size());
    for (std::size_t k = 0; k + 1 < m_nodes.size(); ++k)
        m_stiffness[k] = 1 / std::max(least * 1e-3, (m_nodes[k + 1] - m_nodes[k]).norm());
}

/** Each obstacle acts from the last contact before it (in path order) to the first contact after it. */
void ElasticBand::updatePortions(const PathProblem& problem) {
    const int n = static_cast<int>(m_holds.size());
    int before = 0;
    for (int i = 0; i < n; ++i) {
        before = std::max(before, m_holds[i].from);
        m_holds[i].portionBegin = before;
        if (m_holds[i].touches()) before = std::max(before, m_holds[i].last);
    }
    int after = static_cast<int>(m_nodes.size()) - 1;
    for (int i = n - 1; i >= 0; --i) {
        Hold& hold = m_holds[i];
        after = std::min(after, hold.to);
        hold.portionEnd = after;
        if (hold.touches()) after = std::min(after, hold.first);
        const Surface& surface = *problem.getElement(hold.element).surface;
        const auto isInside = [&](int node) {
            return surface.calcHeight(hold.X_GS.shiftBack(m_nodes[node])) < kContactTolerance * surface.getSize();
        };
        hold.isSwitchedOff = isInside(hold.from) || isInside(hold.to);
    }
}

/** One projected sweep over all nodes. @return largest move relative to the room of the node */
double ElasticBand::sweep(const PathProblem& problem, double relaxation, bool isForward) {
    for (Hold& hold : m_holds) hold.first = hold.last = -1;
    double largest = 0;
    const int n = static_cast<int>(m_nodes.size());
    for (int step = 1; step + 1 < n; ++step) {
        const int k = isForward ? step : n - 1 - step;
        if (m_isFixed[k]) continue;
        const Vector3 old = m_nodes[k];
        const double left = m_stiffness[k - 1], right = m_stiffness[k];
        Vector3 move = relaxation * ((left * m_nodes[k - 1] + right * m_nodes[k + 1]) / (left + right) - old);
        const double limit = kMovePerRoom * m_room[k], length = move.norm();
        if (length > limit) move *= limit / length;
        moveNode(k, old + move);
        double room = m_extent;
        pushOut(problem, k, room);
        if (m_goesRoundWalls) keepEdgesClear(problem, k, old, room);
        m_room[k] = room;
        largest = std::max(largest, (m_nodes[k] - old).norm() / room);
    }
    return largest;
}

void ElasticBand::forgetHeights() {
    m_travel.assign(m_nodes.size(), 0);
    for (Hold& hold : m_holds) {
        hold.seenFrom = hold.portionBegin;
        hold.seen.assign(std::max(0, hold.portionEnd - hold.portionBegin + 1), SeenHeight());
    }
}

void ElasticBand::moveNode(int node, const Vector3& x) {
    m_travel[node] += (x - m_nodes[node]).norm();
    m_nodes[node] = x;
}

/** Moves a node out of the obstacles that act on it and notes the contacts. A height changes by about as much as the
node travels: far above a surface it need not be asked for in every sweep. */
void ElasticBand::pushOut(const PathProblem& problem, int node, double& room) {
    for (std::size_t i = findFirstHold(node); i < m_holds.size() && m_holds[i].portionBegin < node; ++i) {
        Hold& hold = m_holds[i];
        if (hold.isSwitchedOff) continue;
        const Surface& surface = *problem.getElement(hold.element).surface;
        const double size = surface.getSize();
        SeenHeight* const seen = hold.findSeen(node);
        const double moved = seen ? m_travel[node] - seen->travel : kInfinity;
        if (seen && moved < kTrusted * seen->height) {
            room = std::min(room, size + seen->height - moved);
            continue;
        }
        Vector3 N_S, p_S = hold.X_GS.shiftBack(m_nodes[node]);
        const double height = surface.calcHeightAndNormal(p_S, N_S);
        if (seen) *seen = {height, m_travel[node]};
        ++m_numHeights;
        room = std::min(room, size + std::max(0.0, height));
        if (height > 0) continue;
        if (height > -0.02 * size)
            moveNode(node, hold.X_GS * Vector3(p_S - height * N_S));
        else
            moveNode(node, hold.X_GS * surface.findSurfacePoint(p_S).p);
        noteContact(hold, node);
    }
}

/** Height of a node above a surface, in its sizes. */
double ElasticBand::calcHeight(const PathProblem& problem, const Hold& hold, int node) const {
    const Surface& surface = *problem.getElement(hold.element).surface;
    return surface.calcHeight(hold.X_GS.shiftBack(m_nodes[node])) / surface.getSize();
}

bool ElasticBand::restsOn(const PathProblem& problem, const Hold& hold, int node) const {
    return !hold.isSwitchedOff && hold.from < node && node < hold.to && calcHeight(problem, hold, node) < kTouching;
}

std::vector<StringFault> ElasticBand::findGrooves(const PathProblem& problem) const {
    std::vector<StringFault> grooves;
    const Hold* before = nullptr;
    for (const Hold& hold : m_holds) {
        if (!hold.touches()) continue;
        if (before && hold.first < before->last)
            grooves.push_back({StringFault::Kind::OutOfOrder, before->element, hold.element});
        before = &hold;
    }
    for (const Hold& hold : m_holds)
        for (const Hold& other : m_holds)
            if (&other != &hold && hold.touches() && liesInGroove(problem, hold, other))
                grooves.push_back({StringFault::Kind::Groove, hold.element, other.element});
    return grooves;
}

bool ElasticBand::liesInGroove(const PathProblem& problem, const Hold& hold, const Hold& other) const {
    for (int k = hold.first; k <= hold.last; ++k)
        if (!m_isFixed[k] && restsOn(problem, other, k)) return true;
    return false;
}

StringFault ElasticBand::findFault(const PathProblem& problem) const {
    if (const std::vector<StringFault> grooves = findGrooves(problem); !grooves.empty()) return grooves.front();
    for (const Hold& hold : m_holds)
        if (!m_isAtRest && hold.touches()) return {StringFault::Kind::Sliding, hold.element, -1};
    if (!m_isAtRest) return {StringFault::Kind::Sliding, -1, -1};
    return {};
}

void ElasticBand::move(int element, const Vector3& by_G) {
    for (const Hold& hold : m_holds) {
        if (hold.element != element || !hold.touches()) continue;
        for (int k = hold.first; k <= hold.last; ++k)
            if (!m_isFixed[k]) m_nodes[k] += by_G;
    }
}

void ElasticBand::disturb() {
    for (std::size_t k = 0; k < m_nodes.size(); ++k) {
        const double phase = 1.0 + static_cast<double>(k) / kNodesPerTurn;
        if (!m_isFixed[k])
            m_nodes[k] += kDisturbance * m_room[k] * Vector3(std::sin(phase), std::sin(2 * phase), std::sin(3 * phase));
    }
}

void ElasticBand::extractContacts(const PosedProblem& scene, std::vector<ObstacleContact>& contacts) const {
    contacts.resize(scene.size());
    for (ObstacleContact& contact : contacts) {
        contact.isTouched = contact.isSwitchedOff = false;
        contact.furtherArcs.clear();
    }
    for (const Hold& hold : m_holds) {
        ObstacleContact& contact = contacts[hold.element];
        contact.isSwitchedOff = hold.isSwitchedOff;
        contact.isTouched = hold.touches() && !hold.isSwitchedOff;
        if (!contact.isTouched) continue;
        // From contact to contact, but not over nodes that are clear of the surface between.
        int numArcs = 0, first = hold.first;
        const auto addArc = [&](int last) {
            if (numArcs++ > 0) contact.furtherArcs.emplace_back();
            contact.updArc(numArcs - 1) = makeArc(scene, hold, first, last);
        };
        for (int k = hold.first + 1; k <= hold.last; ++k) {
            if (!(calcHeight(scene.problem, hold, k) > kTouching)) continue;
            const int last = k - 1;
            while (calcHeight(scene.problem, hold, k) > kTouching && k < hold.last) ++k;
            addArc(last);
            first = k;
        }
        addArc(hold.last);
    }
}

/** The arc next to the nodes from one to another. */
ContactArc ElasticBand::makeArc(const PosedProblem& scene, const Hold& hold, int first, int last) const {
    const std::vector<Vector3> touching(m_nodes.begin() + first, m_nodes.begin() + last + 1);
    ContactArc arc;
    arc.start = calcArcAlong(scene.getSurface(hold.element), scene.getPose(hold.element), m_nodes[first - 1], touching,
                             m_nodes[last + 1]);
    return arc;
}

}  // namespace tautline
