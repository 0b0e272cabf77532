// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A coarse elastic string laid along a path and relaxed with one-sided contact: finds the contact set and the basin of
the minimum where Newton-like steps from a poor guess do not. Milliseconds, not microseconds. After the elastic bands of
Quinlan and Khatib (ICRA 1993), relaxed by projected successive over-relaxation (Cryer, SIAM J. Control 9, 1971). */
#include <vector>

#include "paths/route.h"
#include "paths/search_limits.h"

namespace tautline {

class ElasticBand {
public:
    /** Resets the cost that all bands of one search share. */
    void beginSearch() { m_numHeights = 0; }

    /** Lays the band from origin to insertion along its waypoints, and around the surfaces that lie between. */
    void lay(const PosedProblem& scene, const Waypoints& waypoints);

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

    void layEdge(const PathProblem& problem, int firstHold, Vector3 A, const Vector3& B, int depth);
    void addNode(const Vector3& x, bool isFixed);
    static void noteContact(Hold& hold, int node);
    void remesh(const PathProblem& problem, double fineness);
    void updatePortions(const PathProblem& problem);
    double sweep(const PathProblem& problem, double relaxation, bool isForward);
    std::size_t findFirstHold(int node) const;
    double calcRoom(const PathProblem& problem, const Vector3& x, int node);
    void forgetHeights();
    void moveNode(int node, const Vector3& x);
    void pushOut(const PathProblem& problem, int node, double& room);
    double calcHeight(const PathProblem& problem, const Hold& hold, int node) const;
    ContactArc makeArc(const PosedProblem& scene, const Hold& hold, int first, int last) const;
    bool liesInGroove(const PathProblem& problem, const Hold& hold, const Hold& other) const;
    bool restsOn(const PathProblem& problem, const Hold& hold, int node) const;

    std::vector<Vector3> m_nodes;
    std::vector<char> m_isFixed;
    std::vector<double> m_travel;     ///< of each node, since the last mesh was made [m]
    std::vector<double> m_stiffness;  ///< of edge k between nodes k and k + 1
    std::vector<double> m_room;       ///< per node: size of the nearest obstacle plus distance to it [m]
    std::vector<Hold> m_holds;
    double m_extent = 0;                      ///< length of the string when laid [m]
    long m_numHeights = 0, m_maxHeights = 0;  ///< of nodes over surfaces, asked for in this search
    bool m_isAtRest = true;                   ///< the last relaxation came to its tolerance
};

}  // namespace tautline
