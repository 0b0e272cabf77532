// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Solves scenes cold (static) or step by step with warm starts (moving) and judges the answers against the
verified ones. Shared by the report program and the tests. */
#include <chrono>
#include <string>
#include <vector>

#include "support/scene_file.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/contact_witness.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"

namespace tautline::testing {

struct SceneStep {
    double t = 0, rate = 0, time_s = 0;
    PathSolution path;
};

struct FoundEvent {
    double time = 0;
    int obstacle = -1;
    std::string kind;  ///< "touchdown" or "liftoff"
};

struct SceneResult {
    std::vector<SceneStep> steps;
    std::vector<FoundEvent> events;
};

/** Follows a scene through time with warm starts and locates its events. */
class SceneRunner {
public:
    SceneRunner(const Scene& scene, bool withHints, const PathSolverOptions& options = {})
        : m_scene(scene), m_problem(makeProblem(scene, withHints)), m_solver(options) {}

    const PathProblem& getProblem() const { return m_problem; }

    SceneResult run() {
        SceneResult result;
        PathSolution path;
        for (int k = 0; k < m_scene.steps; ++k) {
            const double t = m_scene.start + k * m_scene.dt;
            const PathSolution before = path;
            const auto start = std::chrono::steady_clock::now();
            calcPose(m_scene, t, m_pose);
            m_solver.solve(m_problem, m_pose, path);
            const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
            calcVelocity(m_scene, t, m_velocity);
            result.steps.push_back({t, calcLengthRate(path, m_pose, m_velocity), elapsed.count(), path});
            if (k > 0) locateEvents(before, path, t - m_scene.dt, t, result.events);
        }
        return result;
    }

private:
    PathSolution solveAt(const PathSolution& from, double t) {
        PathSolution path = from;
        calcPose(m_scene, t, m_pose);
        m_solver.solveKeepingContacts(m_problem, m_pose, path);
        return path;
    }

    /** First time in (from, to] at which a witness is negative while the contact set of `path` is kept. */
    double findFirstCrossing(const PathSolution& path, double from, double to, int& element) {
        const PathSolution atEnd = solveAt(path, to);
        const PathPose poseAtEnd = m_pose;
        double first = to;
        element = -1;
        for (int e = 1; e + 1 < m_problem.getNumElements(); ++e) {
            if (!(calcContactWitness(m_problem, poseAtEnd, atEnd, e) < 0)) continue;
            double low = from, high = to;
            while (high - low > 1e-10) {
                const double middle = 0.5 * (low + high);
                const PathSolution atMiddle = solveAt(path, middle);
                (calcContactWitness(m_problem, m_pose, atMiddle, e) < 0 ? high : low) = middle;
            }
            if (element < 0 || high < first) first = high, element = e;
        }
        return first;
    }

    /** Whether a contact of a path solved with its contacts kept would have to change. */
    bool wantsSwitch(const PathSolution& path) const {
        if (path.status != PathStatus::Solved) return false;  // where there is no path, witnesses tell nothing
        for (int e = 1; e + 1 < m_problem.getNumElements(); ++e)
            if (calcContactWitness(m_problem, m_pose, path, e) < 0) return true;
        return false;
    }

    /** Events of one step, half by half: a contact that changes there and back is at the end as it was at the start,
    and only the middle tells of it. (Nothing tells of a pair within one half.) */
    void locateEvents(PathSolution before, const PathSolution& after, double from, double to,
                      std::vector<FoundEvent>& events) {
        const double middle = 0.5 * (from + to);
        const PathSolution atMiddle = solveAt(before, middle);
        if (haveSameContacts(before, after) && !wantsSwitch(atMiddle)) return;
        followThroughEvents(before, from, middle, events);
        followThroughEvents(before, middle, to, events);
    }

    /** @param path   in: before the events; out: after the last one, as it was if there is none */
    void followThroughEvents(PathSolution& path, double from, double to, std::vector<FoundEvent>& events) {
        for (int guard = 0; guard < 2 * m_problem.getNumElements(); ++guard) {
            int element;
            const double t = findFirstCrossing(path, from, to, element);
            if (element < 0) return;
            path = solveAt(path, t);
            events.push_back({t, element - 1, path.contacts[element].isTouched ? "liftoff" : "touchdown"});
            switchContact(m_problem, m_pose, element, path);
            path = solveAt(path, t);
            from = t;
        }
    }

    Scene m_scene;
    PathProblem m_problem;
    PathSolver m_solver;
    PathPose m_pose;
    std::vector<SpatialVelocity> m_velocity;
};

/** How an answer stands to the verified one, from best to worst; Unlisted: there is none to compare it with. */
enum class Verdict { Unlisted, Solved, OtherMinimum, NoSmoothString, Wrong, NotConverged, Threw };

inline const char* getName(Verdict verdict) {
    switch (verdict) {
        case Verdict::Unlisted:
            return "unlisted";
        case Verdict::Solved:
            return "solved";
        case Verdict::OtherMinimum:
            return "other minimum";
        case Verdict::NoSmoothString:
            return "no smooth string";
        case Verdict::Wrong:
            return "wrong";
        case Verdict::NotConverged:
            return "not converged";
        case Verdict::Threw:
            return "threw";
    }
    return "";
}

/** Judges one answer: length to 1e-9, contact points to 1e-7 of the obstacle's size, flags equal.
@param withPoints   compare contact points too (static scenes and the first step of moving ones) */
inline Verdict judge(const Scene& scene, const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                     int step, bool withPoints) {
    if (!scene.hasAnswer()) return Verdict::Unlisted;
    if (path.status == PathStatus::NotConverged) return Verdict::NotConverged;
    // Without hints a string may come to lie where obstacles overlap, and says so.
    if (path.status == PathStatus::NotMinimum && path.fault.kind == StringFault::Kind::Groove && !problem.hasHints())
        return Verdict::NoSmoothString;
    if (path.status != PathStatus::Solved || !verifyPath(problem, pose, path).isMinimum()) return Verdict::Wrong;
    bool isSame = std::abs(path.length / scene.length[step] - 1) < 1e-9;
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
        const ObstacleContact& contact = path.contacts[i + 1];
        isSame = isSame && contact.isTouched == scene.contact[step][i];
        if (!isSame || !withPoints || !contact.isTouched) continue;
        const double tolerance = 1e-7 * problem.getElement(i + 1).surface->getSize();
        const Pose& X_GS = pose.X_GE[i + 1];
        isSame = isSame && (X_GS * contact.geodesic.P.x - scene.segments[i]->P).norm() < tolerance &&
                 (X_GS * contact.geodesic.Q.x - scene.segments[i]->Q).norm() < tolerance;
    }
    return isSame ? Verdict::Solved : Verdict::OtherMinimum;
}

}  // namespace tautline::testing
