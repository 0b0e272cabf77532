#pragma once
#include <Simbody.h>

#include "tautline/implicit_surface.h"

namespace tautline {

/** Any smooth SimTK::ContactGeometry (isSmooth()) as a surface that a cable can wrap. SimTK's implicit
function is positive inside; its sign is turned here and nowhere else.

Not for height maps in several threads: SmoothHeightMap keeps a hint in its function object. */
class ContactGeometrySurface final : public ImplicitSurface {
public:
    /** @param geometry   smooth; copied
    @param size       characteristic length [m]; 0: about the smallest radius of curvature where the
                      way down from (1, 1, 1) meets the surface
    @throws InvalidInput if the geometry is not smooth or the size not positive and finite */
    explicit ContactGeometrySurface(const SimTK::ContactGeometry& geometry, double size = 0);

    const SimTK::ContactGeometry& getContactGeometry() const { return m_geometry; }
    std::string getDescription() const override;
    double getSize() const override { return m_size; }
    ImplicitValue calcImplicit(const Vec3& p_S) const override;

private:
    SimTK::ContactGeometry m_geometry;
    double m_size;
};

}  // namespace tautline
