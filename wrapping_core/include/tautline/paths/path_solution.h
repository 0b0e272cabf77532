// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/paths/solve_report.h"
#include "tautline/surfaces/surface.h"

namespace tautline {

/** How a solve ended. */
enum class PathStatus {
    Solved,      ///< max |eps| <= tolerance and all conditions of PathVerification hold
    NotMinimum,  ///< max |eps| <= tolerance, but the path is not a local minimum (pressure, tangent, conjugate point),
                 ///< or not one that a string can have come to: it has left a ring that it went through
    LeftDomain,  ///< a contact lies outside its surface's domain
    EndInside,   ///< a fixed point lies deeper than 1e-7 sizes below the surface of an obstacle of its strand (nearer
                 ///< ones count as lying on it); that obstacle is switched off
    NotConverged,  ///< max |eps| > tolerance after the allowed iterations; the best path met is returned
};

/** A short word for tables and files: "solved", "not_minimum", ... */
const char* getName(PathStatus status);

/** How a path goes through an obstacle's hole, between the fixed points or touched obstacles beside it. */
struct HolePassage {
    int count = 0;                        ///< along the hole's axis less against it
    int from = -1, to = -1;               ///< elements beside: where this portion of the path begins and ends
    Vector3 A_S = Vector3::Zero();        ///< where it begins
    Vector3 B_S = Vector3::Zero();        ///< where it ends
    Vector3 through_S = Vector3::Zero();  ///< where it last went through, if it does

    bool isKnown() const { return from >= 0; }
};

/** Where an arc was shot, and how: as long as its start stays, it need not be shot again. */
struct ArcShot {
    std::uint64_t surface = 0;  ///< Surface::getId(); 0: none
    double accuracy = kNaN;     ///< ShootingOptions::accuracy
};

/** Where a path lies on a surface, from one straight segment to the next. */
struct ContactArc {
    GeodesicStart start;    ///< in S
    ShotGeodesic geodesic;  ///< in S; of a solved path
    ArcShot shot;           ///< that `geodesic` came from
};

/** What one obstacle does in a solved path. While it is touched the path lies on it in one arc or, where it bridges a
hollow between, in several; the members `start`, `geodesic` and `shot` are those of the first arc, or of the last one it
had, while it is lifted. */
struct ObstacleContact : ContactArc {
    bool isTouched = false;
    bool isSwitchedOff = false;  ///< an end of its strand is inside it, or the pose passes it over
    bool yields = false;         ///< it overlaps another obstacle where the string lies: the path passes through it
    LineClearance clearance;     ///< in S; of the straight line that passes the surface while lifted
    int segment = -1;            ///< while lifted: index of that straight segment
    HolePassage passage;         ///< of surfaces that have a hole: the one that a continued path has to keep
    bool hasLeftHole = false;    ///< the path no longer goes through the hole in that way, and did not since
    std::vector<ContactArc> furtherArcs;  ///< after the first, in path order; empty while lifted

    /** 0 while lifted. */
    int getNumArcs() const { return isTouched ? 1 + static_cast<int>(furtherArcs.size()) : 0; }
    const ContactArc& getArc(int i) const { return i == 0 ? *this : furtherArcs[i - 1]; }
    ContactArc& updArc(int i) { return i == 0 ? *this : furtherArcs[i - 1]; }
    /** Of all arcs together [m]. */
    double calcArcLength() const {
        double length = 0;
        for (int i = 0; i < getNumArcs(); ++i) length += getArc(i).geodesic.length;
        return length;
    }
    const ContactArc& getLastArc() const { return furtherArcs.empty() ? *this : furtherArcs.back(); }
};

/** A straight segment between fixed points and arcs; A and B in ground. Between two arcs of one obstacle it has that
obstacle at both ends. */
struct StraightSegment {
    int fromElement = -1, toElement = -1;
    int fromArc = 0, toArc = 0;  ///< which arc of an obstacle it leaves and comes to
    Vector3 A = Vector3::Constant(kNaN), B = Vector3::Constant(kNaN);
    Vector3 e = Vector3::Constant(kNaN);  ///< unit vector from A to B
    double length = kNaN;                 ///< [m]
};

/** Why a string that has fallen taut is not one smooth path. */
struct StringFault {
    enum class Kind {
        None,
        Groove,      ///< it lies in the groove where two surfaces meet: a kink
        Sliding,     ///< it has not come to rest: it slides so slowly that it is next to a neutral course
        OutOfOrder,  ///< it meets two obstacles against the order of the path: it would have to cross itself
    };
    Kind kind = Kind::None;
    int element = -1;  ///< the obstacle concerned; -1 where a string slides clear of all
    int other = -1;    ///< the second one of a groove, or the one that is met too early
};

/** Where a path runs elsewhere than was asked: the first hint that it does not follow, or else the first obstacle that
it passes as it does only because it was continued. */
struct RouteDeviation {
    enum class Kind {
        None,       ///< it runs as was asked
        Side,       ///< it passes an obstacle on another side than its hint (PassOnSide) says
        Near,       ///< it passes an obstacle on another side than the point of its hint (PassNear)
        Winding,    ///< it turns about an obstacle less or more often than its hint (WindAround) says
        Threading,  ///< it goes through a ring less or more often than its hint (ThreadHole), or the straight line,
                    ///< does
        Continued,  ///< it follows its hints, but passes an obstacle on another side, or with other turns, than a
                    ///< search that knows this pose alone would begin with: a cold solve may find another minimum
    };
    Kind kind = Kind::None;
    int element = -1;  ///< the obstacle concerned
};

/** A path: always finite and drawable, whatever the status. `contacts` has one entry per element of the
problem (entries of points are unused) and is what a later solve starts from. */
struct PathSolution {
    PathStatus status = PathStatus::NotConverged;
    double length = kNaN;      ///< straight segments and arcs [m]
    double pathError = kNaN;   ///< max |eps| (thesis Eqn. 4.3), dimensionless
    int iterations = 0;        ///< Newton iterations of this solve
    int shots = 0;             ///< geodesics shot in this solve
    RouteDeviation deviation;  ///< where a minimum runs elsewhere than was asked
    bool wasCold = false;      ///< the start was found anew, not continued
    SolveReport report;
    std::vector<ObstacleContact> contacts;
    std::vector<StraightSegment> segments;
    StringFault fault;                 ///< where the elastic string led to no solution: why
    std::vector<double> errorHistory;  ///< max |eps| before each Newton iteration of the last run

    bool isEmpty() const { return contacts.empty(); }
    /** The arc to which a segment leads, on an obstacle. */
    const ContactArc& getArcAfter(const StraightSegment& in) const { return contacts[in.toElement].getArc(in.toArc); }
    bool followsHints() const {
        return deviation.kind == RouteDeviation::Kind::None || deviation.kind == RouteDeviation::Kind::Continued;
    }
    /** Whether it is where it is only because it was continued (RouteDeviation::Kind::Continued). */
    bool dependsOnHistory() const { return deviation.kind == RouteDeviation::Kind::Continued; }
};

}  // namespace tautline
