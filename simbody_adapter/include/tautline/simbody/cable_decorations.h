// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <map>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Draws all cables of a subsystem and their obstacles, touched ones in a color of their own. A CablePathSubsystem does so
by itself; in colors of your own, after CablePathSubsystem::setShowDecorations(false):
`visualizer.addDecorationGenerator(new CableDecorations(cables))`. Sphere, cylinder, ellipsoid and torus are Simbody's
own shapes, every other surface is a mesh (calcSurfaceMesh()), laid when it is first drawn. */
class CableDecorations : public SimTK::DecorationGenerator {
public:
    /** @param cables   must outlive the visualizer, as its system does */
    explicit CableDecorations(const CablePathSubsystem& cables) : m_cables(cables) {}

    CableDecorations& setCableColor(const SimTK::Vec3& color);
    CableDecorations& setSurfaceColor(const SimTK::Vec3& color);
    CableDecorations& setTouchedSurfaceColor(const SimTK::Vec3& color);
    /** Draws the frames at both ends of each arc (see Cable::getContactFrames()). @param length   of their axes [m];
    0, the default: none */
    CableDecorations& setContactFrameSize(SimTK::Real length);
    /** How far surfaces without end are drawn to each side, farther only where a cable touches them. @param sizes   in
    their characteristic lengths, of cylinders in radii, positive; 3 by default */
    CableDecorations& setExtent(SimTK::Real sizes);

    /** Realizes the state to Position if it is not yet. */
    void generateDecorations(const SimTK::State& state, SimTK::Array_<SimTK::DecorativeGeometry>& geometry) override;

private:
    /** The mesh of a surface, the box in S that holds what is drawn, and the contact points that called for it. */
    struct Picture {
        SimTK::PolygonalMesh mesh;
        Eigen::AlignedBox3d box;
        std::vector<Vector3> touched_S;
    };

    SimTK::DecorativeGeometry calcPicture(const Cable& cable, CableElementIndex obstacle, const SimTK::State& state);
    const SimTK::PolygonalMesh& findMesh(const std::shared_ptr<const Surface>& surface,
                                         const std::vector<Vector3>& touched_S);

    const CablePathSubsystem& m_cables;
    SimTK::Vec3 m_cableColor = SimTK::Red;
    SimTK::Vec3 m_surfaceColor = SimTK::Cyan;
    SimTK::Vec3 m_touchedSurfaceColor = SimTK::Orange;
    SimTK::Real m_extent = 3, m_contactFrameSize = 0;
    std::map<std::shared_ptr<const Surface>, Picture> m_pictures;
};

}  // namespace tautline
