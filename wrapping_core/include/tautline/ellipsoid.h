#pragma once
#include "tautline/central_quadric.h"

namespace tautline {

/** Ellipsoid about the origin of S with semi-axes along x, y, z. */
class Ellipsoid final : public CentralQuadric<Ellipsoid> {
public:
    /** @param semiAxes   [m], each positive; InvalidInput otherwise */
    explicit Ellipsoid(const Vec3& semiAxes);

    const Vec3& getSemiAxes() const { return m_semiAxes; }
    std::string getDescription() const override;

private:
    Vec3 m_semiAxes;
};

extern template class ImplicitShape<Ellipsoid>;

}  // namespace tautline
