// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Random numbers that are the same on every machine: the standard library leaves its distributions open. */
#include <cmath>
#include <random>

#include "tautline/types.h"

namespace tautline::testing {

class SeededRandom {
public:
    explicit SeededRandom(unsigned seed) : m_engine(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (m_engine() / static_cast<double>(std::mt19937::max()));
    }
    /** Any order of magnitude between the two is as likely as any other. */
    double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    int pick(int count) { return static_cast<int>(m_engine() % static_cast<unsigned>(count)); }
    bool flip() { return pick(2) == 1; }
    Vector3 vector(double extent) {
        const double x = uniform(-extent, extent), y = uniform(-extent, extent);
        return {x, y, uniform(-extent, extent)};
    }
    Vector3 unitVector() {
        Vector3 v = vector(1);
        while (v.norm() < 0.1 || v.norm() > 1) v = vector(1);
        return v.normalized();
    }
    Pose pose(double extent) {
        const double angle = uniform(-kPi, kPi);
        const Matrix3 R = Eigen::AngleAxisd(angle, unitVector()).toRotationMatrix();
        return {R, vector(extent)};
    }

private:
    std::mt19937 m_engine;
};

}  // namespace tautline::testing
