// SPDX-License-Identifier: Apache-2.0
/** MuJoCo's spatial tendon over the weave with points between: its closed form takes one object between two points. */
#include <mujoco/mujoco.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "weave.h"

namespace tautline::compare {
namespace {

std::string writeXml(const WeaveRow& row) {
    std::ostringstream bodies, tendon;
    const auto addSite = [&](const std::string& name, const Vector3& p) {
        bodies << "<site name='" << name << "' pos='" << p.x() << " " << p.y() << " " << p.z() << "'/>\n";
    };
    const char* type = row.kind == Kind::Cylinders ? "cylinder' size='0.4 1" : "sphere' size='0.4";
    for (int e = 0; e < row.problem.getNumElements(); ++e) {
        const std::string number = std::to_string(e);
        if (const int i = row.getObstacle(e); i < 0) {
            addSite("point" + number, row.poses.front().X_GE[static_cast<std::size_t>(e)].p);
            tendon << "<site site='point" << number << "'/>\n";
        } else {
            bodies << "<body><freejoint/><geom name='geom" << number << "' type='" << type << "'/>\n";
            addSite("side" + number, Vector3(0, i % 2 == 0 ? 0.6 : -0.6, 0));
            bodies << "</body>\n";
            tendon << "<geom geom='geom" << number << "' sidesite='side" << number << "'/>\n";
        }
    }
    return "<mujoco><size njmax='1' nconmax='1'/><worldbody>\n" + bodies.str() + "</worldbody><tendon><spatial>\n" +
           tendon.str() + "</spatial></tendon></mujoco>\n";
}

struct MujocoWeave {
    explicit MujocoWeave(const WeaveRow& row) {
        const std::filesystem::path file =
            std::filesystem::temp_directory_path() / ("tautline_weave_" + std::to_string(row.count) + ".xml");
        std::ofstream(file) << writeXml(row);
        char error[1000] = "";
        model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
        std::filesystem::remove(file);
        if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
        data = mj_makeData(model);
        for (const PathPose& pose : row.poses) addPose(row, pose);
    }
    MujocoWeave(const MujocoWeave&) = delete;
    MujocoWeave& operator=(const MujocoWeave&) = delete;
    ~MujocoWeave() {
        mj_deleteData(data);
        mj_deleteModel(model);
    }

    void addPose(const WeaveRow& row, const PathPose& pose) {
        q.emplace_back();
        for (int e = 0; e < row.problem.getNumElements(); ++e) {
            if (row.getObstacle(e) < 0) continue;
            const Pose& X = pose.X_GE[static_cast<std::size_t>(e)];
            const Eigen::Quaterniond turn(X.R);
            q.back().insert(q.back().end(), {X.p.x(), X.p.y(), X.p.z(), turn.w(), turn.x(), turn.y(), turn.z()});
        }
    }

    /** What a tendon needs of the bodies: their poses, and their motions for its Jacobian. */
    void move(int k) {
        mju_copy(data->qpos, q[static_cast<std::size_t>(k)].data(), model->nq);
        mj_kinematics(model, data);
        mj_comPos(model, data);
    }

    double step(int k) {
        move(k);
        mj_tendon(model, data);
        return data->ten_length[0];
    }

    mjModel* model = nullptr;
    mjData* data = nullptr;
    std::vector<std::vector<double>> q;  ///< by pose
};

}  // namespace

Contestant makeMujoco(const WeaveRow& row) {
    const auto weave = std::make_shared<MujocoWeave>(row);
    return {"MuJoCo's tendon and its Jacobian", [weave](int k) { return weave->step(k); },
            [weave](int k) { weave->move(k); }, kCoreWithForces};
}

}  // namespace tautline::compare
