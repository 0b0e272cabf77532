#include "tautline/simbody/cable_decorations.h"

#include "tautline/cylinder.h"
#include "tautline/ellipsoid.h"
#include "tautline/simbody/cable.h"
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
            addSurface(*cable.getSurface(e), cable.getElementFrame(e), m_cylinderHalfLength,
                       [&](DecorativeGeometry shape) {
                           shape.setBodyId(cable.getElementBody(e));
                           geometry.push_back(shape.setColor(m_surfaceColor).setOpacity(0.5));
                       });
        }
    }
}

}  // namespace tautline
