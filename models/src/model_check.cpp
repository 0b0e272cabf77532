// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_check.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "ellipsoid_section.h"
#include "tautline/paths/path_solver.h"

namespace tautline::models {
namespace {

constexpr int kSweepSteps = 9;            ///< poses along each coordinate
constexpr int kRandomPoses = 60;          ///< of all coordinates at once
constexpr double kUnbounded = 1.0;        ///< to either side of its default, of a coordinate without limits [rad or m]
constexpr double kLeastDeviation = 1e-6;  ///< of lengths [m] that is worth a line
constexpr double kDrivenTime = 10;        ///< over which driven coordinates are looked at [s]

struct FreeCoordinate {
    std::string name;
    double low, high;

    double at(double share) const { return low + share * (high - low); }
};

bool isDependent(const ModelDescription& description, const std::string& name) {
    return std::any_of(description.constraints.begin(), description.constraints.end(), [&](const auto& constraint) {
        const auto* coupler = std::get_if<CoordinateCoupler>(&constraint);
        return coupler && coupler->dependentCoordinate == name;
    });
}

std::vector<FreeCoordinate> findFreeCoordinates(const ModelDescription& description) {
    std::vector<FreeCoordinate> found;
    for (const Joint& joint : description.joints) {
        for (const Coordinate& coordinate : joint.coordinates) {
            if (coordinate.locked || coordinate.prescribedMotion || isDependent(description, coordinate.name)) continue;
            const auto [low, high] = coordinate.range;
            found.push_back({coordinate.name, std::isfinite(low) ? low : coordinate.defaultValue - kUnbounded,
                             std::isfinite(high) ? high : coordinate.defaultValue + kUnbounded});
        }
    }
    return found;
}

bool hasDrivenCoordinates(const ModelDescription& description) {
    for (const Joint& joint : description.joints)
        for (const Coordinate& coordinate : joint.coordinates)
            if (coordinate.prescribedMotion) return true;
    return false;
}

/** A pose and its place in its sweep: 0 for one that stands alone. */
struct CheckedPose {
    ModelPose pose;
    int place = 0;
};

std::vector<CheckedPose> makePoses(const ModelDescription& description) {
    const std::vector<FreeCoordinate> coordinates = findFreeCoordinates(description);
    const bool isDriven = hasDrivenCoordinates(description);
    std::vector<CheckedPose> poses(1);
    for (const FreeCoordinate& coordinate : coordinates) {
        for (int i = 0; i < kSweepSteps; ++i) {
            ModelPose pose;
            pose.values[coordinate.name] = coordinate.at(i / (kSweepSteps - 1.0));
            poses.push_back({pose, i});
        }
    }
    if (coordinates.empty() && !isDriven) return poses;
    std::mt19937 random(20261127);  // its numbers are the same everywhere; those of standard distributions are not
    const auto draw = [&] { return random() / static_cast<double>(std::mt19937::max()); };
    for (int i = 0; i < kRandomPoses; ++i) {
        ModelPose pose;
        if (isDriven) pose.time = kDrivenTime * draw();
        for (const FreeCoordinate& coordinate : coordinates) pose.values[coordinate.name] = coordinate.at(draw());
        poses.push_back({pose});
    }
    return poses;
}

std::string toText(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", number);
    return text;
}

/** Those coordinates of a path that are not at their defaults. */
std::string describePose(const ModelPose& pose, const StudiedPath& path) {
    std::string text;
    for (const std::string& name : path.coordinates) {
        const auto value = pose.values.find(name);
        if (value != pose.values.end()) text += (text.empty() ? "" : ", ") + name + " " + toText(value->second);
    }
    if (pose.time != 0) text += (text.empty() ? "" : ", ") + ("time " + toText(pose.time));
    return text.empty() ? "the default pose" : text;
}

std::string getShapeName(const WrapObject& object) {
    struct Namer {
        const char* operator()(const CylinderShape&) const { return "cylinder"; }
        const char* operator()(const SphereShape&) const { return "sphere"; }
        const char* operator()(const EllipsoidShape&) const { return "ellipsoid"; }
        const char* operator()(const TorusShape&) const { return "torus"; }
        const char* operator()(const ParaboloidShape&) const { return "paraboloid"; }
        const char* operator()(const EllipticTorusShape&) const { return "elliptic torus"; }
        const char* operator()(const MeshShape&) const { return "mesh"; }
        const char* operator()(const ExtensionShape&) const { return "of an extension"; }
    };
    return std::visit(Namer(), object.shape);
}

/** What a force along a path is called in the file. */
struct PathOwner {
    std::string type;
    const MusclePath* path = nullptr;
    const MuscleModel* muscle = nullptr;
};

PathOwner findOwner(const ModelDescription& description, const std::string& name) {
    if (const Muscle* muscle = findMuscle(description, name)) return {muscle->type, &muscle->path, muscle->model.get()};
    if (const PathSpring* spring = findSpring(description, name)) return {"PathSpring", &spring->path, nullptr};
    const PathForce& force = *findPathForce(description, name);
    return {force.type, &force.path, nullptr};
}

/** Gathers what one path does over the poses. */
class PathChecker {
public:
    PathChecker(const ModelDescription& description, const StudiedPath& studied)
        : m_description(description), m_studied(studied), m_owner(findOwner(description, studied.name)) {
        m_checked.name = studied.name;
        m_checked.type = m_owner.type;
        m_checked.numPoints = static_cast<int>(m_owner.path->points.size());
        for (std::size_t i = 0; i < studied.obstacles.size(); ++i) {
            CheckedObstacle obstacle;
            obstacle.name = studied.obstacles[i];
            obstacle.shape = getShapeName(getObject(i));
            obstacle.segment = static_cast<int>(studied.wraps[i].segment) + 1;
            m_checked.obstacles.push_back(obstacle);
        }
        if (m_owner.muscle) m_checked.muscle.emplace();
    }

    void look(const ModelPose& pose, const PathAnswer& answer, const CorePath& core) {
        const bool isFirst = m_numPoses++ == 0;
        m_checked.shortest = isFirst ? answer.length : std::min(m_checked.shortest, answer.length);
        m_checked.longest = isFirst ? answer.length : std::max(m_checked.longest, answer.length);
        if (!answer.isSound() && m_checked.numUnsound++ == 0)
            m_checked.firstFault = std::string(getName(answer.status)) + ", " + answer.explanation + " (at " +
                                   describePose(pose, m_studied) + ")";
        for (std::size_t i = 0; i < answer.obstacles.size(); ++i) lookAtObstacle(i, answer.obstacles[i], core);
        if (m_checked.muscle) lookAtMuscle(pose, answer, isFirst);
        if (core.problem && answer.isSound()) {
            lookAtRepeatedObjects(pose, answer, core);
            lookAtEllipsoids(pose, core);
        }
    }

    const CheckedPath& getChecked() const { return m_checked; }

private:
    const WrapObject& getObject(std::size_t obstacle) const {
        return m_description.wrapObjects[m_studied.wraps[obstacle].object];
    }

    void note(CheckedDeviation::Kind kind, const std::string& obstacle, double byLength, const ModelPose& pose) {
        if (!(std::abs(byLength) > kLeastDeviation)) return;
        const auto isSame = [&](const CheckedDeviation& other) {
            return other.kind == kind && other.obstacle == obstacle;
        };
        auto at = std::find_if(m_checked.deviations.begin(), m_checked.deviations.end(), isSame);
        if (at == m_checked.deviations.end())
            at = m_checked.deviations.insert(at, CheckedDeviation{kind, obstacle, 0, 0, ""});
        ++at->numPoses;
        if (!(std::abs(byLength) > std::abs(at->byLength))) return;
        at->byLength = byLength;
        at->where = describePose(pose, m_studied);
    }

    void lookAtObstacle(std::size_t i, const ObstacleAnswer& answer, const CorePath& core) {
        CheckedObstacle& obstacle = m_checked.obstacles[i];
        obstacle.numTouched += answer.isTouched;
        if (!answer.isSwitchedOff) return;
        ++(core.pose->hasElement(findElement(core, i)) ? obstacle.numEntered : obstacle.numPassedOver);
    }

    /** The element of the core's problem that is the i-th obstacle. */
    static int findElement(const CorePath& core, std::size_t i) {
        int element = -1;
        for (std::size_t found = 0; found <= i;)
            if (!core.problem->getElement(++element).isPoint()) ++found;
        return element;
    }

    void lookAtMuscle(const ModelPose& pose, const PathAnswer& answer, bool isFirst) {
        const MuscleModel& model = *m_owner.muscle;
        const MuscleParameters& parameters = model.getParameters();
        const MuscleEquilibrium found =
            model.findEquilibrium(answer.length, model.clampActivation(parameters.defaultActivation));
        const double fiber = model.calcLengths(answer.length, found.fiberLength).normFiberLength;
        CheckedMuscle& muscle = *m_checked.muscle;
        muscle.shortestFiber = isFirst ? fiber : std::min(muscle.shortestFiber, fiber);
        if (fiber > muscle.longestFiber) {
            muscle.longestFiber = fiber;
            muscle.longestAt = describePose(pose, m_studied);
        }
        muscle.largestTendonForce =
            std::max(muscle.largestTendonForce, found.tendonForce / parameters.maxIsometricForce);
        muscle.numTooShort += found.status == EquilibriumStatus::FiberAtLowerBound;
    }

    /** OpenSim lets an object engage on one segment at a time: the length if only one of those touched did. */
    void lookAtRepeatedObjects(const ModelPose& pose, const PathAnswer& answer, const CorePath& core) {
        for (std::size_t i = 0; i < answer.obstacles.size(); ++i) {
            if (!answer.obstacles[i].isTouched) continue;
            for (std::size_t k = i + 1; k < answer.obstacles.size(); ++k) {
                if (!answer.obstacles[k].isTouched || m_studied.wraps[k].wrap != m_studied.wraps[i].wrap) continue;
                double difference = answer.length;
                for (const std::size_t left : {i, k})
                    difference = std::min(difference, answer.length - calcLengthWithout(core, left));
                note(CheckedDeviation::Kind::SeveralSegments, getObject(i).name, difference, pose);
            }
        }
    }

    double calcLengthWithout(const CorePath& core, std::size_t obstacle) {
        PathPose pose = *core.pose;
        if (pose.isActive.empty()) pose.isActive.assign(pose.X_GE.size(), 1);
        pose.isActive[static_cast<std::size_t>(findElement(core, obstacle))] = 0;
        PathSolution path;
        m_solver.solve(*core.problem, pose, path);
        return path.length;
    }

    /** OpenSim's path over an ellipsoid lies in a plane. */
    void lookAtEllipsoids(const ModelPose& pose, const CorePath& core) {
        for (std::size_t i = 0; i < m_studied.obstacles.size(); ++i) {
            const auto* ellipsoid = std::get_if<EllipsoidShape>(&getObject(i).shape);
            const int e = findElement(core, i);
            const ObstacleContact& contact = core.solution->contacts[static_cast<std::size_t>(e)];
            if (!ellipsoid || getObject(i).isContactGeometry || !contact.isTouched) continue;
            const auto& segments = core.solution->segments;
            const auto before = std::find_if(segments.begin(), segments.end(),
                                             [e](const StraightSegment& line) { return line.toElement == e; });
            if (before == segments.end() || before + 1 == segments.end()) continue;
            const Pose& X_GE = core.pose->X_GE[static_cast<std::size_t>(e)];
            const Vector3 A = X_GE.shiftBack(before->A), B = X_GE.shiftBack((before + 1)->B);
            const double length = before->length + contact.geodesic.length + (before + 1)->length;
            if (const std::optional<double> section = calcSectionLength(ellipsoid->semiAxes, A, B))
                note(CheckedDeviation::Kind::PlaneSection, m_studied.obstacles[i], length - *section, pose);
        }
    }

    const ModelDescription& m_description;
    const StudiedPath& m_studied;
    PathOwner m_owner;
    CheckedPath m_checked;
    int m_numPoses = 0;
    PathSolver m_solver;
};

}  // namespace

ModelCheck checkModel(const ModelDescription& description, const std::function<void(double)>& reportProgress) {
    PathStudy study(description);
    std::vector<PathChecker> checkers;
    for (const StudiedPath& path : study.getPaths()) checkers.emplace_back(description, path);
    ModelCheck check;
    const std::vector<CheckedPose> poses = makePoses(description);
    for (const auto& [pose, place] : poses) {
        const PoseAnswer answer = study.solve(pose, place);
        ++check.numPoses;
        if (reportProgress) reportProgress(check.numPoses / static_cast<double>(poses.size()));
        if (!answer.constraintFault.empty()) {
            ++check.numBrokenConstraints;
            continue;
        }
        for (std::size_t i = 0; i < checkers.size(); ++i) checkers[i].look(pose, answer.paths[i], study.getCorePath(i));
    }
    for (const PathChecker& checker : checkers) check.paths.push_back(checker.getChecked());
    return check;
}

}  // namespace tautline::models
