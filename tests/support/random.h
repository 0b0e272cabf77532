// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Random numbers, directions and poses from a fixed seed, which is printed where a test fails. */
#include <gtest/gtest.h>

#include <random>

#include "tautline/surfaces/surface.h"

namespace tautline::testing {

class Random {
public:
    explicit Random(unsigned seed) : m_engine(seed), m_trace(__FILE__, __LINE__, "seed " + std::to_string(seed)) {}

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(m_engine); }
    int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(m_engine); }
    /** Any order of magnitude between the two is as likely as any other. */
    double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
    Vector3 unitVector() {
        std::normal_distribution<double> normal;
        return Vector3(normal(m_engine), normal(m_engine), normal(m_engine)).normalized();
    }
    Matrix3 rotation() { return Eigen::AngleAxisd(uniform(-kPi, kPi), unitVector()).toRotationMatrix(); }
    Pose pose(double size) { return {rotation(), vector(size)}; }

private:
    std::mt19937 m_engine;
    ::testing::ScopedTrace m_trace;
};

}  // namespace tautline::testing
