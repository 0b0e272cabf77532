#include "tautline/simbody/cable_decorations.h"

#include <cmath>

#include "tautline/cylinder.h"
#include "tautline/ellipsoid.h"
#include "tautline/error.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/contact_geometry_surface.h"
#include "tautline/simbody/conversions.h"
#include "tautline/sphere.h"
#include "tautline/torus.h"

namespace tautline {

using SimTK::Array_;
using SimTK::DecorativeGeometry;
using SimTK::State;
using SimTK::Transform;

namespace {

/** Simbody draws cylinders along y, the core's stand along z. */
Transform calcCylinderPose(const Transform& X_BS) {
    return X_BS * Transform(SimTK::Rotation(SimTK::Pi / 2, SimTK::XAxis));
}

/** Simbody has no picture of a height map. */
DecorativeGeometry calcDecoration(const SimTK::ContactGeometry& geometry) {
    using HeightMap = SimTK::ContactGeometry::SmoothHeightMap;
    if (!HeightMap::isInstance(geometry)) return geometry.createDecorativeGeometry();
    return SimTK::DecorativeMesh(HeightMap::getAs(geometry).getBicubicSurface().createPolygonalMesh());
}

void addSurface(const Surface& surface, const Transform& X_BS, SimTK::Real halfLength,
                const std::function<void(DecorativeGeometry)>& add) {
    if (const auto* sphere = dynamic_cast<const Sphere*>(&surface))
        add(SimTK::DecorativeSphere(sphere->getRadius()).setTransform(X_BS));
    else if (const auto* cylinder = dynamic_cast<const Cylinder*>(&surface))
        add(SimTK::DecorativeCylinder(cylinder->getRadius(), halfLength * cylinder->getRadius())
                .setTransform(calcCylinderPose(X_BS)));
    else if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&surface))
        add(SimTK::DecorativeEllipsoid(toSimTK(ellipsoid->getSemiAxes())).setTransform(X_BS));
    else if (const auto* torus = dynamic_cast<const Torus*>(&surface))
        add(SimTK::DecorativeTorus(torus->getRingRadius(), torus->getTubeRadius()).setTransform(X_BS));
    else if (const auto* wrapped = dynamic_cast<const ContactGeometrySurface*>(&surface))
        add(calcDecoration(wrapped->getContactGeometry()).setTransform(X_BS));
}

/** Frames at the ends of an arc, if there is one. */
void addContactFrames(const Cable& cable, const State& state, CableElementIndex obstacle, SimTK::Real size,
                      Array_<DecorativeGeometry>& geometry) {
    Transform X_GP, X_GQ;
    if (!cable.getContactFrames(state, obstacle, X_GP, X_GQ)) return;
    for (const Transform& X_GF : {X_GP, X_GQ})
        geometry.push_back(SimTK::DecorativeFrame(size).setTransform(X_GF).setLineThickness(2));
}

void addPath(const Cable& cable, const State& state, const SimTK::Vec3& color, Array_<DecorativeGeometry>& geometry) {
    const std::vector<SimTK::Vec3> points_G = cable.calcDrawingPoints(state);
    for (std::size_t i = 1; i < points_G.size(); ++i)
        geometry.push_back(SimTK::DecorativeLine(points_G[i - 1], points_G[i]).setColor(color).setLineThickness(3));
}

}  // namespace

CableDecorations& CableDecorations::setCableColor(const SimTK::Vec3& color) {
    m_cableColor = color;
    return *this;
}

CableDecorations& CableDecorations::setSurfaceColor(const SimTK::Vec3& color) {
    m_surfaceColor = color;
    return *this;
}

CableDecorations& CableDecorations::setTouchedSurfaceColor(const SimTK::Vec3& color) {
    m_touchedSurfaceColor = color;
    return *this;
}

CableDecorations& CableDecorations::setContactFrameSize(SimTK::Real length) {
    require(std::isfinite(length) && length >= 0, "cable decorations: the size of contact frames must be finite and ",
            "not negative, but is ", length);
    m_contactFrameSize = length;
    return *this;
}

CableDecorations& CableDecorations::setCylinderHalfLength(SimTK::Real radii) {
    m_cylinderHalfLength = radii;
    return *this;
}

void CableDecorations::generateDecorations(const State& state, Array_<DecorativeGeometry>& geometry) {
    m_cables.getMultibodySystem().realize(state, SimTK::Stage::Position);
    for (CableIndex c(0); c < m_cables.getNumCables(); ++c) {
        const Cable& cable = m_cables.getCable(c);
        if (cable.isDisabled(state)) continue;
        addPath(cable, state, m_cableColor, geometry);
        for (CableElementIndex e(0); e < cable.getNumElements(); ++e) {
            if (!cable.isObstacle(e)) continue;
            const SimTK::Vec3& color = cable.isTouched(state, e) ? m_touchedSurfaceColor : m_surfaceColor;
            if (m_contactFrameSize > 0) addContactFrames(cable, state, e, m_contactFrameSize, geometry);
            addSurface(*cable.getSurface(e), cable.getElementFrame(e), m_cylinderHalfLength,
                       [&](DecorativeGeometry shape) {
                           shape.setBodyId(cable.getElementBody(e));
                           geometry.push_back(shape.setColor(color).setOpacity(0.5));
                       });
        }
    }
}

}  // namespace tautline
