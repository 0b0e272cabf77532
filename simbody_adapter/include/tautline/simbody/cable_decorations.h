#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable_subsystem.h"

namespace tautline {

/** Draws all cables of a subsystem and the obstacles whose shape a Visualizer knows (sphere, cylinder,
ellipsoid, torus, any ContactGeometry), touched ones in a colour of their own: `visualizer.addDecorationGenerator(new
CableDecorations(cables))`. */
class CableDecorations : public SimTK::DecorationGenerator {
public:
    /** @param cables   must outlive the visualizer, as its system does */
    explicit CableDecorations(const CableSubsystem& cables) : m_cables(cables) {}

    CableDecorations& setCableColor(const SimTK::Vec3& color);
    CableDecorations& setSurfaceColor(const SimTK::Vec3& color);
    CableDecorations& setTouchedSurfaceColor(const SimTK::Vec3& color);
    /** Draws the frames at both ends of each arc (see Cable::getContactFrames()). @param length   of their axes [m];
    0, the default: none */
    CableDecorations& setContactFrameSize(SimTK::Real length);
    /** Half length drawn of infinite cylinders, in radii. */
    CableDecorations& setCylinderHalfLength(SimTK::Real radii);

    /** Realizes the state to Position where it is not. */
    void generateDecorations(const SimTK::State& state, SimTK::Array_<SimTK::DecorativeGeometry>& geometry) override;

private:
    const CableSubsystem& m_cables;
    SimTK::Vec3 m_cableColor = SimTK::Red;
    SimTK::Vec3 m_surfaceColor = SimTK::Cyan;
    SimTK::Vec3 m_touchedSurfaceColor = SimTK::Orange;
    SimTK::Real m_cylinderHalfLength = 3, m_contactFrameSize = 0;
};

}  // namespace tautline
