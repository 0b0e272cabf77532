// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Small models as text, and a built model with its system, for the tests of tautline_models. */
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tautline/models/model_builder.h"
#include "tautline/models/osim_reader.h"

namespace tautline::models::testing {

/** A model, its multibody system and a state in the default pose. */
struct BuiltSystem {
    explicit BuiltSystem(ModelDescription read)
        : description(std::move(read)),
          matter(system),
          forces(system),
          model(buildMultibody(description, matter)),
          gravity(addGravity(description, forces, model)) {
        matter.setShowDefaultGeometry(false);
        state = system.realizeTopology();
        model.setDefaultPose(state);
    }

    void set(const std::string& coordinate, double value) {
        model.setCoordinate(state, coordinate, value);
        system.realize(state, SimTK::Stage::Position);
    }

    ModelDescription description;
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    BuiltModel model;
    SimTK::Force::Gravity gravity;
    SimTK::State state;
};

inline std::string wrapInDocument(const std::string& content, const std::string& version) {
    return "<OpenSimDocument Version=\"" + version + "\">\n<Model name=\"m\">\n" + "<gravity>0 -9.81 0</gravity>\n" +
           content + "</Model>\n</OpenSimDocument>\n";
}

/** A body of mass 1 in the present layout. */
inline std::string makeBody(const std::string& name, const std::string& inside = "") {
    return "<Body name=\"" + name +
           "\"><mass>1</mass><mass_center>0 0 0</mass_center>"
           "<inertia>1 1 1 0 0 0</inertia>" +
           inside + "</Body>\n";
}

inline std::string makeBodySet(const std::string& bodies) {
    return "<BodySet><objects>" + bodies + "</objects></BodySet>\n";
}

inline std::string makeJointSet(const std::string& joints) {
    return "<JointSet><objects>" + joints + "</objects></JointSet>\n";
}

inline std::string makeOffsetFrame(const std::string& name, const std::string& parent, const std::string& translation,
                                   const std::string& orientation) {
    return "<PhysicalOffsetFrame name=\"" + name + "\"><socket_parent>" + parent + "</socket_parent><translation>" +
           translation + "</translation><orientation>" + orientation + "</orientation></PhysicalOffsetFrame>";
}

/** A joint between two frames that stand in it, `a` on the parent and `b` on the child. */
inline std::string makeJoint(const std::string& type, const std::string& name, const std::string& frames,
                             const std::string& inside) {
    return "<" + type + " name=\"" + name +
           "\"><socket_parent_frame>a</socket_parent_frame>"
           "<socket_child_frame>b</socket_child_frame>\n<frames>" +
           frames + "</frames>\n" + inside + "</" + type + ">\n";
}

inline std::string makeCoordinates(std::initializer_list<const char*> names) {
    std::string coordinates;
    for (const char* name : names) coordinates += "<Coordinate name=\"" + std::string(name) + "\"/>";
    return "<coordinates>" + coordinates + "</coordinates>\n";
}

/** ground - `one` by a pin with coordinate q, and a weld with its frames left at the origins. */
inline std::string makePinModel(const std::string& extraSets = "", const std::string& bodyInside = "") {
    return makeBodySet(makeBody("one", bodyInside)) +
           makeJointSet(makeJoint("PinJoint", "pin",
                                  makeOffsetFrame("a", "/ground", "0 0 0", "0 0 0") +
                                      makeOffsetFrame("b", "/bodyset/one", "0 0 0", "0 0 0"),
                                  makeCoordinates({"q"}))) +
           extraSets;
}

inline ModelDescription readNew(const std::string& content) {
    return readOsimText(wrapInDocument(content, "40000"), "test.osim");
}

}  // namespace tautline::models::testing
