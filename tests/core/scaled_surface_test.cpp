// SPDX-License-Identifier: Apache-2.0
/** Surfaces under linear maps: against shapes that they are, and refusals. The laws are in surface_laws_test. */
#include "tautline/surfaces/scaled_surface.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/random.h"
#include "support/surface_cases.h"
#include "tautline/error.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

const Vector3 kAxes(0.05, 0.03, 0.08);

Matrix3 makeTurn() {
    return Eigen::AngleAxisd(1.1, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();
}

/** So strong that the plane z = 0 tells nothing of a ring's hole. */
Matrix3 makeShear() {
    Matrix3 shear = Matrix3::Identity();
    shear(2, 0) = 1.5;
    return shear;
}

TEST(ScaledSurface, OfASphereByFactorsIsTheEllipsoid) {
    const Ellipsoid ellipsoid(kAxes);
    const ScaledImplicitSurface<Sphere> implicitForm(Sphere(1), kAxes);
    const ScaledParametricSurface<ParametricSphere> parametricForm(ParametricSphere(1), kAxes);
    for (const SurfaceLawSample& sample : makeSamples(ellipsoid, 0.1, Vector3::Zero(), 0.1, {}, 20, 7)) {
        const SurfacePoint p = ellipsoid.findSurfacePoint(sample.p_S);
        for (const Surface* scaled :
             {static_cast<const Surface*>(&implicitForm), static_cast<const Surface*>(&parametricForm)}) {
            ShotGeodesic g, h;
            ellipsoid.shootGeodesic({p, sample.direction_S, sample.length}, {}, g);
            scaled->shootGeodesic({scaled->findSurfacePoint(p.p), sample.direction_S, sample.length}, {}, h);
            EXPECT_LT((g.Q.x - h.Q.x).norm() / 0.03 + (g.Q.t - h.Q.t).norm() + (g.Q.N - h.Q.N).norm(), 1e-10);
        }
    }
}

/** A path over the ellipsoid, whose frame stands in the scaled surface's by `R_SE`. */
struct EllipsoidPath {
    PathProblem problem;
    PathPose pose;
    std::vector<SpatialVelocity> velocity;

    EllipsoidPath(std::shared_ptr<const Surface> surface, const Matrix3& R_SE, unsigned seed) {
        Random random(seed);
        const Vector3 way = random.unitVector(), aside = way.unitOrthogonal();
        const Pose X_GE(random.rotation(), random.vector(0.005));
        const Vector3 aside_E = X_GE.rotateBack(aside), near_E = aside_E / aside_E.cwiseQuotient(kAxes).norm();
        problem.addPoint("origin");
        problem.addObstacle("ellipsoid", std::move(surface), PassNear{R_SE * near_E});
        problem.addPoint("insertion");
        pose.X_GE = {Pose(0.2 * way + 0.02 * aside), Pose(X_GE.R * R_SE.transpose(), X_GE.p),
                     Pose(-0.15 * way + 0.015 * aside)};
        for (int e = 0; e < 3; ++e) velocity.push_back({random.vector(1), random.vector(1)});
    }
};

/** An ellipsoid is a sphere stretched along any three orthogonal axes, in every form. */
TEST(ScaledSurface, PathsOverASphereScaledAlongTurnedAxesAreThoseOverTheEllipsoid) {
    const Matrix3 R_SE = makeTurn(), M = R_SE * kAxes.asDiagonal() * R_SE.transpose(),
                  askew = R_SE * kAxes.asDiagonal();
    const std::shared_ptr<const Surface> scaled[] = {
        std::make_shared<ScaledImplicitSurface<Sphere>>(Sphere(1), M),
        std::make_shared<ScaledParametricSurface<ParametricSphere>>(ParametricSphere(1), M),
        std::make_shared<ScaledImplicitSurface<Sphere>>(Sphere(1), askew),
        makeScaledSurface(std::make_shared<Sphere>(1), M),
        makeScaledSurface(std::make_shared<ParametricSphere>(1), askew),
    };
    int touched = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const EllipsoidPath truth(std::make_shared<Ellipsoid>(kAxes), Matrix3::Identity(), seed);
        const PathSolution path = solvePath(truth.problem, truth.pose);
        ASSERT_EQ(path.status, PathStatus::Solved);
        touched += path.contacts[1].isTouched;
        const double rate = calcLengthRate(path, truth.pose, truth.velocity);
        for (const auto& surface : scaled) {
            const EllipsoidPath twin(surface, R_SE, seed);
            const PathSolution twinPath = solvePath(twin.problem, twin.pose);
            ASSERT_EQ(twinPath.status, PathStatus::Solved) << surface->getDescription() << ", seed " << seed;
            EXPECT_EQ(twinPath.contacts[1].isTouched, path.contacts[1].isTouched);
            EXPECT_NEAR(twinPath.length, path.length, 1e-10 * path.length) << surface->getDescription();
            EXPECT_NEAR(calcLengthRate(twinPath, twin.pose, twin.velocity), rate, 1e-10) << surface->getDescription();
        }
    }
    EXPECT_GT(touched, 10);
}

TEST(ScaledSurface, ItsSizeIsThatOfTheBaseByTheLeastFactorAndConvexStaysConvex) {
    const Matrix3 M = makeBodyScaling(Vector3(2.5, 0.5, 1));
    const ScaledImplicitSurface<Sphere> sphere(Sphere(0.3), M);
    EXPECT_NEAR(sphere.getSize(), 0.15, 1e-15);
    EXPECT_TRUE(sphere.isConvex());
    EXPECT_FALSE(ScaledImplicitSurface<Torus>(Torus(0.3, 0.1), M).isConvex());
    EXPECT_EQ(ScaledImplicitSurface<Sphere>(Sphere(0.3), Vector3(1, 2, 3)).getDescription(),
              "sphere(radius=0.3) scaled by (1, 2, 3)");
}

TEST(ScaledSurface, ItsHoleAndItsEdgeGoAlongWithTheMap) {
    const Matrix3 shear = makeShear();
    const ScaledImplicitSurface<Torus> ring(Torus(0.3, 0.1), shear);
    const Vector3 inPlane = shear * Vector3(0.15, 0, 0), axis = ring.getHole()->getAxis();
    EXPECT_NEAR(axis.dot(shear * Vector3(1, 2, 0)), 0, 1e-15);
    EXPECT_EQ(ring.getHole()->countCrossings(inPlane - 0.1 * axis, inPlane + 0.1 * axis), 1);
    EXPECT_EQ(ring.getHole()->countCrossings(inPlane + 0.1 * axis, inPlane - 0.1 * axis), -1);
    EXPECT_EQ(ring.getHole()->countCrossings(Vector3(0.15, 0, -0.1), Vector3(0.15, 0, 0.1)), 0);
    EXPECT_EQ(Torus(0.3, 0.1).getHole()->countCrossings(Vector3(0.15, 0, -0.1), Vector3(0.15, 0, 0.1)), 1);

    const ScaledImplicitSurface<Cone> cone(Cone(0.4, 0.3, 0.1), shear);
    const Vector3 generator(std::tan(0.4), 0, 1);
    EXPECT_TRUE(cone.isInDomain({shear * (0.11 / std::tan(0.4) * generator)}));
    EXPECT_FALSE(cone.isInDomain({shear * (0.09 / std::tan(0.4) * generator)}));
}

/** From below the sheared ring to above, or from above to below. */
TEST(ScaledSurface, AShearedRingIsThreadedAsOftenAsHinted) {
    const auto ring = std::make_shared<ScaledImplicitSurface<Torus>>(Torus(0.3, 0.1), makeShear());
    const Vector3 axis = ring->getHole()->getAxis(), aside = 0.5 * axis.unitOrthogonal();
    for (const int passages : {-2, -1, 0, 1, 2}) {
        const double side = passages < 0 ? -1 : 1;
        PathProblem problem;
        problem.addPoint("origin");
        problem.addObstacle("ring", ring, ThreadHole{passages});
        problem.addPoint("insertion");
        PathPose pose;
        pose.X_GE = {Pose(Vector3(aside - side * axis)), Pose(), Pose(Vector3(aside + side * axis))};
        const PathSolution path = solvePath(problem, pose);
        EXPECT_EQ(path.status, PathStatus::Solved) << passages;
        EXPECT_EQ(path.contacts[1].passage.count, passages);
        const double offPlane = passages == 0 ? 0 : axis.dot(path.contacts[1].passage.through_S);
        EXPECT_NEAR(offPlane, 0, 1e-12);
    }
}

class UserBlob final : public ImplicitSurface {
public:
    ImplicitValue calcImplicit(const Vector3& p) const override { return m_ellipsoid.calcImplicit(p); }
    double getSize() const override { return 0.03; }
    std::string getDescription() const override { return "blob"; }

private:
    Ellipsoid m_ellipsoid{kAxes};
};

TEST(ScaledSurface, AUsersOwnSurfaceIsScaledAsTheKnownOne) {
    const Matrix3 M = makeBodyScaling(Vector3(1.2, 0.7, 1));
    const ScaledImplicitSurface<Ellipsoid> known(Ellipsoid(kAxes), M);
    const auto shared = makeScaledSurface(std::make_shared<UserBlob>(), M);
    EXPECT_EQ(shared->getSize(), known.getSize());
    EXPECT_EQ(shared->getDescription().rfind("blob scaled by [", 0), 0u) << shared->getDescription();
    for (const SurfaceLawSample& sample : makeSamples(known, 0.1, Vector3::Zero(), 0.1, {}, 10, 9)) {
        ShotGeodesic g, h;
        const SurfacePoint p = known.findSurfacePoint(sample.p_S);
        known.shootGeodesic({p, sample.direction_S, sample.length}, {}, g);
        shared->shootGeodesic({p, sample.direction_S, sample.length}, {}, h);
        EXPECT_LT((g.Q.x - h.Q.x).norm(), 1e-14);
    }
}

/** Neither form: what a surface answers must come from somewhere. */
class Formless final : public Surface {
public:
    double getSize() const override { return m_sphere.getSize(); }
    std::string getDescription() const override { return "formless"; }
    double calcHeightAndNormal(const Vector3& p, Vector3& N) const override {
        return m_sphere.calcHeightAndNormal(p, N);
    }
    SurfacePoint findSurfacePoint(const Vector3& p) const override { return m_sphere.findSurfacePoint(p); }
    SurfacePoint calcDisplacedPoint(const SurfacePoint& p, const Vector3& d) const override {
        return m_sphere.calcDisplacedPoint(p, d);
    }
    DarbouxFrame calcFrame(const SurfacePoint& p, const Vector3& d) const override { return m_sphere.calcFrame(p, d); }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options, ShotGeodesic& g) const override {
        m_sphere.shootGeodesic(start, options, g);
    }

private:
    Sphere m_sphere{1};
};

std::string findRefusal(const std::function<void()>& make) {
    try {
        make();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ScaledSurface, RefusalsNameTheValueAndTheLimit) {
    const auto refuse = [](const Matrix3& M) {
        return findRefusal([&] { ScaledImplicitSurface<Sphere>(Sphere(1), M); });
    };
    const auto contains = [](const std::string& text, const std::string& word) {
        return text.find(word) != std::string::npos ? "" : text;
    };
    EXPECT_EQ(contains(findRefusal([] { ScaledImplicitSurface<Sphere>(Sphere(1), Vector3(1, 0, 1)); }), "factor y"),
              "");
    EXPECT_EQ(contains(findRefusal([] { ScaledImplicitSurface<Sphere>(Sphere(1), Vector3(1, 1, -2)); }), "-2"), "");
    EXPECT_EQ(contains(refuse(Matrix3(Vector3(1, 1, -0.5).asDiagonal())), "must be positive, but is -0.5"), "");
    EXPECT_EQ(contains(refuse(Matrix3::Ones()), "but is 0"), "");
    EXPECT_EQ(contains(refuse(Matrix3(Vector3(1, 1e-7, 1).asDiagonal())), "of the largest, 1, but is 9.99"), "");
    Matrix3 notFinite = Matrix3::Identity();
    notFinite(1, 2) = kNaN;
    EXPECT_EQ(contains(refuse(notFinite), "must be finite, but is [1, 0, 0; 0, 1, nan; 0, 0, 1]"), "");
    const Matrix3 M = Matrix3::Identity();
    EXPECT_EQ(contains(findRefusal([&] { makeScaledSurface(nullptr, M); }), "needs a base"), "");
    EXPECT_EQ(
        contains(findRefusal([&] { makeScaledSurface(std::make_shared<Formless>(), M); }), "formless has neither"), "");
}

}  // namespace
}  // namespace tautline::testing
