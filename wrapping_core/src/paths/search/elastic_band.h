// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A coarse elastic string laid along a path and relaxed with one-sided contact: finds the contact set and the basin of
the minimum where Newton-like steps from a poor guess do not. Milliseconds, not microseconds. After the elastic bands of
Quinlan and Khatib (ICRA 1993), relaxed by projected successive over-relaxation (Cryer, SIAM J. Control 9, 1971). */
#include <vector>

#include "paths/problem/search_limits.h"
#include "paths/search/route.h"

namespace tautline {

class ElasticBand {
public:
    /** Resets the cost that all bands of one search share. */
    void beginSearch() { m_numHeights = 0; }

    /** Lays the band from origin to insertion along its waypoints, and around the surfaces that lie between. */
    void lay(const PosedProblem& scene, const Waypoints& waypoints);

    /** The same, clear of walls that are thinner than the edges of a band are long: round them, not through, and so it
    stays while it is relaxed. Slower: the edges are watched, not the nodes alone. */
    void layRoundWalls(const PosedProblem& scene, const Waypoints& waypoints);

    /** Whether an edge passes through a surface that is not convex, deeper than a chord over a bend of it would. */
    bool passesThroughWalls(const PathProblem& problem);

    /** Relaxes until nodes move less than the level's tolerance of their spacing per sweep, or its sweeps are done, or
    this band, or all bands of a search, have cost what they may. */
    void relax(const PathProblem& problem, const BandLevel& level);

    /** Moves the nodes that touch an element, to free a band from a saddle. @param by_G   in ground [m] */
    void move(int element, const Vector3& by_G);

    /** Moves every node by a little of its own, out of whatever symmetry the band was laid in. */
    void disturb();

    /** Contact set, geodesic starts (touched) and switched-off obstacles as the string shows them. */
    void extractContacts(const PosedProblem& scene, std::vector<ObstacleContact>& contacts) const;

    /** Why the relaxed string is no smooth path, if it is not. */
    StringFault findFault(const PathProblem& problem) const;

    /** All pairs of obstacles in the groove between which the band lies, or that it meets out of order. */
    std::vector<StringFault> findGrooves(const PathProblem& problem) const;

    const std::vector<Vector3>& getNodes() const { return m_nodes; }

private:
    /** How high above a surface a node was when it was last asked, and how far it had travelled then. */
    struct SeenHeight {
        double height = 0, travel = 0;  ///< [m]
    };

    /** An obstacle's hold on the string; node indices, -1 where it does not touch. */
    struct Hold {
        int element = -1;
        Pose X_GS;
        int first = -1, last = -1;             ///< contact nodes of this sweep
        int from = -1, to = -1;                ///< fixed nodes that bound its strand
        int portionBegin = 0, portionEnd = 0;  ///< nodes on which it may act, inclusive
        bool isSwitchedOff = false;
        int seenFrom = 0;              ///< the first node of these
        std::vector<SeenHeight> seen;  ///< per node of the portion that this mesh began with
        SeenHeight* findSeen(int node) {
            const int at = node - seenFrom;
            return at >= 0 && at < static_cast<int>(seen.size()) ? &seen[at] : nullptr;
        }
        bool touches() const { return first >= 0; }
    };

    /** How far the ends of an edge may travel before it has to be looked at again: what was left at the last look, less
    what each of them had travelled then. */
    struct EdgeSlack {
        double left = -1, travelA = 0, travelB = 0;  ///< [m]
        bool isBlocked = false;                      ///< it kept one of its ends from moving
    };

    void layAlong(const PosedProblem& scene, const Waypoints& waypoints);
    void layEdge(const PathProblem& problem, int firstHold, Vector3 A, const Vector3& B, int depth);
    bool layCourse(const PathProblem& problem, int firstHold, int hold, const Vector3& A, const Vector3& B, int depth);
    void addNode(const Vector3& x, bool isFixed);
    static void noteContact(Hold& hold, int node);
    void remesh(const PathProblem& problem, double fineness);
    void remeshRoundWalls(const PathProblem& problem, double fineness);
    void takeMesh(const PathProblem& problem, std::vector<Vector3>& nodes, std::vector<char>& isFixed,
                  const std::vector<int>& newIndex);
    void updatePortions(const PathProblem& problem);
    double sweep(const PathProblem& problem, double relaxation, bool isForward);
    std::size_t findFirstHold(int node) const;
    double calcSpacing(const PathProblem& problem, double fineness, const Vector3& x, int node);
    double calcRoom(const PathProblem& problem, const Vector3& x, int node);
    void forgetHeights();
    void moveNode(int node, const Vector3& x);
    void pushOut(const PathProblem& problem, int node, double& room);
    double calcHeight(const PathProblem& problem, const Hold& hold, int node) const;
    ContactArc makeArc(const PosedProblem& scene, const Hold& hold, int first, int last) const;
    bool liesInGroove(const PathProblem& problem, const Hold& hold, const Hold& other) const;
    double calcEdgeSlack(const PathProblem& problem, int edge, const Vector3& A, const Vector3& B, double depth);
    bool isEdgeClear(const PathProblem& problem, int edge);
    void keepEdgesClear(const PathProblem& problem, int node, const Vector3& old, double& room);
    bool restsOn(const PathProblem& problem, const Hold& hold, int node) const;

    std::vector<Vector3> m_nodes;
    std::vector<char> m_isFixed;
    std::vector<double> m_travel;     ///< of each node, since the last mesh was made [m]
    std::vector<double> m_stiffness;  ///< of edge k between nodes k and k + 1
    std::vector<double> m_room;       ///< per node: size of the nearest obstacle plus distance to it [m]
    std::vector<Hold> m_holds;
    std::vector<EdgeSlack> m_slack;  ///< of edge k; where walls are gone round
    bool m_goesRoundWalls = false;
    double m_extent = 0;                      ///< length of the string when laid [m]
    long m_numHeights = 0, m_maxHeights = 0;  ///< of nodes over surfaces, asked for in this search
    bool m_isAtRest = true;                   ///< the last relaxation came to its tolerance
};

}  // namespace tautline
