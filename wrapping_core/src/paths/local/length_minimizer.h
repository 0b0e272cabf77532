// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/equations/block_ldlt.h"
#include "paths/equations/length_derivatives.h"
#include "paths/local/path_stepper.h"

namespace tautline {

/** Minimizes the length of the paths over one contact set whose segments are tangent to the surfaces:

    min L(xi)   such that   c = (e^i.N_P, e^(i+1).N_Q) = 0 at every contact,

by sequential quadratic programming. Each step (d, lambda) solves the block-tridiagonal system

    [ H + delta W   A^T ] [ d      ]   [ -g ]      H = d2L/dxi2,  g = dL/dxi,  A = dc/dxi,
    [ A             0   ] [ lambda ] = [ -c ]      W the squared inverse scales of xi,

with delta raised until the matrix has the inertia of a minimum, and is shortened until the exact penalty function
L + nu |c|_1 falls, with a second-order correction where the surfaces' curvature spoils it. At a stationary path lambda
= 0 (there the gradient of L vanishes without the conditions), so that their curvature may be left out of H; the last
steps are those of Newton's method on the path error, and quadratic. Where Newton's method goes to any stationary path,
or to none, this one goes downhill. Holds the workspace. */
class LengthMinimizer {
public:
    explicit LengthMinimizer(const PathSolverOptions& options) : m_options(options), m_stepper(options) {}

    /** @param path   in: contact set and starts of the arcs; out: arcs, segments, length and error, finite also where
    the minimization fails. @return true if max |eps| <= tolerance */
    bool minimize(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
        return minimize(problem, pose, m_options.maxIterations, path);
    }

    /** The same with fewer iterations, if `maxIterations` is less than the options say. */
    bool minimize(const PathProblem& problem, const PathPose& pose, int maxIterations, PathSolution& path);

private:
    bool takeStep(PathSolution& path);
    void assemble(double delta);
    bool solve(bool isDownhill, const std::vector<double>& eps, std::vector<double>& step);
    double calcPositiveFraction(double fraction) const;
    bool tryCorrected(double fraction, PathSolution& path);
    double predictChange(double& slope) const;
    bool hasInertiaOfMinimum() const;
    double calcViolation(const Chain& chain, const std::vector<double>& eps) const;
    bool searchLine(PathSolution& path);
    Vector4 calcScales(std::size_t contact) const;

    PathSolverOptions m_options;
    PathStepper m_stepper;
    PathJacobian m_jacobian;
    BlockLdlt m_kkt;
    std::vector<double> m_solution;  ///< d and lambda of each contact in turn, both scaled
    std::vector<LengthHessianBlocks> m_hessian;
    std::vector<double> m_gradient, m_step, m_corrected;
    double m_delta = 0, m_penalty = 0;
};

}  // namespace tautline
