// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tautline/geodesics/geodesic.h"
#include "tautline/surfaces/hole.h"

namespace tautline {

struct ImplicitValue;
struct ParametricValue;

/** Where a straight line comes nearest to a surface, or dips deepest below it (thesis Sec. 6.1, 7.6):
D on the line, C on the surface, D - C orthogonal to both. */
struct LineClearance {
    SurfacePoint C;                       ///< in S
    Vector3 N = Vector3::Constant(kNaN);  ///< outward normal at C, in S
    double lineCoordinate = kNaN;         ///< of D, from the segment's start [m]
    double distance = kNaN;               ///< d = (D - C) . N [m], negative: the line is below the surface
    double scale = 1;                     ///< max(|kappa_n|, 1/size) at C: d * scale is compared with d_tol
    bool found = false;                   ///< false: no critical point was found from the start given

    /** The side that is watched: C and N of the last line that was clear of the surface. They stay while a line
    is below it, or a line that goes through in many steps would carry the side along to the other one. */
    SurfacePoint keptC;
    Vector3 keptN = Vector3::Constant(kNaN);
};

/** A smooth surface in its own frame S, outward normal N: what a string can wrap over.

Implement it through ImplicitSurface (a function f(p) = 0) or ParametricSurface (x(u, v)), which deduce
everything below; override with a closed form where one exists. All methods are const and may be called
from many threads at once. Lengths in meters. No method throws for finite input. */
class Surface {
public:
    virtual ~Surface() = default;

    /** A number that no other surface of the process has, but copies of this one: it tells whether what was computed on
    a surface is of use on another. */
    std::uint64_t getId() const { return m_id; }

    /** Kind of the surface and its dimensions, for messages: "cylinder(radius=0.4)". */
    virtual std::string getDescription() const = 0;

    /** Characteristic length [m]: the scale of tolerances, step limits and hints. */
    virtual double getSize() const = 0;

    /** Height of a point above the surface [m]: exact in sign, first order in size near the surface, finite everywhere.
    Far from the surface it should not exceed the distance by more than a factor of two, for searches that march by it.
    What lies beside the domain of a surface with edges is not inside: the height there is positive.
    @param p_S   any point
    @param N_S   unit outward direction of steepest ascent at p_S */
    virtual double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const = 0;

    /** The height alone. */
    double calcHeight(const Vector3& p_S) const {
        Vector3 N_S;
        return calcHeightAndNormal(p_S, N_S);
    }

    /** A surface point near p_S: the foot of the steepest descent, the nearest point if p_S is close. */
    virtual SurfacePoint findSurfacePoint(const Vector3& p_S) const = 0;

    /** The surface point reached from `start` by a small displacement [m] in its tangent plane. */
    virtual SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const = 0;

    /** Trihedron and curvatures at a surface point, t being `direction_S` made tangent and unit. */
    virtual DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const = 0;

    /** Shoots the geodesic of `start` with its Jacobi fields (thesis Sec. 4.6, step 1). */
    virtual void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                               ShotGeodesic& geodesic) const = 0;

    /** The critical point of the line A + s e, by Newton's method from `clearance.C` and on the side of
    `clearance.N`; sets all fields but the kept ones. Closed forms need no C, and without N (not finite) take the
    side on which the line passes. findSegmentClearance() calls this with what is kept. */
    virtual void findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const;

    /** Coordinate s in [0, length] at which the segment A + s e is lowest over the surface: where to look for
    its clearance. By default the lowest of the ends and of all minima that are not next to each other. */
    virtual double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const;

    /** The function f behind an implicit surface, the x(u, v) behind a parametric one, for checks of their derivatives.
    @return false, and nothing set, if the surface has no such form */
    virtual bool calcImplicitForm(const Vector3& /*p_S*/, ImplicitValue& /*value*/) const { return false; }
    virtual bool calcParametricForm(const SurfacePoint& /*point*/, ParametricValue& /*value*/) const { return false; }

    /** True if no straight line that leaves the surface tangentially can meet it again, and a geodesic
    presses on it everywhere: such checks are then skipped. */
    virtual bool isConvex() const { return false; }

    /** The hole that a string can be threaded through, if the surface has one. */
    virtual std::optional<Hole> getHole() const { return std::nullopt; }

    /** How far inside the domain on which the surface is defined the point lies: smooth across the domain's edge, there
    zero, negative outside, in a unit of the surface's own choice; infinite where there is no edge. */
    virtual double calcDomainMargin(const SurfacePoint&) const { return kInfinity; }

    /** True where (u, v) or p lies in the domain, edges included. */
    bool isInDomain(const SurfacePoint& point) const { return calcDomainMargin(point) >= 0; }

    /** Rates of (u, v) of a point that moves along the surface with a tangential velocity.
    @return false, and nothing set, on surfaces without coordinates */
    virtual bool calcCoordinateRates(const SurfacePoint& /*point*/, const Vector3& /*velocity_S*/,
                                     Vector2& /*uvRates*/) const {
        return false;
    }

private:
    static std::uint64_t makeId();

    std::uint64_t m_id = makeId();
};

/** Points along a geodesic, ends included, by shooting from each to the next. Needs count >= 2.
@param points_S   resized to `count` */
void sampleGeodesic(const Surface& surface, const GeodesicStart& start, const ShootingOptions& options, int count,
                    std::vector<Vector3>& points_S);

}  // namespace tautline
