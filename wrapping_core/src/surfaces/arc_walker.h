// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/surface.h"

namespace tautline {

/** @name Accuracies for looking along an arc whose ends are known. Both are far coarser than solving asks for, and a
fraction of its cost. */
///@{
inline constexpr ShootingOptions kAlongArc{1e-6, 200};  ///< places that are shown or judged: a millionth of the size
inline constexpr ShootingOptions kRoughlyAlong{1e-4, 200};  ///< on which side a string runs: one step of the integrator
///@}

/** Walks along an arc in equal pieces, each shot from the end of the one before. */
class ArcWalker {
public:
    /** All arguments but `start` must outlive this. */
    ArcWalker(const Surface& surface, const GeodesicStart& start, const ShootingOptions& options, int pieces)
        : m_surface(surface), m_options(options), m_from(start) {
        m_from.length = start.length / pieces;
    }

    /** The next piece. */
    const ShotGeodesic& next() {
        m_surface.shootGeodesic(m_from, m_options, m_piece);
        m_from.point = m_piece.endPoint, m_from.tangent = m_piece.Q.t;
        return m_piece;
    }

private:
    const Surface& m_surface;
    const ShootingOptions& m_options;
    GeodesicStart m_from;
    ShotGeodesic m_piece;
};

}  // namespace tautline
