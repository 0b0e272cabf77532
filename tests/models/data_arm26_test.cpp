// SPDX-License-Identifier: Apache-2.0
/** The same arm in two layouts, read in place from the reference data. */
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "model_test_support.h"
#include "support/shared_data.h"
#include "tautline/models/model_system.h"
#include "tautline/models/path_points.h"
#include "tautline/muscles/thelen_2003.h"

namespace tautline::models::testing {
namespace {

struct ReferenceLength {
    std::string muscle;
    std::vector<std::pair<std::string, double>> pose;
    double length = 0.0;
};

/** Rows of `muscle,coordinate=value;...,length`. */
std::vector<ReferenceLength> readLengths(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::vector<ReferenceLength> lengths;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        std::istringstream fields(line);
        ReferenceLength row;
        std::string pose, length;
        std::getline(fields, row.muscle, ',');
        std::getline(fields, pose, ',');
        std::getline(fields, length);
        row.length = std::stod(length);
        std::istringstream settings(pose);
        for (std::string setting; std::getline(settings, setting, ';');) {
            const auto equals = setting.find('=');
            row.pose.emplace_back(setting.substr(0, equals), std::stod(setting.substr(equals + 1)));
        }
        lengths.push_back(row);
    }
    return lengths;
}

ModelDescription readShared(const std::filesystem::path& shared, const std::string& name) {
    return readOsimFile(shared / "data" / "opensim" / "models" / name);
}

/** The reference was made with poses clipped to the coordinate's range: -1.5708 to -1.57079633. */
void setClipped(BuiltSystem& arm, const std::string& coordinate, double value) {
    const auto& range = arm.model.getCoordinateSlot(coordinate).range;
    arm.set(coordinate, std::clamp(value, range[0], range[1]));
}

TEST(DataArm26, IsReadFromBothLayouts) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription present = readShared(shared, "arm26.osim");
    const ModelDescription old = readShared(shared, "arm26_v20303.osim");
    // The present file puts the thorax in a body `base` where the old one uses the ground.
    EXPECT_EQ(present.bodies.size(), 3u);
    EXPECT_EQ(old.bodies.size(), 2u);
    EXPECT_EQ(present.joints.size(), 3u);
    EXPECT_EQ(old.joints.size(), 2u);
    ASSERT_EQ(present.muscles.size(), 6u);
    ASSERT_EQ(old.muscles.size(), 6u);
    ASSERT_EQ(present.wrapObjects.size(), 4u);
    ASSERT_EQ(old.wrapObjects.size(), 4u);
    EXPECT_EQ(present.muscles[0].type, "Thelen2003Muscle");
}

TEST(DataArm26, MusclesAgreeBetweenTheLayouts) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription present = readShared(shared, "arm26.osim");
    const ModelDescription old = readShared(shared, "arm26_v20303.osim");
    std::size_t points = 0, wraps = 0;
    for (std::size_t i = 0; i < present.muscles.size(); ++i) {
        const Muscle &a = present.muscles[i], &b = old.muscles[i];
        SCOPED_TRACE(a.name);
        EXPECT_EQ(a.name, b.name);
        const auto& p = dynamic_cast<const Thelen2003&>(*a.model).getParameters();
        const auto& q = dynamic_cast<const Thelen2003&>(*b.model).getParameters();
        EXPECT_EQ(p.maxIsometricForce, q.maxIsometricForce);
        EXPECT_EQ(p.optimalFiberLength, q.optimalFiberLength);
        EXPECT_EQ(p.tendonSlackLength, q.tendonSlackLength);
        EXPECT_EQ(p.pennationAtOptimal, q.pennationAtOptimal);
        EXPECT_EQ(p.deactivationTime, 0.04);
        EXPECT_EQ(p.tendonStrain, 0.033);
        EXPECT_EQ(q.tendonStrain, 0.033);
        EXPECT_EQ(p.lengtheningForce, 1.8);
        EXPECT_TRUE(a.appliesForce && b.appliesForce);
        ASSERT_EQ(a.path.points.size(), b.path.points.size());
        ASSERT_EQ(a.path.wraps.size(), b.path.wraps.size());
        points += a.path.points.size();
        wraps += a.path.wraps.size();
        for (std::size_t k = 0; k < a.path.points.size(); ++k) {
            EXPECT_EQ(a.path.points[k].name, b.path.points[k].name);
            EXPECT_EQ(a.path.points[k].location, b.path.points[k].location);
        }
        for (std::size_t k = 0; k < a.path.wraps.size(); ++k) {
            EXPECT_EQ(present.wrapObjects[a.path.wraps[k].wrapObject].name,
                      old.wrapObjects[b.path.wraps[k].wrapObject].name);
            EXPECT_EQ(a.path.wraps[k].range, b.path.wraps[k].range);
        }
    }
    EXPECT_EQ(points, 32u);
    EXPECT_EQ(wraps, 7u);
}

TEST(DataArm26, ReadsWrapObjects) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription arm = readShared(shared, "arm26.osim");
    const WrapObject* cylinder = findWrapObject(arm, "TRI");
    ASSERT_NE(cylinder, nullptr);
    EXPECT_EQ(cylinder->body, "r_humerus");
    EXPECT_EQ(cylinder->quadrant, Quadrant::All);
    EXPECT_EQ(std::get<CylinderShape>(cylinder->shape).radius, 0.016);
    EXPECT_EQ(std::get<CylinderShape>(cylinder->shape).length, 0.05);
    const WrapObject* ellipsoid = findWrapObject(arm, "BIClonghh");
    ASSERT_NE(ellipsoid, nullptr);
    EXPECT_EQ(ellipsoid->quadrant, Quadrant::MinusY);
    EXPECT_EQ(std::get<EllipsoidShape>(ellipsoid->shape).semiAxes, Vector3(0.025, 0.02, 0.02));
    EXPECT_EQ(findMuscle(arm, "BIClong")->path.wraps.at(0).range, (std::array<int, 2>{2, 3}));
}

TEST(DataArm26, PolygonLengthsAgreeBetweenTheLayouts) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    BuiltSystem present(readShared(shared, "arm26.osim"));
    BuiltSystem old(readShared(shared, "arm26_v20303.osim"));
    double worst = 0.0;
    for (double elevation : {-1.5, -0.3, 0.0, 0.9, 3.0}) {
        for (double flexion : {0.0, 0.4, 1.1, 2.2}) {
            for (BuiltSystem* arm : {&present, &old}) {
                arm->set("r_shoulder_elev", elevation);
                arm->set("r_elbow_flex", flexion);
            }
            for (std::size_t i = 0; i < 6; ++i) {
                const double a = calcPolygonLength(present.description.muscles[i].path, present.model, present.state);
                const double b = calcPolygonLength(old.description.muscles[i].path, old.model, old.state);
                worst = std::max(worst, std::abs(a - b));
            }
        }
    }
    RecordProperty("worst_difference_m", std::to_string(worst));
    EXPECT_LT(worst, 1e-14);
}

TEST(DataArm26, BicepsShortHasTheReferenceLength) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto rows = readLengths(shared / "data" / "opensim" / "reference" / "arm26_osim_lengths.csv");
    for (const char* name : {"arm26.osim", "arm26_v20303.osim"}) {
        BuiltSystem arm(readShared(shared, name));
        int compared = 0;
        double worst = 0.0;
        for (const ReferenceLength& row : rows) {
            if (row.muscle != "BICshort") continue;
            arm.model.setDefaultPose(arm.state);
            for (const auto& [coordinate, value] : row.pose) setClipped(arm, coordinate, value);
            const Muscle* muscle = findMuscle(arm.description, row.muscle);
            const double length = calcPolygonLength(muscle->path, arm.model, arm.state);
            worst = std::max(worst, std::abs(length - row.length));
            ++compared;
        }
        std::cout << name << ": " << compared << " lengths, worst " << worst << " m\n";
        EXPECT_EQ(compared, 15);
        EXPECT_LT(worst, 1e-14);
    }
}

/** The long head of the triceps over the cylinder at the shoulder, which is changed as a test says. */
struct Triceps {
    Triceps(const std::filesystem::path& shared, double length, bool isActive)
        : model(describe(shared, length, isActive)), state(model.makeDefaultState()) {}

    static ModelDescription describe(const std::filesystem::path& shared, double length, bool isActive) {
        ModelDescription description = readShared(shared, "arm26.osim");
        for (WrapObject& object : description.wrapObjects) {
            if (object.name != "TRIlongglen") continue;
            object.active = isActive;
            std::get<CylinderShape>(object.shape).length = length;
        }
        return description;
    }

    void setShoulder(double angle) {
        model.getModel().setCoordinate(state, "r_shoulder_elev", angle);
        model.getSystem().realize(state, SimTK::Stage::Position);
    }
    const Cable& getCable() const { return model.getMuscles().at(0).cable; }
    double getLength() const { return getCable().getLength(state); }
    bool touches(const std::string& obstacle) const {
        return getCable().isTouched(state, getCable().findElement(obstacle));
    }
    /** Along the axis of the cylinder, of both ends of the contact. */
    std::pair<double, double> calcContactZ() const {
        const CableElementIndex cylinder = getCable().findElement("TRIlongglen");
        SimTK::Vec3 P_G, Q_G;
        EXPECT_TRUE(getCable().getContactPoints(state, cylinder, P_G, Q_G));
        const Pose& X_GE = getCable().getPathPose(state).X_GE[static_cast<std::size_t>(cylinder)];
        return {X_GE.shiftBack(Vector3(P_G[0], P_G[1], P_G[2])).z(),
                X_GE.shiftBack(Vector3(Q_G[0], Q_G[1], Q_G[2])).z()};
    }

    ModelSystem model;
    SimTK::State state;
};

/** As in OpenSim: the cylinder is passed by where both ends of the contact would lie beyond its ends. */
TEST(DataArm26, TheLongHeadOfTheTricepsPassesTheEndsOfItsCylinderBy) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription description = readShared(shared, "arm26.osim");
    const WrapObject& cylinder = *findWrapObject(description, "TRIlongglen");
    const double halfLength = 0.5 * std::get<CylinderShape>(cylinder.shape).length;
    Triceps finite(shared, 2 * halfLength, true), endless(shared, SimTK::Infinity, true),
        without(shared, 2 * halfLength, false);
    int numBeyond = 0, numWithin = 0;
    double largest = 0;
    for (double angle = -1.57; angle < 3.14; angle += 0.02) {
        SCOPED_TRACE(angle);
        for (Triceps* triceps : {&finite, &endless, &without}) triceps->setShoulder(angle);
        if (!endless.touches("TRIlongglen") || endless.touches("TRIlonghh")) continue;
        const auto [zP, zQ] = endless.calcContactZ();
        const bool isBeyond = std::abs(zP) > halfLength && std::abs(zQ) > halfLength;
        ++(isBeyond ? numBeyond : numWithin);
        EXPECT_NEAR(finite.getLength(), isBeyond ? without.getLength() : endless.getLength(), 1e-10);
        if (isBeyond) largest = std::max(largest, endless.getLength() - without.getLength());
    }
    std::cout << "beyond the ends in " << numBeyond << " poses, within in " << numWithin << ", longer by up to "
              << largest << " m if it had no ends\n";
    EXPECT_GT(numBeyond, 10);
    EXPECT_GT(numWithin, 10);
    EXPECT_GT(largest, 1e-3);
}

}  // namespace
}  // namespace tautline::models::testing
