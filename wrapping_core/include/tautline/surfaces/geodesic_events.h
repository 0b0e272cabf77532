// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Where along a geodesic something ends that a taut string needs: found by walking along it in short pieces and by
root search between them, so for any surface and either sign of the length. */
#include <optional>
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline {

/** A place on a geodesic. */
struct GeodesicPlace {
    double s = 0;  ///< arc length from the start [m], signed as the geodesic's length is
    SurfacePoint point;
};

/** The first conjugate point, where r(s) = 0: beyond it the geodesic is no longer a shortest curve (Jacobi). Nothing
if there is none before the end, or if the geodesic cannot be shot to its end. */
std::optional<GeodesicPlace> findConjugatePoint(const Surface& surface, const GeodesicStart& start,
                                                const ShootingOptions& options = {});

/** All places inside the arc where kappaN changes sign, in order from the start: a string presses on one side of each
and would lift on the other. Pieces are an eighth of the local radius of curvature at most; two changes that lie closer
are found if kappaN dips visibly between its samples. */
std::vector<GeodesicPlace> findPressureChanges(const Surface& surface, const GeodesicStart& start,
                                               const ShootingOptions& options = {});

/** The largest kappaN along the arc: where it is positive a string would lift. It is looked for in places at most a
fifth of the surface's size apart, and between them where pressure nearly vanishes. */
double calcLargestNormalCurvature(const Surface& surface, const GeodesicStart& start, const ShotGeodesic& geodesic);

/** Where the geodesic first leaves the domain of its surface: the start if that is outside, nothing if it stays inside
from end to end. Beyond the edge patches go on smoothly, so that the search may look there. */
std::optional<GeodesicPlace> findDomainExit(const Surface& surface, const GeodesicStart& start,
                                            const ShootingOptions& options = {});

}  // namespace tautline
