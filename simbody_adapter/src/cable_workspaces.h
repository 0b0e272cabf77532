// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_tracker.h"
#include "tautline/simbody/mobility_screws.h"

namespace tautline {

/** Room for the solves of one thread, by options of the solver. Nothing in it changes an answer. */
struct CableWorkspace {
    explicit CableWorkspace(const PathSolverOptions& options) : tracker(options) {}

    PathTracker tracker;
    PathMotion startMotion;  ///< of the elements where a solve starts
    PathPose pose;
    std::vector<SpatialVelocity> V_GE;
    std::vector<BodyForceAtGround> forces;
    PathSensitivity sensitivity;
    PathVariation variation;
};

/** Lends workspaces: States are realized side by side by many threads, and copies of a State, of which an event finder
makes two dozen for each event, have none of their own. */
class CableWorkspaces {
public:
    explicit CableWorkspaces(const PathSolverOptions& options) : m_options(options) {}
    CableWorkspaces(const CableWorkspaces&) = delete;

    /** A workspace until it goes out of scope. */
    class Loan {
    public:
        Loan(CableWorkspaces& owner, std::unique_ptr<CableWorkspace> workspace)
            : m_owner(owner), m_workspace(std::move(workspace)) {}
        Loan(const Loan&) = delete;
        Loan(Loan&&) = default;
        ~Loan() {
            if (m_workspace) m_owner.takeBack(std::move(m_workspace));
        }

        CableWorkspace* operator->() const { return m_workspace.get(); }
        CableWorkspace& operator*() const { return *m_workspace; }

    private:
        CableWorkspaces& m_owner;
        std::unique_ptr<CableWorkspace> m_workspace;
    };

    Loan lend();
    const PathSolverOptions& getOptions() const { return m_options; }

private:
    void takeBack(std::unique_ptr<CableWorkspace> workspace);

    PathSolverOptions m_options;
    std::mutex m_mutex;
    std::vector<std::unique_ptr<CableWorkspace>> m_idle;
};

}  // namespace tautline
