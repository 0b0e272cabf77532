// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/start_hint.h"
#include "tautline/simbody/cable_path_subsystem.h"
#include "tautline/simbody/hints.h"
#include "tautline/simbody/mobility_screws.h"
#include "tautline/simbody/moving_station.h"

namespace tautline {

class CableImpl;

/** Identifies an element of a cable's path: 0 is the origin, then via points and obstacles in the order in
which they were added; the last is the insertion. */
SimTK_DEFINE_UNIQUE_INDEX_TYPE(CableElementIndex);

/** What happened to a contact in a time-stepping study. It was made (touchdown) or lost (lift-off), both without a jump
of length or rate.

Slipped: the cable could no longer stay where it was. Its path had become a saddle of the length, or had come to an end,
and the cable snaps to the shortest path next to it, with other contacts or the same ones; events of contacts made and
lost on the way follow. The length jumps down, from lengthBefore to lengthAfter, and the rate jumps: a force element
that stores energy loses what it stored in the difference, and no law says where it goes.

Split: the pressure has turned inside an arc, and the cable bridges the hollow there between two arcs. Joined: a hollow
has closed, and two arcs have become one. Neither shows in the length, its rate or its acceleration. ArcMade: the cable
has come down on an obstacle that it touches in one more place. ArcLost: it has left one of several places.

LeftHole: the cable has left a ring (an obstacle with a hole) through which it was threaded: the step was too long for
the ring to hold it.

SwitchedOff: an obstacle that the cable touched no longer takes part, since a point beside it has come to lie inside it
or its condition has become false. SwitchedOn: one that had been switched off takes part and is touched again. The
length jumps at both. */
struct ContactEvent {
    enum class Kind { Made, Lost, Split, Joined, ArcMade, ArcLost, LeftHole, Slipped, SwitchedOff, SwitchedOn };
    SimTK::Real time;  ///< [s]
    CableIndex cable;
    CableElementIndex obstacle;
    Kind kind;
    SimTK::Real lengthBefore, lengthAfter;  ///< of the cable [m]
    SimTK::Real rateBefore, rateAfter;      ///< its rate [m/s]
};

/** What a cable's solves have cost since construction or the last reset, over all States and threads. */
struct CableStatistics {
    long numSolves = 0;
    long numColdSolves = 0;       ///< started anew instead of continued
    long numFailures = 0;         ///< ended as NotConverged
    long numIterations = 0;       ///< of Newton's method
    long numShots = 0;            ///< geodesics shot
    long numContactEvents = 0;    ///< contacts made or lost by the event handlers
    long numSlips = 0;            ///< paths that lost their stability and were left by the event handlers
    long numHolesLeft = 0;        ///< rings that the cable went through in a step
    double seconds = 0;           ///< spent in the solver
    long numSteps = 0;            ///< accepted steps that CablePathSubsystem::countStep() was told of
    long numDegradedSteps = 0;    ///< of those, with a status other than Solved: Cable::calcStatus()
    double largestPathError = 0;  ///< in those steps: Cable::getPathError(), NaN if it once was that
};

/** A body, by its handle or by its index. */
class CableBody {
public:
    CableBody(const SimTK::MobilizedBody& body) : m_body(&body) {}
    CableBody(SimTK::MobilizedBodyIndex index) : m_index(index) {}

    /** @throws InvalidInput unless it is a body of this matter subsystem: one of another system would be taken for ours
    with the same index */
    SimTK::MobilizedBodyIndex findIndex(const SimTK::SimbodyMatterSubsystem& matter, const std::string& cable) const;

private:
    const SimTK::MobilizedBody* m_body = nullptr;
    SimTK::MobilizedBodyIndex m_index;
};

/** A taut, frictionless, massless string from a point on one body over via points and smooth obstacles on
others to a point on another: the shortest path, found on its own side of each obstacle.

A Cable is a light handle: copy it freely, its contents belong to the CablePathSubsystem.

Frames: B a body, E an element's frame (its station on B, or the surface frame S), G ground. Units: SI.
Each query says which stage it needs; asked too early it throws Simbody's own stage error. A query on a
cable that is disabled in the State throws too. */
class Cable {
public:
    Cable() = default;

    /** Adds a cable to the subsystem. All bodies must belong to one matter subsystem of the same system.
    @param originStation_B, insertionStation_B   finite, measured in the body's frame [m]
    @param name   for messages and decorations, unique within the subsystem; empty: "cable0", "cable1", ...
    @throws InvalidInput with the value */
    Cable(CablePathSubsystem& cables, const CableBody& originBody, const SimTK::Vec3& originStation_B,
          const CableBody& insertionBody, const SimTK::Vec3& insertionStation_B, std::string name = "");

    /** @name Building: before realizeTopology()
    All of this invalidates the System's topology: States from before it are refused by every query. */
    ///@{
    /** Adds a frictionless eyelet after what has been added so far.
    @param name   empty: "point1", ... by element index */
    CableElementIndex addViaPoint(const CableBody& body, const SimTK::Vec3& station_B, std::string name = "");

    /** Adds an eyelet that moves on its body. */
    CableElementIndex addMovingPoint(const CableBody& body, std::shared_ptr<const MovingStation> station,
                                     std::string name = "");
    /** Adds an eyelet that holds the cable only while a condition is true, else is passed over: the length jumps
    where the condition changes, and studies stop a step there.
    @param isActive   of positions and time of a State whose bodies' poses are known; called by many threads at
                      once */
    CableElementIndex addConditionalPoint(const CableBody& body, const SimTK::Vec3& station_B,
                                          std::function<bool(const SimTK::State&)> isActive, std::string name = "");
    /** Lets an end move on its body; the station given before no longer counts. */
    void setMovingOrigin(std::shared_ptr<const MovingStation> station);
    void setMovingInsertion(std::shared_ptr<const MovingStation> station);

    /** Adds an obstacle after what has been added so far, and the event handlers that watch it.
    @param X_BS      pose of the surface frame S on the body
    @param surface   may be shared between obstacles
    @param hint_S    a point near which the path shall run at first, in S; none: the solver finds a side
    @param name      unique within the cable; empty: "obstacle1", ... by element index */
    CableElementIndex addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                  std::shared_ptr<const Surface> surface,
                                  std::optional<SimTK::Vec3> hint_S = std::nullopt, std::string name = "");
    /** As above. @param hint   a side, a winding, how often through a hole: see StartHint, and hints.h for functions
    that take Simbody's vectors */
    CableElementIndex addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                  std::shared_ptr<const Surface> surface, const StartHint& hint, std::string name = "");
    /** As above, with what makeSurface() makes of Simbody's geometry. */
    CableElementIndex addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                  const std::shared_ptr<const SimTK::ContactGeometry>& geometry,
                                  std::optional<SimTK::Vec3> hint_S = std::nullopt, std::string name = "");
    CableElementIndex addObstacle(const CableBody& body, const SimTK::Transform& X_BS,
                                  const std::shared_ptr<const SimTK::ContactGeometry>& geometry, const StartHint& hint,
                                  std::string name = "");

    /** Has an obstacle take part only while a condition is true, else it is passed over, as a conditional point is.
    Once per obstacle. @param isActive   as for addConditionalPoint() */
    void setCondition(CableElementIndex obstacle, std::function<bool(const SimTK::State&)> isActive);

    /** Of any element, ends included. */
    void setBody(CableElementIndex element, const CableBody& body);
    /** Where a point is on its body; a moving one stays there from now on. */
    void setStation(CableElementIndex point, const SimTK::Vec3& station_B);
    void setObstacleFrame(CableElementIndex obstacle, const SimTK::Transform& X_BS);
    void setSurface(CableElementIndex obstacle, std::shared_ptr<const Surface> surface);
    void setSurface(CableElementIndex obstacle, const std::shared_ptr<const SimTK::ContactGeometry>& geometry);

    /** How the path is laid where it is found anew. */
    void setHint(CableElementIndex obstacle, std::optional<SimTK::Vec3> hint_S);
    void setHint(CableElementIndex obstacle, const StartHint& hint);

    /** @throws InvalidInput naming the option out of range */
    void setOptions(const PathSolverOptions& options);
    const PathSolverOptions& getOptions() const;

    /** A disabled cable solves nothing, pulls at nothing and raises no events. */
    void setDisabledByDefault(bool isDisabled);
    bool isDisabledByDefault() const;

    /** In States fresh from the System; else that of the subsystem holds. */
    void setDefaultContactMode(ContactMode mode);
    ///@}

    /** @name What the cable is made of */
    ///@{
    bool isEmptyHandle() const { return m_impl == nullptr; }
    const std::string& getName() const;
    CableIndex getCableIndex() const;
    const CablePathSubsystem& getSubsystem() const;
    const SimTK::SimbodyMatterSubsystem& getMatterSubsystem() const;
    /** Origin and insertion included. */
    int getNumElements() const;
    int getNumObstacles() const;
    int getNumViaPoints() const;
    /** The first, second, ... of the obstacles (or via points), from 0 on. @throws InvalidInput if there are not that
     * many
     */
    CableElementIndex getObstacle(int number) const;
    CableElementIndex getViaPoint(int number) const;
    CableElementIndex getOrigin() const { return CableElementIndex(0); }
    CableElementIndex getInsertion() const { return CableElementIndex(getNumElements() - 1); }
    bool isObstacle(CableElementIndex element) const;
    const std::string& getElementName(CableElementIndex element) const;
    /** @throws InvalidInput if no element has this name */
    CableElementIndex findElement(const std::string& name) const;
    SimTK::MobilizedBodyIndex getElementBody(CableElementIndex element) const;
    /** X_BE: the station of a point, the pose of a surface. Of a moving point not its present one. */
    SimTK::Transform getElementFrame(CableElementIndex element) const;
    /** Whether there is a point that moves on its body, or holds the cable only under a condition. */
    bool hasMovingPoints() const;
    /** The path as the core sees it, element for element; from realizeTopology() on. */
    const PathProblem& getPathProblem() const;
    /** Null for points. */
    std::shared_ptr<const Surface> getSurface(CableElementIndex element) const;
    ///@}

    /** Called by the event handlers for each ContactEvent, in the thread of the study. May be set at any time except
    while a study runs; null: nobody is told. */
    void setContactListener(std::function<void(const ContactEvent&)> listener) const;

    /** @name State [Topology]: changing it invalidates Position */
    ///@{
    void disable(SimTK::State& state) const;
    void enable(SimTK::State& state) const;
    bool isDisabled(const SimTK::State& state) const;

    /** A mode other than before releases the contacts; those of Events are fixed when a study begins. */
    void setContactMode(SimTK::State& state, ContactMode mode) const;
    ContactMode getContactMode(const SimTK::State& state) const;

    /** Fixes the contact set found in this state [Position]: later poses are solved with the same contacts
    and continued from this path, until releaseContacts() or an event handler changes them. For studies
    that move in small steps without an integrator. A time-stepping study does this by itself when it initializes. The
    cable's mode is ContactMode::Events afterwards. */
    void fixContacts(SimTK::State& state) const;

    /** Fixes the contact set of a given path, from which the next solve continues: a study may thus start from a
    path of your own, such as one iterated from geodesics chosen by hand.
    @param path   one contact per element; InvalidInput otherwise */
    void continueFrom(SimTK::State& state, const PathSolution& path) const;

    /** Lets the pose alone decide again, in ContactMode::Events as in Free. Call it after moving a State that comes
    from an integrator to another pose. While contacts are free there are no events: for a study to have them again,
    fixContacts() must follow, or the study be initialized anew. */
    void releaseContacts(SimTK::State& state) const;
    bool areContactsFixed(const SimTK::State& state) const;
    ///@}

    /** @name Path [Position] */
    ///@{
    SimTK::Real getLength(const SimTK::State& state) const;
    PathStatus getStatus(const SimTK::State& state) const;
    /** As getStatus(), with all conditions judged also while contacts are fixed. An arc just below zero length is no
    fault then, nor a path just beyond the loss of its stability (kSlipMargin): between events the event finder
    watches them. A path that has left a ring since the step before is
    NotMinimum. */
    PathStatus calcStatus(const SimTK::State& state) const;
    /** max |eps|, dimensionless. */
    SimTK::Real getPathError(const SimTK::State& state) const;
    const PathSolution& getSolution(const SimTK::State& state) const;
    /** Whether the path is a local minimum, contacts included, and if not, why: with fixed contacts
    getStatus() tells only whether the path error vanishes. */
    PathVerification calcVerification(const SimTK::State& state) const;
    /** calcStatus() in a sentence: which condition is broken, at which obstacle and where in ground. */
    std::string explainStatus(const SimTK::State& state) const;
    /** Poses of the elements' frames in ground: with getPathProblem() and getSolution() what the core's functions take,
    such as PathSensitivity. */
    const PathPose& getPathPose(const SimTK::State& state) const;
    /** False for a conditional point or obstacle that is passed over. */
    bool isActive(const SimTK::State& state, CableElementIndex element) const;
    /** Where an element's origin is on its body, moving or not [m]. */
    SimTK::Vec3 calcStation(const SimTK::State& state, CableElementIndex element) const;
    bool isTouched(const SimTK::State& state, CableElementIndex obstacle) const;
    /** In how many arcs the path lies on an obstacle: 0 while lifted; more than 1 where it bridges hollows between. */
    int getNumArcs(const SimTK::State& state, CableElementIndex obstacle) const;
    /** Length of the arcs on an obstacle together [m]; NaN while lifted. */
    SimTK::Real getArcLength(const SimTK::State& state, CableElementIndex obstacle) const;
    /** Where the path meets (P) and leaves (Q) an obstacle, in ground. @param arc   which of its arcs, from 0
    @return false where it has no such arc, as while lifted */
    bool getContactPoints(const SimTK::State& state, CableElementIndex obstacle, SimTK::Vec3& P_G, SimTK::Vec3& Q_G,
                          int arc = 0) const;
    /** The frames there: x along the path, y the outward normal, z = x cross y. */
    bool getContactFrames(const SimTK::State& state, CableElementIndex obstacle, SimTK::Transform& X_GP,
                          SimTK::Transform& X_GQ, int arc = 0) const;
    /** Direction of the path where it meets (P) and leaves (Q) an obstacle, in ground. */
    bool getContactTangents(const SimTK::State& state, CableElementIndex obstacle, SimTK::UnitVec3& atP_G,
                            SimTK::UnitVec3& atQ_G, int arc = 0) const;
    /** Direction in which the path leaves the origin, and in which it arrives at the insertion, in ground. */
    SimTK::UnitVec3 calcOriginTangent(const SimTK::State& state) const;
    SimTK::UnitVec3 calcInsertionTangent(const SimTK::State& state) const;
    /** Signed distance of the straight segment that passes a lifted obstacle [m]; NaN while touched. */
    SimTK::Real getClearance(const SimTK::State& state, CableElementIndex obstacle) const;
    /** What the event finder watches, dimensionless: contact changes where it falls below zero. Lifted:
    clearance above the contact tolerance, touched: least length of an arc over size, or height at which the path comes
    near the surface again. Positive and never 0 or NaN
    unless the contact is about to change; 1 while contacts are free. */
    SimTK::Real getWitness(const SimTK::State& state, CableElementIndex obstacle) const;
    /** Points along the path in ground, arcs turned by at most maxAngle [rad] between points. */
    std::vector<SimTK::Vec3> calcDrawingPoints(const SimTK::State& state, SimTK::Real maxAngle = 0.1) const;
    /** Points at equal distances along the whole path, ends included, in ground. @param count   at least 2 */
    std::vector<SimTK::Vec3> calcResampledPoints(const SimTK::State& state, int count) const;
    /** The same along an arc on an obstacle. @throws InvalidInput if it has no such arc */
    std::vector<SimTK::Vec3> calcResampledArc(const SimTK::State& state, CableElementIndex obstacle, int count,
                                              int arc = 0) const;
    /** The frames at those points: x along the path, y the outward normal, z = x cross y. Between two of them the path
    turns by its normal curvature about z and by its geodesic torsion about x. */
    std::vector<SimTK::Transform> calcResampledArcFrames(const SimTK::State& state, CableElementIndex obstacle,
                                                         int count, int arc = 0) const;
    ///@}

    /** @name Forces: unit tension unless one is given [Position]
    The unit forces on the elements are computed with the path; what is summed from them here is not kept. */
    ///@{
    /** Adds the forces of a tension [N] to those of all bodies, about body origins, in ground. A cable with moving
    points needs applyMobilityForces() beside it.
    @param bodyForces   one entry per mobilized body
    @throws InvalidInput for a negative tension: a string cannot push */
    void applyBodyForces(const SimTK::State& state, SimTK::Real tension,
                         SimTK::Vector_<SimTK::SpatialVec>& bodyForces) const;
    /** Adds what a tension [N] does to the mobilities through moving points; nothing if there are none.
    @param mobilityForces   one entry per mobility of the system */
    void applyMobilityForces(const SimTK::State& state, SimTK::Real tension, SimTK::Vector& mobilityForces) const;
    /** Moment [m] and force [1] of unit tension on each body, about body origins, in ground.
    @param unitForces   resized and overwritten */
    void calcUnitBodyForces(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& unitForces) const;
    /** What one element puts on its body, as calcUnitBodyForces(): about the body's origin. */
    SimTK::SpatialVec calcUnitForceAboutBodyOrigin(const SimTK::State& state, CableElementIndex element) const;
    /** The same about the element's origin E. */
    SimTK::SpatialVec calcUnitForceAboutElementOrigin(const SimTK::State& state, CableElementIndex element) const;
    /** Generalized forces of unit tension, one per mobility: -d(length rate)/du, moving points included. */
    void calcUnitMobilityForces(const SimTK::State& state, SimTK::Vector& unitForces) const;
    /** The same for many cables in one pose, in a tenth of the time. @param screws   of this State's pose
    @throws InvalidInput if they are of another number of mobilities */
    void calcUnitMobilityForces(const SimTK::State& state, const MobilityScrews& screws,
                                SimTK::Vector& unitForces) const;
    /** Moment arm -dl/dq about one mobility whose speed u is q's derivative [m/rad or 1]: positive where
    shortening drives q up. Constraints are not followed: project with their coupling if there are any. */
    SimTK::Real calcMomentArm(const SimTK::State& state, SimTK::MobilizedBodyIndex body,
                              SimTK::MobilizerUIndex u) const;
    ///@}

    /** @name Rates [Velocity] */
    ///@{
    /** Exact dL/dt [m/s]. */
    SimTK::Real getLengthRate(const SimTK::State& state) const;
    /** What of the length's second derivative comes from the velocities alone [m/s^2]: d2L/dt2 = this - sum F_B . A_GB
    with the unit forces F_B and the bodies' accelerations. It jumps where contact changes. A cable with moving points
    has none: an error. */
    SimTK::Real getLengthAccelerationBias(const SimTK::State& state) const;
    /** Power of the forces that a tension [N] puts on the bodies [W]: -tension * length rate. */
    SimTK::Real calcPower(const SimTK::State& state, SimTK::Real tension) const;
    ///@}

    CableStatistics getStatistics() const;
    void resetStatistics() const;

private:
    friend class CablePathSubsystemImpl;
    explicit Cable(CableImpl* impl) : m_impl(impl) {}
    SimTK::MobilizedBodyIndex findBody(const CableBody& body) const;
    CableImpl& upd() const;
    const CableImpl& get() const;

    CableImpl* m_impl = nullptr;  ///< owned by the subsystem
};

}  // namespace tautline
