// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Reads scene files (static.json, motion.json): scenes of obstacles with verified answers, whose format is
described beside them. Shared by tests and benchmarks. */
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tautline/error.h"
#include "tautline/paths/path_problem.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

/** amp sin(2 pi freq t + phase) for x, y, z or three angles. */
struct Wave3 {
    Vector3 amplitude = Vector3::Zero(), frequency = Vector3::Zero(), phase = Vector3::Zero();

    Vector3 calcValue(double t) const {
        return amplitude.array() * (2 * kPi * frequency.array() * t + phase.array()).sin();
    }
    Vector3 calcRate(double t) const {
        return 2 * kPi * frequency.array() * amplitude.array() *
               (2 * kPi * frequency.array() * t + phase.array()).cos();
    }
};

struct SceneObstacle {
    std::string kind;
    std::vector<double> params;
    Pose meanPose;
    Vector3 hint_S = Vector3::Zero();
    Wave3 translation, rotation;
};

struct SegmentTruth {
    Vector3 P = Vector3::Zero(), Q = Vector3::Zero();
    double arc = 0;
};

struct EventTruth {
    double time = 0;
    int obstacle = -1;
    std::string kind;
};

struct Scene {
    std::string id, family, difficulty;
    std::vector<std::string> tags;
    Vector3 origin = Vector3::Zero(), insertion = Vector3::Zero();
    Wave3 originWave, insertionWave;
    std::vector<SceneObstacle> obstacles;
    // Answers: one entry for a static scene, one per step for a moving one; empty where none are listed.
    double start = 0, dt = 0;
    int steps = 1;
    std::vector<double> length, rate;
    std::vector<std::vector<bool>> contact;
    std::vector<std::optional<SegmentTruth>> segments;  ///< at the start
    std::vector<EventTruth> events;

    bool isMoving() const { return dt > 0; }
    bool hasAnswer() const { return !length.empty(); }
};

inline Vector3 toVec3(const nlohmann::json& json) {
    return Vector3(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
}

inline Wave3 toWave(const nlohmann::json& json) {
    Wave3 wave;
    for (int i = 0; i < 3; ++i) {
        wave.amplitude[i] = json.at(i).at("amp");
        wave.frequency[i] = json.at(i).at("freq");
        wave.phase[i] = json.at(i).at("phase");
    }
    return wave;
}

inline std::shared_ptr<const Surface> makeSurface(const std::string& kind, const std::vector<double>& p) {
    if (kind == "sphere") return std::make_shared<Sphere>(p.at(0));
    if (kind == "cylinder") return std::make_shared<Cylinder>(p.at(0));
    if (kind == "ellipsoid") return std::make_shared<Ellipsoid>(Vector3(p.at(0), p.at(1), p.at(2)));
    if (kind == "torus") return std::make_shared<Torus>(p.at(0), p.at(1));
    throw InvalidInput("scene file: unknown obstacle kind '" + kind + "'");
}

/** Answers are looked up by step and obstacle: nothing may be missing from a list of them. */
inline void requireWholeAnswer(const Scene& scene) {
    const std::size_t steps = scene.steps, obstacles = scene.obstacles.size();
    bool isWhole = scene.length.size() == steps && scene.contact.size() == steps && scene.segments.size() == obstacles;
    isWhole = isWhole && scene.rate.size() == (scene.isMoving() ? steps : 0);
    for (const std::vector<bool>& flags : scene.contact) isWhole = isWhole && flags.size() == obstacles;
    for (std::size_t i = 0; isWhole && i < obstacles; ++i)
        isWhole = !scene.contact.front()[i] || scene.segments[i].has_value();
    require(isWhole, "scene '", scene.id, "': its truth does not have one entry for each step and obstacle");
}

inline Scene toScene(const nlohmann::json& json) {
    Scene scene;
    scene.id = json.at("id"), scene.family = json.at("family"), scene.difficulty = json.at("difficulty");
    scene.tags = json.at("tags").get<std::vector<std::string>>();
    scene.origin = toVec3(json.at("origin")), scene.insertion = toVec3(json.at("insertion"));
    for (const auto& o : json.at("obstacles")) {
        SceneObstacle obstacle;
        obstacle.kind = o.at("kind"), obstacle.params = o.at("params").get<std::vector<double>>();
        for (int row = 0; row < 3; ++row) obstacle.meanPose.R.row(row) = toVec3(o.at("R").at(row));
        obstacle.meanPose.p = toVec3(o.at("p")), obstacle.hint_S = toVec3(o.at("hint"));
        scene.obstacles.push_back(obstacle);
    }
    const bool hasTruth = json.contains("truth");
    if (json.contains("motion")) {
        const auto& motion = json.at("motion");
        scene.originWave = toWave(motion.at("origin")), scene.insertionWave = toWave(motion.at("insertion"));
        for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
            scene.obstacles[i].translation = toWave(motion.at("obstacles").at(i).at("translation"));
            scene.obstacles[i].rotation = toWave(motion.at("obstacles").at(i).at("rotation"));
        }
        scene.start = json.at("time").at("start"), scene.dt = json.at("time").at("dt");
        scene.steps = json.at("time").at("steps");
        require(scene.dt > 0 && scene.steps > 0, "scene '", scene.id, "': its time has no steps");
    }
    if (!hasTruth) return scene;
    const auto& truth = json.at("truth");
    const auto readSegments = [&scene](const nlohmann::json& segments) {
        for (const auto& s : segments)
            scene.segments.push_back(s.is_null() ? std::nullopt
                                                 : std::optional<SegmentTruth>(SegmentTruth{
                                                       toVec3(s.at("P")), toVec3(s.at("Q")), s.at("arc")}));
    };
    if (scene.isMoving()) {
        scene.length = truth.at("length").get<std::vector<double>>();
        scene.rate = truth.at("rate").get<std::vector<double>>();
        for (const auto& item : truth.at("contact")) {
            const std::string flags = item;
            scene.contact.emplace_back();
            for (char flag : flags) scene.contact.back().push_back(flag == '1');
        }
        for (const auto& e : truth.at("events"))
            scene.events.push_back({e.at("time"), e.at("obstacle"), e.at("kind").get<std::string>()});
        readSegments(truth.at("segments_start"));
    } else {
        scene.length = {truth.at("length").get<double>()};
        scene.contact = {truth.at("contact").get<std::vector<bool>>()};
        readSegments(truth.at("segments"));
    }
    requireWholeAnswer(scene);
    return scene;
}

/** All scenes of a file. Throws InvalidInput naming the file where it is missing or malformed. */
inline std::vector<Scene> readScenes(const std::filesystem::path& file) {
    std::ifstream stream(file);
    require(stream.good(), file.string(), ": cannot be read");
    std::vector<Scene> scenes;
    try {
        const nlohmann::json json = nlohmann::json::parse(stream);
        for (const auto& scene : json.at("scenes")) scenes.push_back(toScene(scene));
    } catch (const std::exception& error) {
        throw InvalidInput(file.string() + ": " + error.what());
    }
    return scenes;
}

/** The scene as a problem of the core: element 0 origin, obstacles 1..n, last the insertion. */
inline PathProblem makeProblem(const Scene& scene, bool withHints) {
    PathProblem problem;
    problem.addPoint("origin");
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
        const SceneObstacle& obstacle = scene.obstacles[i];
        problem.addObstacle(obstacle.kind + std::to_string(i), makeSurface(obstacle.kind, obstacle.params),
                            withHints ? std::optional<Vector3>(obstacle.hint_S) : std::nullopt);
    }
    problem.addPoint("insertion");
    return problem;
}

inline Matrix3 makeBodyFixedXyz(const Vector3& a) {
    return (Eigen::AngleAxisd(a[0], Vector3::UnitX()) * Eigen::AngleAxisd(a[1], Vector3::UnitY()) *
            Eigen::AngleAxisd(a[2], Vector3::UnitZ()))
        .toRotationMatrix();
}

inline void calcPose(const Scene& scene, double t, PathPose& pose) {
    pose.X_GE.clear();
    pose.X_GE.emplace_back(Vector3(scene.origin + scene.originWave.calcValue(t)));
    for (const SceneObstacle& o : scene.obstacles)
        pose.X_GE.emplace_back(o.meanPose.R * makeBodyFixedXyz(o.rotation.calcValue(t)),
                               o.meanPose.p + o.translation.calcValue(t));
    pose.X_GE.emplace_back(Vector3(scene.insertion + scene.insertionWave.calcValue(t)));
}

inline void calcVelocity(const Scene& scene, double t, std::vector<SpatialVelocity>& V_GE) {
    V_GE.clear();
    V_GE.push_back({Vector3::Zero(), scene.originWave.calcRate(t)});
    for (const SceneObstacle& o : scene.obstacles) {
        // Body-fixed X-Y-Z: w = a0' x + a1' Rx y + a2' Rx Ry z, carried by the mean rotation.
        const Vector3 a = o.rotation.calcValue(t), aDot = o.rotation.calcRate(t);
        const Matrix3 Rx = makeBodyFixedXyz(Vector3(a[0], 0, 0)), Rxy = makeBodyFixedXyz(Vector3(a[0], a[1], 0));
        const Vector3 w = aDot[0] * Vector3::UnitX() + aDot[1] * Rx.col(1) + aDot[2] * Rxy.col(2);
        V_GE.push_back({o.meanPose.R * w, o.translation.calcRate(t)});
    }
    V_GE.push_back({Vector3::Zero(), scene.insertionWave.calcRate(t)});
}

}  // namespace tautline::testing
