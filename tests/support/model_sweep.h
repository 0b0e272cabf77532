// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Looks for jumps of length where one coordinate of a model goes over its range. */
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tautline/models/path_study.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {

/** Between two values of a coordinate next to each other. */
struct LengthJump {
    /** Why the length jumps, as far as the paths before and after tell. */
    enum class Cause {
        Point,      ///< a conditional point comes or goes
        Entered,    ///< a point enters an object, or leaves it, which OpenSim switches off then
        Engaged,    ///< OpenSim's rules let an object engage, or no longer
        NoMinimum,  ///< one of the paths is no shortest one, and says so
        Slipped,    ///< the cable has no stable path left there: the path of one side does not go on
        Minima,     ///< both paths go on past the jump, each as a shortest one: the search changed its mind
    };
    std::string coordinate, path;
    double value = 0;              ///< of the coordinate [rad or m]
    double before = 0, after = 0;  ///< lengths [m]
    Cause cause = Cause::Minima;
    std::string detail = {};  ///< the point or object, or what the paths touch before and after
};

inline const char* getName(LengthJump::Cause cause) {
    switch (cause) {
        case LengthJump::Cause::Point:
            return "conditional point";
        case LengthJump::Cause::Entered:
            return "point enters object";
        case LengthJump::Cause::Engaged:
            return "object engages";
        case LengthJump::Cause::NoMinimum:
            return "no minimum";
        case LengthJump::Cause::Slipped:
            return "slips";
        case LengthJump::Cause::Minima:
            break;
    }
    return "other minimum";
}

/** Whether OpenSim's rules put it there, or a string would do so, too. */
inline bool isExplained(LengthJump::Cause cause) {
    return cause != LengthJump::Cause::Minima;
}

/** A pose in which a continued path is another one than that of the pose alone. */
struct WalkMiss {
    std::string coordinate, path;
    double value = 0;              ///< of the coordinate [rad or m]
    double walked = 0, alone = 0;  ///< lengths [m]
};

struct SweepReport {
    std::vector<LengthJump> jumps;
    std::vector<WalkMiss> misses;
    long numPoses = 0;
};

/** Sweeps over the coordinates of a model. */
class ModelSweep {
public:
    using ModelPose = models::ModelPose;
    using PoseAnswer = models::PoseAnswer;

    /** @param base   values of the coordinates that are not swept, over their defaults */
    explicit ModelSweep(models::ModelDescription description, std::map<std::string, double> base = {})
        : m_description(std::move(description)),
          m_base(std::move(base)),
          m_walked(m_description),
          m_alone(m_description) {}

    /** @param steps   of each coordinate over its range, or by 1 to either side of its default where that is unbounded
     */
    SweepReport run(int steps) {
        m_report = {};
        for (const models::Joint& joint : m_description.joints)
            for (const models::Coordinate& coordinate : joint.coordinates)
                if (!coordinate.locked && !coordinate.prescribedMotion && !isDependent(coordinate.name))
                    sweep(coordinate, steps);
        return m_report;
    }

private:
    static constexpr double kLeastJump = 1e-5;  ///< [m]
    static constexpr double kWalkTolerance = 1e-9;

    bool isDependent(const std::string& name) const {
        for (const auto& constraint : m_description.constraints)
            if (const auto* coupler = std::get_if<models::CoordinateCoupler>(&constraint))
                if (coupler->dependentCoordinate == name) return true;
        return false;
    }

    /** The speed is 1, so that rates are slopes, along constraints as far as couplers say. */
    ModelPose makePose(const std::string& coordinate, double value) const {
        ModelPose pose;
        pose.values = m_base;
        pose.values[coordinate] = value;
        pose.speeds[coordinate] = 1;
        return pose;
    }

    void sweep(const models::Coordinate& coordinate, int steps) {
        const auto [low, high] = coordinate.range;
        const double begin = std::isfinite(low) ? low : coordinate.defaultValue - 1;
        const double end = std::isfinite(high) ? high : coordinate.defaultValue + 1;
        PoseAnswer last;
        for (int i = 0; i <= steps; ++i) {
            const double value = begin + (end - begin) * i / steps;
            const ModelPose pose = makePose(coordinate.name, value);
            const PoseAnswer walked = m_walked.solve(pose, i);
            PoseAnswer alone = m_alone.solve(pose);
            ++m_report.numPoses;
            compare(coordinate.name, value, walked, alone);
            if (i > 0) lookForJumps(coordinate.name, value - (end - begin) / steps, value, last, alone);
            last = std::move(alone);
        }
    }

    void compare(const std::string& coordinate, double value, const PoseAnswer& walked, const PoseAnswer& alone) {
        for (std::size_t p = 0; p < alone.paths.size(); ++p)
            if (!(std::abs(walked.paths[p].length - alone.paths[p].length) < kWalkTolerance))
                m_report.misses.push_back(
                    {coordinate, m_alone.getPaths()[p].name, value, walked.paths[p].length, alone.paths[p].length});
    }

    /** Where a length changes by more than its slopes at both ends allow, by half of their mean at least. */
    static bool mayJump(const models::PathAnswer& a, const models::PathAnswer& b, double step) {
        const double change = std::abs(b.length - a.length);
        return std::abs(b.length - a.length - 0.5 * step * (a.rate + b.rate)) > kLeastJump && change > kLeastJump;
    }

    void lookForJumps(const std::string& coordinate, double from, double to, const PoseAnswer& first,
                      const PoseAnswer& last) {
        for (std::size_t p = 0; p < first.paths.size(); ++p)
            if (mayJump(first.paths[p], last.paths[p], to - from)) narrow(coordinate, from, to, p);
    }

    /** Halves an interval down to the last digits, keeping the half over which the length is steeper. */
    void narrow(const std::string& coordinate, double from, double to, std::size_t p) {
        const auto solve = [&](double value) { return m_alone.solve(makePose(coordinate, value)).paths[p]; };
        models::PathAnswer a = solve(from), b = solve(to);
        while (to - from > 1e-10 * (1 + std::abs(from))) {
            const double middle = 0.5 * (from + to);
            const models::PathAnswer c = solve(middle);
            const double left = std::abs(c.length - a.length - 0.25 * (to - from) * (a.rate + c.rate)),
                         right = std::abs(b.length - c.length - 0.25 * (to - from) * (b.rate + c.rate));
            if (left > right)
                to = middle, b = c;
            else
                from = middle, a = c;
            if (!(std::abs(b.length - a.length) > kLeastJump)) return;
        }
        m_report.jumps.push_back({coordinate, m_alone.getPaths()[p].name, to, a.length, b.length});
        explain(from, to, p, m_report.jumps.back());
    }

    struct Side {
        PathProblem problem;
        PathPose pose;
        PathSolution solution;
        models::PathAnswer answer;
    };

    Side look(const std::string& coordinate, double value, std::size_t p) {
        Side side;
        side.answer = m_alone.solve(makePose(coordinate, value)).paths[p];
        const models::CorePath core = m_alone.getCorePath(p);
        side.problem = *core.problem, side.pose = *core.pose, side.solution = *core.solution;
        return side;
    }

    static std::string listTouched(const Side& side) {
        std::string list;
        for (int e = 0; e < side.problem.getNumElements(); ++e)
            if (side.solution.contacts[static_cast<std::size_t>(e)].isTouched)
                list += (list.empty() ? "" : "+") + side.problem.getElement(e).name;
        return list.empty() ? "nothing" : list;
    }

    void explain(double from, double to, std::size_t p, LengthJump& jump) {
        using Cause = LengthJump::Cause;
        const Side a = look(jump.coordinate, from, p), b = look(jump.coordinate, to, p);
        for (int e = 0; e < a.problem.getNumElements(); ++e) {
            const bool isPoint = a.problem.getElement(e).isPoint();
            const auto at = static_cast<std::size_t>(e);
            const bool isOffBefore = a.solution.contacts[at].isSwitchedOff,
                       isOffAfter = b.solution.contacts[at].isSwitchedOff;
            if (a.pose.hasElement(e) != b.pose.hasElement(e)) {
                jump.cause = isPoint ? Cause::Point : Cause::Engaged;
                jump.detail = a.problem.getElement(e).name;
                if (isPoint) return;
            } else if (!isPoint && isOffBefore != isOffAfter) {
                jump.cause = Cause::Entered;
                jump.detail = a.problem.getElement(e).name;
            }
        }
        if (jump.cause != Cause::Minima) return;
        jump.detail = listTouched(a) + " -> " + listTouched(b);
        if (!a.answer.isSound() || !b.answer.isSound()) {
            jump.cause = Cause::NoMinimum;
            jump.detail += " (" + (a.answer.isSound() ? b : a).answer.explanation + ")";
        } else if (!goesOn(a, b) || !goesOn(b, a)) {
            jump.cause = Cause::Slipped;
        }
    }

    /** Whether the path of one side is a shortest one on the other, too. */
    static bool goesOn(const Side& from, const Side& to) {
        PathSolverOptions options;
        options.allowsColdStart = false;
        PathSolution path = from.solution;
        PathSolver(options).solve(from.problem, to.pose, path);
        const bool isMinimum = path.status == PathStatus::Solved || path.status == PathStatus::EndInside;
        return isMinimum && std::abs(path.length - from.solution.length) < kLeastJump;
    }

    models::ModelDescription m_description;
    std::map<std::string, double> m_base;
    models::PathStudy m_walked, m_alone;
    SweepReport m_report;
};

}  // namespace tautline::testing
