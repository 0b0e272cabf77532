// SPDX-License-Identifier: Apache-2.0
/** What instances of a model hold, as bench/README.md says. */
#include <memory>

#include "model_test_support.h"
#include "support/used_memory.h"
#include "tautline/models/model_system.h"

namespace tautline::models::testing {
namespace {

using tautline::testing::getUsedMemory;

/** A model that is ready to be simulated, with a State of its own. */
struct Instance {
    explicit Instance(const ModelDescription& description)
        : model(std::make_unique<ModelSystem>(description)), state(model->makeDefaultState()) {}

    std::unique_ptr<ModelSystem> model;
    SimTK::State state;
};

std::vector<Instance> makeInstances(int count) {
    const ModelDescription elbow = readOsimFile(std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "elbow.osim");
    std::vector<Instance> instances;
    for (int i = 0; i < count; ++i) {
        instances.emplace_back(elbow);
        Instance& one = instances.back();
        one.model->getModel().setCoordinate(one.state, "elbow_flexion", 0.2 + 1e-4 * i);
        one.model->getSystem().realize(one.state, SimTK::Stage::Velocity);
    }
    return instances;
}

double getLength(const Instance& instance) {
    return instance.model->getPaths().front().cable.getLength(instance.state);
}

TEST(ModelMemory, OfAnInstanceIsAsSmallAsIsSaid) {
    if (getUsedMemory() == 0) GTEST_SKIP() << "the allocator does not tell what it has given";
    makeInstances(1);  // what is made once
    const double before = getUsedMemory();
    const std::vector<Instance> instances = makeInstances(50);
    const double each = (getUsedMemory() - before) / 50;
    EXPECT_LT(each, 250e3);
    EXPECT_GT(each, 50e3) << "is it measured?";
}

TEST(LongModelMemory, TenThousandInstancesLiveInOneProcess) {
    const std::vector<Instance> instances = makeInstances(10000);
    const std::vector<Instance> few = makeInstances(3);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(getLength(instances[i]), getLength(few[i]));
    EXPECT_NE(getLength(instances[0]), getLength(instances[9999]));
}

}  // namespace
}  // namespace tautline::models::testing
