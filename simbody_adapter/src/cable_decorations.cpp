#include "tautline/simbody/cable_decorations.h"

#include <algorithm>
#include <cmath>

#include "tautline/cylinder.h"
#include "tautline/ellipsoid.h"
#include "tautline/error.h"
#include "tautline/simbody/conversions.h"
#include "tautline/sphere.h"
#include "tautline/surface_mesh.h"
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

SimTK::PolygonalMesh toPolygonalMesh(const SurfaceMesh& facets) {
    SimTK::PolygonalMesh mesh;
    for (const Vec3& point : facets.points) mesh.addVertex(toSimTK(point));
    for (const std::array<int, 4>& face : facets.faces) mesh.addFace(Array_<int>(face.begin(), face.end()));
    return mesh;
}

/** Where the cable touches an obstacle, in S. */
std::vector<Vec3> getTouchedPoints(const ObstacleContact& contact) {
    if (!contact.isTouched) return {};
    return {contact.geodesic.P.x, contact.geodesic.Q.x};
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

CableDecorations& CableDecorations::setExtent(SimTK::Real sizes) {
    require(std::isfinite(sizes) && sizes > 0, "cable decorations: the extent of surfaces without end must be ",
            "positive and finite, but is ", sizes);
    m_extent = sizes;
    m_pictures.clear();
    return *this;
}

bool CableDecorations::Picture::covers(const std::vector<Vec3>& points_S) const {
    // Facets may end half a facet before the cube does.
    constexpr SimTK::Real kMargin = 0.2;
    const auto isInside = [&](const Vec3& p) {
        return (p - toEigen(centre_S)).lpNorm<Eigen::Infinity>() <= (1 - kMargin) * extent;
    };
    return !isCut || std::all_of(points_S.begin(), points_S.end(), isInside);
}

const SimTK::PolygonalMesh& CableDecorations::findMesh(const std::shared_ptr<const Surface>& surface,
                                                       const std::vector<Vec3>& touched_S,
                                                       const std::vector<Vec3>& near_S) {
    constexpr SimTK::Real kGrowth = 1.5;  // so that a contact that runs away has a new mesh laid only now and then
    Picture& picture = m_pictures[surface];
    if (picture.extent > 0 && picture.covers(touched_S)) return picture.mesh;
    if (picture.extent == 0) picture.extent = m_extent * surface->getSize();
    do {
        for (const Vec3& p : picture.isCut ? touched_S : std::vector<Vec3>())
            picture.extent =
                std::max(picture.extent, kGrowth * (p - toEigen(picture.centre_S)).lpNorm<Eigen::Infinity>());
        const SurfaceMesh facets = calcSurfaceMesh(*surface, picture.extent, near_S);
        picture.mesh = toPolygonalMesh(facets);
        picture.centre_S = toSimTK(facets.centre), picture.isCut = facets.isCut;
    } while (!picture.covers(touched_S));
    return picture.mesh;
}

DecorativeGeometry CableDecorations::calcPicture(const Cable& cable, CableElementIndex obstacle, const State& state) {
    const std::shared_ptr<const Surface> surface = cable.getSurface(obstacle);
    const Transform& X_BS = cable.getElementFrame(obstacle);
    const ObstacleContact& contact = cable.getSolution(state).contacts[obstacle];
    const std::vector<Vec3> touched_S = getTouchedPoints(contact);
    if (const auto* sphere = dynamic_cast<const Sphere*>(surface.get()))
        return SimTK::DecorativeSphere(sphere->getRadius()).setTransform(X_BS);
    if (const auto* cylinder = dynamic_cast<const Cylinder*>(surface.get())) {
        SimTK::Real halfLength = m_extent * cylinder->getRadius();
        for (const Vec3& p : touched_S) halfLength = std::max(halfLength, std::abs(p.z()));
        return SimTK::DecorativeCylinder(cylinder->getRadius(), halfLength).setTransform(calcCylinderPose(X_BS));
    }
    if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(surface.get()))
        return SimTK::DecorativeEllipsoid(toSimTK(ellipsoid->getSemiAxes())).setTransform(X_BS);
    if (const auto* torus = dynamic_cast<const Torus*>(surface.get()))
        return SimTK::DecorativeTorus(torus->getRingRadius(), torus->getTubeRadius()).setTransform(X_BS);
    std::vector<Vec3> near_S = touched_S;
    if (contact.clearance.C.p.allFinite()) near_S.push_back(contact.clearance.C.p);
    return SimTK::DecorativeMesh(findMesh(surface, touched_S, near_S)).setTransform(X_BS);
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
