// SPDX-License-Identifier: Apache-2.0
/** Random strings over solids fitted to real bones: what is called solved is clear of the bone all along and as long as
a string over the raw mesh, and what is not solved says why. */
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "support/random.h"
#include "support/shared_data.h"
#include "support/taut_polyline.h"
#include "tautline/meshes/mesh_distance.h"
#include "tautline/models/mesh_file.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"
#include "tautline/surfaces/function_surface.h"
#include "tautline/surfaces/solid_fit.h"

namespace tautline::testing {
namespace {

constexpr unsigned kSeed = 20261127;
constexpr const char* kBones[] = {"arm_r_humerus", "humerus_rv", "r_pelvis", "sacrum", "ground_r_clavicle"};

/** The faceted mesh itself: heights are distances, feet the nearest points. */
ImplicitFunctionSurface makeRawSurface(const RepairedMesh& repaired, double size) {
    const auto distance = std::make_shared<MeshDistance>(repaired.mesh);
    const auto calcGradient = [distance](const Vector3& p) -> Vector3 {
        const MeshDistance::Nearest nearest = distance->findNearest(p);
        const double side = distance->isInside(p) ? -1 : 1;
        if (nearest.distance > 0) return side / nearest.distance * (p - nearest.point);
        return calcDoubleArea(distance->getMesh(), nearest.triangle).normalized();
    };
    return {"raw mesh", size, [distance](const Vector3& p) { return distance->calcSignedDistance(p); }, calcGradient};
}

/** One bone, strings over it, and what came of them. */
class BoneStrings {
public:
    BoneStrings(const std::filesystem::path& file, const std::string& name)
        : m_name(name),
          m_fit(fitSolid(models::readMeshFile(file / (name + ".vtp")))),
          m_solid(std::make_shared<BSplineSolid>(m_fit.solid)) {
        m_problem.addPoint("origin");
        m_problem.addObstacle(name, m_solid);
        m_problem.addPoint("insertion");
    }

    /** @param compares   every third string that touches with one over the mesh itself, which takes longer */
    void solveRandom(Random& random, bool compares) {
        const Eigen::AlignedBox3d box = calcBox(m_fit.repaired.mesh);
        std::array<Vector3, 2> ends;
        for (Vector3& end : ends) do {
                end = box.center() + (0.5 * box.sizes() + Vector3::Constant(0.03)).cwiseProduct(random.vector(1));
            } while (m_solid->calcHeight(end) < 0.003);
        PathPose pose;
        pose.X_GE = {Pose(ends[0]), Pose(), Pose(ends[1])};
        const PathSolution path = solvePath(m_problem, pose);
        ++m_count;
        if (path.status == PathStatus::Solved) {
            ++m_solved;
            const std::vector<Vector3> course = sample(path, ends);
            for (const Vector3& p : course)
                EXPECT_GT(m_solid->calcHeight(p), -1e-9) << m_name << ", string " << m_count;
            EXPECT_TRUE(verifyPath(m_problem, pose, path).isMinimum()) << m_name << ", string " << m_count;
            m_several += path.contacts[1].getNumArcs() > 1;
            if (path.contacts[1].isTouched && ++m_touched % 3 == 0 && compares) compareWithRawMesh(path, course);
        } else {
            const std::string why = explainStatus(m_problem, pose, path);
            EXPECT_NE(why, "") << m_name << ", string " << m_count;
            ++m_reasons[why.substr(0, why.find(" at "))];
        }
    }

    void report() const {
        std::printf(
            "%-18s %d of %d strings solved, %d touch, %d in several arcs, %d compared with the raw mesh (differ by "
            "%.2f mm "
            "at most, fit: %.2f mm rms)\n",
            m_name.c_str(), m_solved, m_count, m_touched, m_several, m_compared, 1e3 * m_farthest,
            1e3 * m_fit.report.rms);
        for (const auto& [why, count] : m_reasons) std::printf("    %d: %s\n", count, why.c_str());
    }

    double getSolvedShare() const { return double(m_solved) / m_count; }
    int countCompared() const { return m_compared; }

private:
    /** Points from end to end: along straight segments closer than a fiftieth of the bone's size, and 200 of each arc.
     */
    std::vector<Vector3> sample(const PathSolution& path, const std::array<Vector3, 2>& ends) const {
        std::vector<Vector3> points{ends[0]}, arc;
        const auto goStraightTo = [&](const Vector3& to) {
            const Vector3 from = points.back(), side = to - from;
            const int pieces = 1 + static_cast<int>(50 * side.norm() / m_solid->getSize());
            for (int k = 1; k <= pieces; ++k) points.push_back(from + side * k / pieces);
        };
        for (int i = 0; i < path.contacts[1].getNumArcs(); ++i) {
            sampleGeodesic(*m_solid, path.contacts[1].getArc(i).start, {}, 200, arc);
            goStraightTo(arc.front());
            points.insert(points.end(), arc.begin(), arc.end());
        }
        goStraightTo(ends[1]);
        return points;
    }

    /** A polyline that falls taut over the mesh itself from the course of the path. */
    void compareWithRawMesh(const PathSolution& path, const std::vector<Vector3>& course) {
        const ImplicitFunctionSurface raw = makeRawSurface(m_fit.repaired, m_solid->getSize());
        TautPolyline polyline({{&raw, Pose()}}, course, 60);
        if (!polyline.relax(1e-5, 2000)) return;
        const double apart = std::abs(polyline.calcLength() - path.length);
        EXPECT_LT(apart, 2 * m_fit.report.rms) << m_name << ", string " << m_count;
        m_farthest = std::max(m_farthest, apart);
        ++m_compared;
    }

    std::string m_name;
    SolidFit m_fit;
    std::shared_ptr<const BSplineSolid> m_solid;
    PathProblem m_problem;
    int m_count = 0, m_solved = 0, m_touched = 0, m_several = 0, m_compared = 0;
    double m_farthest = 0;
    std::map<std::string, int> m_reasons;
};

TEST(DataBoneStrings, AreClearOfTheBoneAndAsLongAsOverItsMesh) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    for (const char* name : kBones) {
        BoneStrings bone(shared / "data/opensim/geometry", name);
        Random random(kSeed);
        for (int i = 0; i < 100; ++i) bone.solveRandom(random, true);
        bone.report();
        EXPECT_GE(bone.getSolvedShare(), 0.999) << name;
        EXPECT_GT(bone.countCompared(), 1) << name;
    }
}

TEST(LongDataBoneStrings, TenThousandOverEachBone) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    for (const char* name : kBones) {
        BoneStrings bone(shared / "data/opensim/geometry", name);
        Random random(kSeed + 1);
        for (int i = 0; i < 10000; ++i) bone.solveRandom(random, false);
        bone.report();
        EXPECT_GE(bone.getSolvedShare(), 0.999) << name;
    }
}

}  // namespace
}  // namespace tautline::testing
