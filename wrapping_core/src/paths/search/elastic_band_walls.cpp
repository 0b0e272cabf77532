// SPDX-License-Identifier: Apache-2.0
/** Where walls are thinner than the edges of an elastic band are long, its nodes pass from one side to the other
without ever being inside. Here the band is laid round such walls, and no node moves so that an edge beside it sinks
into one. */
#include <algorithm>
#include <cmath>

#include "paths/search/clear_course.h"
#include "paths/search/elastic_band.h"

namespace tautline {
namespace {

constexpr double kWallDepth = 0.02;  ///< in sizes: a chord over a bend dips no deeper below it at the default fineness
constexpr double kEdgeDepth = 5e-3;  ///< the same where edges are watched: less than the depth of a thin wall's middle
constexpr double kLongest = 1.5;     ///< of an edge, in spacings
constexpr double kLeast = 0.05;      ///< the same of one that is cut where it is in the way

}  // namespace

void ElasticBand::layRoundWalls(const PosedProblem& scene, const Waypoints& waypoints) {
    m_goesRoundWalls = true;
    layAlong(scene, waypoints);
}

/** Round the walls of one surface, and by bends around the others. */
bool ElasticBand::layCourse(const PathProblem& problem, int firstHold, int hold, const Vector3& A, const Vector3& B,
                            int depth) {
    const Surface& surface = *problem.getElement(m_holds[hold].element).surface;
    const Pose X_GS = m_holds[hold].X_GS;
    std::vector<Vector3> corners;
    if (surface.isConvex() || !findClearCourse(surface, X_GS.shiftBack(A), X_GS.shiftBack(B), corners, m_numHeights))
        return false;
    Vector3 last = A;
    for (const Vector3& corner_S : corners) {
        const Vector3 corner = X_GS * corner_S;
        layEdge(problem, firstHold, last, corner, depth - 1);
        addNode(corner, false);
        noteContact(m_holds[hold], static_cast<int>(m_nodes.size()) - 1);
        last = corner;
    }
    layEdge(problem, firstHold, last, B, depth - 1);
    return true;
}

/** Nodes stay, but those that the edges beside them can do without; long edges, and those that keep their ends from
moving, are cut. So no edge comes to lie in a wall. */
void ElasticBand::remeshRoundWalls(const PathProblem& problem, double fineness) {
    std::vector<Vector3> nodes{m_nodes[0]};
    std::vector<char> isFixed{m_isFixed[0]};
    std::vector<int> newIndex(m_nodes.size(), 0);
    const int last = static_cast<int>(m_nodes.size()) - 1;
    for (int k = 1; k <= last; ++k) {
        const Vector3 from = nodes.back();
        const double spacing = calcSpacing(problem, fineness, m_nodes[k], k - 1);
        const double length = (m_nodes[k] - from).norm();
        newIndex[k] = static_cast<int>(nodes.size());
        const bool isDispensable = k < last && !m_isFixed[k] && (m_nodes[k + 1] - from).norm() < spacing &&
                                   calcEdgeSlack(problem, k, from, m_nodes[k + 1], 0.5 * kEdgeDepth) > 0;
        if (isDispensable) continue;
        const bool isBlocked = k <= static_cast<int>(m_slack.size()) && m_slack[k - 1].isBlocked;
        const int pieces = std::max(isBlocked && length > kLeast * spacing ? 2 : 1,
                                    static_cast<int>(std::ceil(length / (kLongest * spacing))));
        for (int i = 1; i < pieces; ++i) {
            nodes.push_back(from + (m_nodes[k] - from) * i / pieces);
            isFixed.push_back(0);
        }
        newIndex[k] = static_cast<int>(nodes.size());
        nodes.push_back(m_nodes[k]);
        isFixed.push_back(m_isFixed[k]);
    }
    takeMesh(problem, nodes, isFixed, newIndex);
    m_slack.assign(m_nodes.size(), EdgeSlack());
}

/** By how much an edge may sink until it is deeper than `depth` (in sizes) below a surface that is not convex and acts
on it [m]; below zero where it is. */
double ElasticBand::calcEdgeSlack(const PathProblem& problem, int edge, const Vector3& A, const Vector3& B,
                                  double depth) {
    double slack = kInfinity;
    for (std::size_t i = findFirstHold(edge); i < m_holds.size() && m_holds[i].portionBegin <= edge; ++i) {
        const Hold& hold = m_holds[i];
        const Surface& surface = *problem.getElement(hold.element).surface;
        if (hold.isSwitchedOff || surface.isConvex()) continue;
        const double enough = -depth * surface.getSize();
        const Vector3 A_S = hold.X_GS.shiftBack(A), B_S = hold.X_GS.shiftBack(B);
        slack = std::min(slack, calcLowestAlong(surface, A_S, B_S, enough, m_numHeights) - enough);
        if (slack < 0) break;
    }
    return slack;
}

bool ElasticBand::passesThroughWalls(const PathProblem& problem) {
    for (int k = 0; k + 1 < static_cast<int>(m_nodes.size()); ++k)
        if (calcEdgeSlack(problem, k, m_nodes[k], m_nodes[k + 1], kWallDepth) < 0) return true;
    return false;
}

/** Heights change by about as much as the ends travel. */
bool ElasticBand::isEdgeClear(const PathProblem& problem, int edge) {
    EdgeSlack& slack = m_slack[edge];
    const double travelled = std::max(m_travel[edge] - slack.travelA, m_travel[edge + 1] - slack.travelB);
    if (travelled < slack.left) return true;
    slack.left = calcEdgeSlack(problem, edge, m_nodes[edge], m_nodes[edge + 1], kEdgeDepth);
    slack.travelA = m_travel[edge], slack.travelB = m_travel[edge + 1];
    return !(slack.left < 0);
}

/** Takes back as much of the move of a node as it takes to keep the edges beside it out of walls. */
void ElasticBand::keepEdgesClear(const PathProblem& problem, int node, const Vector3& old, double& room) {
    const Vector3 moved = m_nodes[node];
    for (const double part : {0.5, 0.25, 0.0}) {
        const bool isClearBefore = isEdgeClear(problem, node - 1), isClearAfter = isEdgeClear(problem, node);
        if (isClearBefore && isClearAfter) return;
        if (!isClearBefore) m_slack[node - 1].isBlocked = true;
        if (!isClearAfter) m_slack[node].isBlocked = true;
        moveNode(node, old + part * (moved - old));
        if (part > 0) pushOut(problem, node, room);
    }
    m_slack[node - 1].left = m_slack[node].left = -1;
}

}  // namespace tautline
