#pragma once
/** Path error and its Jacobian (thesis Sec. 4.2 to 4.4) for one contact set.

A chain is the path's fixed points and touched obstacles ("contacts") in order, with a straight segment
between each and the next. Unknowns of contact i, in order: xi = (ds_P, dbeta_P, dtheta, dl), rows of its
error: (e^i.N_P, e^i.B_P, e^(i+1).N_Q, e^(i+1).B_Q). All vectors in ground. The Jacobian is block-tridiagonal
with 4 x 4 blocks of which neighbours couple through one point each. */
#include <vector>

#include "tautline/path_jacobian.h"
#include "tautline/path_problem.h"
#include "tautline/path_solution.h"

namespace tautline {

inline constexpr int kVariations = 4;     ///< natural variations of a geodesic (thesis Eqn. 4.8)
inline constexpr int kPathBandwidth = 5;  ///< of the path-error Jacobian, to either side of the diagonal

/** A touched obstacle of a chain. */
struct ChainContact {
    int element = -1;
    int segmentIn = -1;   ///< the segment that ends at P; the next one, segmentIn + 1, begins at Q
    GeodesicStart start;  ///< in S
    Geodesic geodesic;    ///< in S
    DarbouxFrame P, Q;    ///< in ground
};

/** A straight segment of a chain; contact indices are -1 where it ends at a fixed point. */
struct ChainSegment {
    StraightSegment line;
    int fromContact = -1, toContact = -1;
};

struct Chain {
    std::vector<ChainContact> contacts;
    std::vector<ChainSegment> segments;

    /** Sets stops and segments from the touched, active elements; starts come from `contacts`. Geodesics, frames and
    lines are left for shootChain(). */
    void build(const PathProblem& problem, const PathPose& pose, const std::vector<ObstacleContact>& elementContacts);
};

/** Shoots all geodesics of the chain (step 1 of thesis Sec. 4.6) and lays the straight segments.
@return false if a geodesic did not come to its end or a number is not finite */
bool shootChain(const PathProblem& problem, const PathPose& pose, const GeodesicOptions& options, Chain& chain);

/** eps of all contacts, 4 per contact. @param eps   resized. @return max |eps|, 0 without contacts */
double calcPathError(const Chain& chain, std::vector<double>& eps);

/** d eps / d xi (thesis Eqn. 4.47 to 4.56). @param jacobian   resized */
void calcPathErrorJacobian(const Chain& chain, PathJacobian& jacobian);

/** Length of segments and arcs [m]. */
double calcLength(const Chain& chain);

/** Derivatives of a trihedron {x, t, N, B} under the four natural variations, one column per variation. */
struct FrameVariations {
    Eigen::Matrix<double, 3, kVariations> x, N, B;
};
FrameVariations calcStartVariations(const DarbouxFrame& P);
FrameVariations calcEndVariations(const DarbouxFrame& Q, const Geodesic& geodesic);

/** The start corrected by finite natural corrections (thesis Sec. 4.5, 7.5). */
GeodesicStart calcCorrectedStart(const Surface& surface, const GeodesicStart& start, const DarbouxFrame& P_S,
                                 const Vec4& correction);

}  // namespace tautline
