// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/cable_decorations.h"

#include <algorithm>
#include <cmath>

#include "tautline/error.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/surface_mesh.h"
#include "tautline/surfaces/torus.h"

namespace tautline {

using SimTK::Array_;
using SimTK::DecorativeGeometry;
using SimTK::State;
using SimTK::Transform;

namespace {

/** Simbody draws cylinders along y, the core's stand along z. */
Transform calcCylinderPose(const Transform& X_BS) {
    const SimTK::Mat33 aboutX(1, 0, 0, 0, 0, -1, 0, 1, 0);  // a quarter turn
    return X_BS * Transform(SimTK::Rotation(aboutX, true));
}

SimTK::PolygonalMesh toPolygonalMesh(const SurfaceMesh& facets) {
    SimTK::PolygonalMesh mesh;
    for (const Vector3& point : facets.points) mesh.addVertex(toSimTK(point));
    for (const std::array<int, 4>& face : facets.faces) mesh.addFace(Array_<int>(face.begin(), face.end()));
    return mesh;
}

/** Where the cable touches an obstacle, in S. */
std::vector<Vector3> getTouchedPoints(const ObstacleContact& contact) {
    std::vector<Vector3> points;
    for (int i = 0; i < contact.getNumArcs(); ++i)
        for (const DarbouxFrame& end : {contact.getArc(i).geodesic.P, contact.getArc(i).geodesic.Q})
            points.push_back(end.x);
    return points;
}

/** Frames at the ends of all arcs. */
void addContactFrames(const Cable& cable, const State& state, CableElementIndex obstacle, SimTK::Real size,
                      Array_<DecorativeGeometry>& geometry) {
    Transform X_GP, X_GQ;
    for (int arc = 0; cable.getContactFrames(state, obstacle, X_GP, X_GQ, arc); ++arc)
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

CableDecorations& CableDecorations::setExtent(SimTK::Real sizes) {
    require(std::isfinite(sizes) && sizes > 0, "cable decorations: the extent of surfaces without end must be ",
            "positive and finite, but is ", sizes);
    m_extent = sizes;
    m_pictures.clear();
    return *this;
}

/** A new mesh is laid where the cable touches the surface beyond what is drawn. */
const SimTK::PolygonalMesh& CableDecorations::findMesh(const std::shared_ptr<const Surface>& surface,
                                                       const std::vector<Vector3>& touched_S) {
    const auto [found, isNew] = m_pictures.try_emplace(surface);
    Picture& picture = found->second;
    const auto isDrawn = [&picture](const Vector3& p) { return picture.box.contains(p); };
    if (isNew || !std::all_of(touched_S.begin(), touched_S.end(), isDrawn)) {
        // Together with those before: obstacles may share the surface.
        picture.touched_S.insert(picture.touched_S.end(), touched_S.begin(), touched_S.end());
        const SurfaceMesh facets = calcSurfaceMesh(*surface, m_extent * surface->getSize(), picture.touched_S);
        picture.mesh = toPolygonalMesh(facets);
        picture.box = facets.box;
    }
    return picture.mesh;
}

DecorativeGeometry CableDecorations::calcPicture(const Cable& cable, CableElementIndex obstacle, const State& state) {
    const std::shared_ptr<const Surface> surface = cable.getSurface(obstacle);
    const Transform& X_BS = cable.getElementFrame(obstacle);
    const std::vector<Vector3> touched_S = getTouchedPoints(cable.getSolution(state).contacts[obstacle]);
    if (const auto* sphere = dynamic_cast<const Sphere*>(surface.get()))
        return SimTK::DecorativeSphere(sphere->getRadius()).setTransform(X_BS);
    if (const auto* cylinder = dynamic_cast<const Cylinder*>(surface.get())) {
        SimTK::Real halfLength = m_extent * cylinder->getRadius();
        for (const Vector3& p : touched_S) halfLength = std::max(halfLength, std::abs(p.z()));
        return SimTK::DecorativeCylinder(cylinder->getRadius(), halfLength).setTransform(calcCylinderPose(X_BS));
    }
    if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(surface.get()))
        return SimTK::DecorativeEllipsoid(toSimTK(ellipsoid->getSemiAxes())).setTransform(X_BS);
    if (const auto* torus = dynamic_cast<const Torus*>(surface.get()))
        return SimTK::DecorativeTorus(torus->getRingRadius(), torus->getTubeRadius()).setTransform(X_BS);
    return SimTK::DecorativeMesh(findMesh(surface, touched_S)).setTransform(X_BS);
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
            geometry.push_back(
                calcPicture(cable, e, state).setBodyId(cable.getElementBody(e)).setColor(color).setOpacity(0.5));
        }
    }
}

}  // namespace tautline
