// SPDX-License-Identifier: Apache-2.0
/** Joint transforms against an evaluation that shares no code with the builder: Rodrigues' formula on plain arrays. */
#include <array>
#include <cmath>
#include <map>

#include "model_test_support.h"

namespace tautline::models::testing {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

struct Pose {
    Matrix R{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Triple p{};
};

Matrix rodrigues(Triple axis, double angle) {
    const double norm = std::hypot(axis[0], axis[1], axis[2]);
    for (double& component : axis) component /= norm;
    const Matrix cross{{{0, -axis[2], axis[1]}, {axis[2], 0, -axis[0]}, {-axis[1], axis[0], 0}}};
    const double c = std::cos(angle), s = std::sin(angle);
    Matrix R{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            R[i][j] = (i == j ? c : 0.0) + s * cross[i][j] + (1 - c) * axis[i] * axis[j];
    return R;
}

Triple times(const Matrix& R, const Triple& v) {
    Triple w{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) w[i] += R[i][k] * v[k];
    return w;
}

Pose times(const Pose& a, const Pose& b) {
    Pose c;
    c.p = times(a.R, b.p);
    for (std::size_t i = 0; i < 3; ++i) {
        c.p[i] += a.p[i];
        for (std::size_t j = 0; j < 3; ++j) {
            c.R[i][j] = 0.0;
            for (std::size_t k = 0; k < 3; ++k) c.R[i][j] += a.R[i][k] * b.R[k][j];
        }
    }
    return c;
}

Pose inverse(const Pose& a) {
    Pose b;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) b.R[i][j] = a.R[j][i];
    b.p = times(b.R, a.p);
    for (double& component : b.p) component = -component;
    return b;
}

Pose turn(const Triple& axis, double angle) {
    Pose pose;
    pose.R = rodrigues(axis, angle);
    return pose;
}

Pose shift(const Triple& by) {
    Pose pose;
    pose.p = by;
    return pose;
}

Pose offset(const Triple& translation, const Triple& xyz) {
    return times(shift(translation),
                 times(turn({1, 0, 0}, xyz[0]), times(turn({0, 1, 0}, xyz[1]), turn({0, 0, 1}, xyz[2]))));
}

const Triple parentTranslation{0.1, -0.2, 0.3}, parentAngles{0.4, -0.5, 0.6};
const Triple childTranslation{-0.05, 0.07, 0.02}, childAngles{-0.3, 0.8, 1.1};
const std::string frames = makeOffsetFrame("a", "/ground", "0.1 -0.2 0.3", "0.4 -0.5 0.6") +
                           makeOffsetFrame("b", "/bodyset/one", "-0.05 0.07 0.02", "-0.3 0.8 1.1");
const std::string swappedFrames = makeOffsetFrame("b", "/ground", "0.1 -0.2 0.3", "0.4 -0.5 0.6") +
                                  makeOffsetFrame("a", "/bodyset/one", "-0.05 0.07 0.02", "-0.3 0.8 1.1");

std::string makeModel(const std::string& type, const std::string& inside, const std::string& itsFrames = frames) {
    return makeBodySet(makeBody("one")) + makeJointSet(makeJoint(type, "joint", itsFrames, inside));
}

double compare(const SimTK::Transform& X, const Pose& pose) {
    double worst = 0.0;
    for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<std::size_t>(i);
        worst = std::max(worst, std::abs(X.p()[i] - pose.p[row]));
        for (int j = 0; j < 3; ++j) {
            const double expected = pose.R[row][static_cast<std::size_t>(j)];
            worst = std::max(worst, std::abs(X.R()[i][j] - expected));
        }
    }
    return worst;
}

/** The body's pose must be parent offset * X_FM * inverse(child offset). */
void expectPose(BuiltSystem& built, const Pose& X_FM) {
    built.system.realize(built.state, SimTK::Stage::Position);
    const Pose expected =
        times(offset(parentTranslation, parentAngles), times(X_FM, inverse(offset(childTranslation, childAngles))));
    EXPECT_LT(compare(built.model.getBody("one").getBodyTransform(built.state), expected), 1e-14);
}

/** The same where the file's parent is the body and its child the ground. */
void expectReversedPose(BuiltSystem& built, const Pose& X_FM) {
    expectPose(built, inverse(X_FM));
}

const Triple turnAxes[3] = {{0.2, -0.1, 1.0}, {0.0, 3.0, 0.1}, {1.0, 0.2, -0.1}};
const Triple shiftAxes[3] = {{2.0, 0.0, 0.0}, {0.1, 1.0, 0.0}, {0.0, 0.3, -1.0}};

std::string makeAxis(const std::string& name, const std::string& coordinate, const std::string& axis,
                     const std::string& function) {
    return "<TransformAxis name=\"" + name + "\"><coordinates>" + coordinate + "</coordinates><axis>" + axis +
           "</axis>" + function + "</TransformAxis>\n";
}

const std::string spatialTransform =
    "<SpatialTransform>" +
    makeAxis("rotation1", "q", "0.2 -0.1 1", "<LinearFunction><coefficients>1.5 -0.2</coefficients></LinearFunction>") +
    makeAxis("rotation2", "r", "0 3 0.1", "") +
    makeAxis("rotation3", "", "1 0.2 -0.1", "<Constant><value>0.3</value></Constant>") +
    makeAxis("translation1", "q", "2 0 0", "<SimmSpline><x>-2 0 2</x><y>4 0 4</y></SimmSpline>") +
    makeAxis("translation2", "r", "0.1 1 0",
             "<PolynomialFunction><coefficients>1 0 0 1</coefficients></PolynomialFunction>") +
    makeAxis("translation3", "", "0 0.3 -1", "<Constant><value>-0.4</value></Constant>") + "</SpatialTransform>";

Triple scaleUnit(Triple axis, double factor) {
    const double norm = std::hypot(axis[0], axis[1], axis[2]);
    for (double& component : axis) component *= factor / norm;
    return axis;
}

/** spatialTransform evaluated by hand. */
Pose calcCustom(double q, double r) {
    Pose X_FM = times(turn(turnAxes[0], 1.5 * q - 0.2), times(turn(turnAxes[1], r), turn(turnAxes[2], 0.3)));
    const double amounts[3] = {q * q, r * r * r + 1.0, -0.4};
    for (std::size_t i = 0; i < 3; ++i) {
        const Triple by = scaleUnit(shiftAxes[i], amounts[i]);
        for (std::size_t k = 0; k < 3; ++k) X_FM.p[k] += by[k];
    }
    return X_FM;
}

TEST(JointConvention, CustomJoint) {
    BuiltSystem built(readNew(makeModel("CustomJoint", makeCoordinates({"q", "r"}) + spatialTransform)));
    for (double q : {-0.9, 0.0, 0.4, 1.3}) {
        for (double r : {-0.8, 0.3, 1.1}) {
            built.set("q", q);
            built.set("r", r);
            expectPose(built, calcCustom(q, r));
        }
    }
}

TEST(JointConvention, CustomJointReachedFromItsChild) {
    BuiltSystem built(readNew(makeModel("CustomJoint", makeCoordinates({"q", "r"}) + spatialTransform, swappedFrames)));
    built.set("q", 0.4);
    built.set("r", -0.8);
    expectReversedPose(built, calcCustom(0.4, -0.8));
}

TEST(JointConvention, VelocityOfCustomJointIsTheDerivativeOfItsPose) {
    BuiltSystem built(readNew(makeModel("CustomJoint", makeCoordinates({"q", "r"}) + spatialTransform)));
    const double q = 0.4, r = -0.8, qRate = 0.7, rRate = -1.1, h = 1e-5;
    const SimTK::Vec3 station(0.3, 0.1, -0.2);
    const auto locate = [&](double time) {
        built.set("q", q + time * qRate);
        built.set("r", r + time * rRate);
        return built.model.calcStationLocation(built.state, "one", station);
    };
    const SimTK::Vec3 difference = (locate(h) - locate(-h)) / (2 * h);
    const SimTK::Vec3 second = (locate(h) - 2 * locate(0) + locate(-h)) / (h * h);
    built.set("q", q);
    built.set("r", r);
    built.model.setCoordinateSpeed(built.state, "q", qRate);
    built.model.setCoordinateSpeed(built.state, "r", rRate);
    built.system.realize(built.state, SimTK::Stage::Velocity);
    const auto& body = built.model.getBody("one");
    EXPECT_LT((body.findStationVelocityInGround(built.state, station) - difference).norm(), 1e-9);
    // At rest accelerations the station accelerates by the bias alone.
    SimTK::Vector_<SimTK::SpatialVec> accelerations;
    built.matter.calcBodyAccelerationFromUDot(built.state, SimTK::Vector(2, 0.0), accelerations);
    const SimTK::SpatialVec A = accelerations[body.getMobilizedBodyIndex()];
    const SimTK::Vec3 w = body.getBodyAngularVelocity(built.state);
    const SimTK::Vec3 arm = body.getBodyRotation(built.state) * station;
    const SimTK::Vec3 acceleration = A[1] + A[0] % arm + w % (w % arm);
    EXPECT_LT((acceleration - second).norm(), 1e-4);
}

TEST(JointConvention, CustomJointWithoutCoordinatesIsAWeld) {
    std::string still = spatialTransform;
    for (const char* name : {"q", "r"}) {
        const std::string driven = "<coordinates>" + std::string(name) + "<";
        for (std::size_t at; (at = still.find(driven)) != std::string::npos;)
            still.replace(at, driven.size(), "<coordinates><");
    }
    BuiltSystem built(readNew(makeModel("CustomJoint", still)));
    EXPECT_EQ(built.state.getNU(), 0);
    // Without a coordinate and without a function the second turn is none.
    expectPose(built, calcCustom(0.0, 0.0));
}

TEST(JointConvention, BuiltInJoints) {
    const double q = 0.4, r = -0.7, s = 1.2;
    const Pose x = turn({1, 0, 0}, q), y = turn({0, 1, 0}, r), z = turn({0, 0, 1}, s);
    struct Case {
        const char* type;
        std::string inside;
        Pose X_FM;
    };
    const Case cases[] = {
        {"WeldJoint", "", Pose()},
        {"PinJoint", makeCoordinates({"q"}), turn({0, 0, 1}, q)},
        {"SliderJoint", makeCoordinates({"q"}), shift({q, 0, 0})},
        {"UniversalJoint", makeCoordinates({"q", "r"}), times(x, y)},
        {"BallJoint", makeCoordinates({"q", "r", "s"}), times(x, times(y, z))},
        {"GimbalJoint", makeCoordinates({"q", "r", "s"}), times(x, times(y, z))},
        {"PlanarJoint", makeCoordinates({"q", "r", "s"}), times(shift({r, s, 0}), turn({0, 0, 1}, q))},
        {"FreeJoint", makeCoordinates({"q", "r", "s", "tx", "ty", "tz"}),
         times(shift({0.5, -0.6, 0.7}), times(x, times(y, z)))}};
    const std::map<std::string, double> values{{"q", q}, {"r", r}, {"s", s}, {"tx", 0.5}, {"ty", -0.6}, {"tz", 0.7}};
    for (const Case& joint : cases) {
        SCOPED_TRACE(joint.type);
        for (const bool reversed : {false, true}) {
            BuiltSystem built(readNew(makeModel(joint.type, joint.inside, reversed ? swappedFrames : frames)));
            for (const std::string& name : built.model.getCoordinateNames()) built.set(name, values.at(name));
            reversed ? expectReversedPose(built, joint.X_FM) : expectPose(built, joint.X_FM);
        }
    }
}

}  // namespace
}  // namespace tautline::models::testing
