// SPDX-License-Identifier: Apache-2.0
/** The simulations of thesis Sec. 8.2 to 8.4 as the program runs them. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "simulation.h"
#include "tautline/models/osim_reader.h"

namespace tautline {
namespace {

using models::ModelSystem;

struct SimulatedModel {
    SimulatedModel(const std::string& name, const SimulationOptions& options)
        : model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/" + name + ".osim")),
          result(simulate(model, {}, options, [](double) {})) {}

    /** A column of one of the tables. */
    static std::vector<double> get(const StorageTable& table, const std::string& label) {
        const auto at = std::find(table.labels.begin(), table.labels.end(), label);
        EXPECT_NE(at, table.labels.end()) << label;
        std::vector<double> column;
        for (const auto& row : table.rows) column.push_back(row[static_cast<std::size_t>(at - table.labels.begin())]);
        return column;
    }
    std::vector<double> getOfString(const std::string& quantity) const {
        return get(result.paths, "/forceset/string|" + quantity);
    }

    ModelSystem model;
    SimulationResult result;
};

SimulationOptions makeOptions(double duration, double interval, double accuracy) {
    SimulationOptions options;
    options.duration = duration, options.interval = interval, options.accuracy = accuracy;
    return options;
}

/** Sets the state to a time of the driven paraboloid, with contacts found anew. */
const Cable& posePath(ModelSystem& model, SimTK::State& state, double time) {
    state.setTime(time);
    model.getModel().setDefaultPose(state);
    model.getSystem().realize(state, SimTK::Stage::Velocity);
    return model.getSprings().at(0).cable;
}

// --- 8.2 -----------------------------------------------------------------------------------------------------------

const SimTK::Vec3 kOrigin(-10, 2.5, 0), kInsertion(10, -1.5, 1);

double calcVertexHeight(double time) {
    return -0.5 - 3 * std::cos(2 * SimTK::Pi * time / 5);
}

/** Where the paraboloid just touches the line A B: the least height over x and y, which is quadratic in the vertex's
height only through s, so that the tangent condition is found in closed form. With the line A + s (B - A) and
z + x^2/14 + y^2/6 along it a parabola in s, the vertex stands at its least value. */
double calcTouchingHeight() {
    const SimTK::Vec3 A = kOrigin, D = kInsertion - kOrigin;
    const double a = D[0] * D[0] / 14 + D[1] * D[1] / 6;
    const double b = D[2] + 2 * (A[0] * D[0] / 14 + A[1] * D[1] / 6);
    const double c = A[2] + A[0] * A[0] / 14 + A[1] * A[1] / 6;
    return c - b * b / (4 * a);
}

TEST(ThesisParaboloid, TouchesAndLiftsOffWhereTheLineIsTangent) {
    const SimulatedModel run("paraboloid", makeOptions(5, 0.01, 1e-3));
    const double touchdown = 5 / (2 * SimTK::Pi) * std::acos(-(calcTouchingHeight() + 0.5) / 3);
    double times[2] = {};
    ASSERT_EQ(std::sscanf(run.result.events.c_str(),
                          "time,path,obstacle,kind,length_change\n%lf,/forceset/string,paraboloid,touchdown,%*f\n"
                          "%lf,/forceset/string,paraboloid,liftoff,%*f\n",
                          &times[0], &times[1]),
              2)
        << run.result.events;
    EXPECT_NEAR(times[0], touchdown, 1e-9);
    EXPECT_NEAR(times[1], 5 - touchdown, 1e-9);
    EXPECT_EQ(run.result.summaries.at(0).statistics.numDegradedSteps, 0);
}

TEST(ThesisParaboloid, LengthAndRateAreContinuousOverTheEvents) {
    ModelSystem model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/paraboloid.osim"));
    SimTK::State state = model.makeDefaultState();
    const double touchdown = 5 / (2 * SimTK::Pi) * std::acos(-(calcTouchingHeight() + 0.5) / 3);
    for (double event : {touchdown, 5 - touchdown}) {
        const double dt = 1e-8;
        const Cable& before = posePath(model, state, event - dt);
        const bool wasTouched = before.isTouched(state, CableElementIndex(1));
        const double length = before.getLength(state), rate = before.getLengthRate(state);
        const Cable& after = posePath(model, state, event + dt);
        EXPECT_NE(after.isTouched(state, CableElementIndex(1)), wasTouched);
        EXPECT_NEAR(after.getLength(state), length, 1e-13 * length);
        // The rate has a kink at contact: its slope there, 2.6 m/s^2, times 2 dt.
        EXPECT_NEAR(after.getLengthRate(state), rate, 6e-8);
    }
}

TEST(ThesisParaboloid, RateIsTheSlopeOfTheLength) {
    ModelSystem model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/paraboloid.osim"));
    SimTK::State state = model.makeDefaultState();
    const double h = 1e-4;  // truncation h^2, rounding 1e-14/h
    for (double time : {0.3, 1.6, 1.9, 2.3, 2.5, 3.1, 3.4, 4.5}) {
        const double rate = posePath(model, state, time).getLengthRate(state);
        const double after = posePath(model, state, time + h).getLength(state);
        const double before = posePath(model, state, time - h).getLength(state);
        EXPECT_NEAR((after - before) / (2 * h), rate, 2e-7) << time;
    }
}

TEST(ThesisParaboloid, SignedDistanceAndItsPlaceGoSmoothlyThroughTouchdown) {
    const double h = 0.002;
    const SimulatedModel run("paraboloid", makeOptions(5, h, 1e-3));
    const std::vector<double> contact = run.getOfString("contact.paraboloid");
    for (const char* quantity : {"|distance.", "|line_coordinate.", "|u.", "|v."}) {
        SCOPED_TRACE(quantity);
        const std::vector<double> value =
            SimulatedModel::get(run.result.clearances, "/forceset/string" + std::string(quantity) + "paraboloid");
        double largest = 0;
        for (std::size_t k = 3; k < value.size(); ++k) {
            const double third = value[k] - 3 * value[k - 1] + 3 * value[k - 2] - value[k - 3];
            largest = std::max(largest, std::abs(third) / (h * h * h));
        }
        std::cout << quantity << " third derivative at most " << largest << "\n";
        // A jump j of the value would show as j/h^3, one of the slope as j/h^2: none above 1e-4.
        EXPECT_LT(largest, 25);
    }
    const std::vector<double> distance =
        SimulatedModel::get(run.result.clearances, "/forceset/string|distance.paraboloid");
    for (std::size_t k = 0; k < distance.size(); ++k) EXPECT_EQ(distance[k] < 0, contact[k] == 1);
}

/** The shortest polyline from A to B with a node in each of n planes square to x and all nodes on or above the
paraboloid: successive over-relaxation, each node towards where its two edges are shortest. */
class ShortestPolyline {
public:
    explicit ShortestPolyline(int n) : m_n(n), m_h((kInsertion[0] - kOrigin[0]) / n), m_y(n + 1), m_z(n + 1) {
        for (int i = 0; i <= n; ++i) {
            m_y[i] = kOrigin[1] + i * (kInsertion[1] - kOrigin[1]) / n;
            m_z[i] = kOrigin[2] + i * (kInsertion[2] - kOrigin[2]) / n;
        }
    }

    /** Raises the vertex; nodes begin where they were. */
    void relax(double vertexHeight, double tolerance) {
        m_vertexHeight = vertexHeight;
        for (int sweep = 0; sweep < 100 * m_n; ++sweep) {
            double moved = 0;
            for (int i = 1; i < m_n; ++i) {
                const double oldY = m_y[i], oldZ = m_z[i];
                moveNode(i);
                moved = std::max(moved, std::abs(m_y[i] - oldY) + std::abs(m_z[i] - oldZ));
            }
            if (moved < tolerance) return;
        }
        FAIL() << "the polyline does not come to rest";
    }

    double calcLength() const {
        double length = 0;
        for (int i = 0; i < m_n; ++i) length += calcEdge(i);
        return length;
    }

private:
    double calcEdge(int i) const { return SimTK::Vec3(m_h, m_y[i + 1] - m_y[i], m_z[i + 1] - m_z[i]).norm(); }
    double calcSurface(int i, double y) const {
        const double x = kOrigin[0] + i * m_h;
        return m_vertexHeight - x * x / 14 - y * y / 6;
    }

    void moveNode(int i) {
        const double relaxation = 2 / (1 + SimTK::Pi / m_n), oldY = m_y[i], oldZ = m_z[i];
        const double freeY = oldY + relaxation * ((m_y[i - 1] + m_y[i + 1]) / 2 - oldY);
        const double freeZ = oldZ + relaxation * ((m_z[i - 1] + m_z[i + 1]) / 2 - oldZ);
        if (freeZ > calcSurface(i, freeY)) {
            m_y[i] = freeY, m_z[i] = freeZ;
            return;
        }
        // On the surface z(y): a Newton step on the derivative of both edges by y.
        m_z[i] = calcSurface(i, oldY);
        const double a = calcEdge(i - 1), b = calcEdge(i), slope = -oldY / 3;
        const double ya = oldY - m_y[i - 1], yb = oldY - m_y[i + 1], za = m_z[i] - m_z[i - 1], zb = m_z[i] - m_z[i + 1];
        const double first = (ya + slope * za) / a + (yb + slope * zb) / b;
        const double second = (1 + slope * slope - za / 3) / a + (1 + slope * slope - zb / 3) / b -
                              std::pow(ya + slope * za, 2) / (a * a * a) - std::pow(yb + slope * zb, 2) / (b * b * b);
        m_y[i] = oldY - relaxation * first / second;
        m_z[i] = calcSurface(i, m_y[i]);
    }

    int m_n;
    double m_h, m_vertexHeight = 0;
    std::vector<double> m_y, m_z;
};

double findPolylineLength(double vertexHeight, int n) {
    ShortestPolyline polyline(n);
    const double lowest = calcTouchingHeight();
    for (int step = 1; step <= 20; ++step) polyline.relax(lowest + step * (vertexHeight - lowest) / 20, 1e-4);
    polyline.relax(vertexHeight, 1e-12);
    return polyline.calcLength();
}

TEST(ThesisParaboloid, LengthIsThatOfTheShortestPolyline) {
    ModelSystem model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/paraboloid.osim"));
    SimTK::State state = model.makeDefaultState();
    EXPECT_NEAR(posePath(model, state, 1).getLength(state), (kInsertion - kOrigin).norm(), 1e-14 * 20);
    for (double time : {1.7, 2.0, 2.5}) {
        const double length = posePath(model, state, time).getLength(state);
        // Edges are chords below the surface by h^2/24 of their curvature squared: the error falls with h^2.
        const double coarse = findPolylineLength(calcVertexHeight(time), 100);
        const double fine = findPolylineLength(calcVertexHeight(time), 200);
        const double extrapolated = fine + (fine - coarse) / 3;
        std::cout << time << " s: " << length << " m, polyline off by " << fine - length << ", extrapolated "
                  << extrapolated - length << "\n";
        EXPECT_NEAR(extrapolated, length, 1e-6);
    }
}

// --- 8.3 -----------------------------------------------------------------------------------------------------------

void checkThatFormsAgree(double duration) {
    const SimulationOptions options = makeOptions(duration, 0.05, 1e-10);
    const SimulatedModel implicit("four_surfaces_implicit", options), parametric("four_surfaces_parametric", options);
    EXPECT_EQ(implicit.result.summaries.at(0).statistics.numDegradedSteps, 0);
    EXPECT_EQ(parametric.result.summaries.at(0).statistics.numDegradedSteps, 0);
    EXPECT_LT(implicit.result.summaries.at(0).statistics.largestPathError, 1e-6);
    EXPECT_LT(parametric.result.summaries.at(0).statistics.largestPathError, 1e-6);
    for (const char* quantity : {"length", "rate"}) {
        const std::vector<double> a = implicit.getOfString(quantity), b = parametric.getOfString(quantity);
        ASSERT_EQ(a.size(), b.size());
        double largest = 0;
        for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
        std::cout << quantity << ": largest difference over " << duration << " s " << largest << "\n";
        EXPECT_LT(largest, 1e-8) << quantity;
    }
    std::cout << "largest path errors " << implicit.result.summaries[0].statistics.largestPathError << " and "
              << parametric.result.summaries[0].statistics.largestPathError << "\n";
    EXPECT_EQ(implicit.result.summaries[0].contactsLost, parametric.result.summaries[0].contactsLost);
    EXPECT_EQ(implicit.result.summaries[0].contactsMade, parametric.result.summaries[0].contactsMade);
}

TEST(ThesisFourSurfaces, BothFormsGiveTheSameMotion) {
    checkThatFormsAgree(1.5);
}

TEST(LongThesisFourSurfaces, BothFormsGiveTheSameMotionOverTenSeconds) {
    checkThatFormsAgree(10);
}

TEST(ThesisFourSurfaces, TheEllipsoidLiftsOffAndTouchesDownThreeTimes) {
    const SimulatedModel run("four_surfaces_implicit", makeOptions(10, 0.5, 1e-3));
    const PathSummary& summary = run.result.summaries.at(0);
    EXPECT_EQ(summary.contactsLost, 3) << run.result.events;
    EXPECT_EQ(summary.contactsMade, 3) << run.result.events;
    EXPECT_EQ(summary.statistics.numDegradedSteps, 0) << summary.firstDegradation;
    EXPECT_LT(summary.statistics.largestPathError, 1e-6);
    for (const char* other : {"over_cylinder", "through_torus", "through_elliptic_torus"}) {
        EXPECT_EQ(run.result.events.find(other), std::string::npos);
        for (double contact : run.getOfString("contact." + std::string(other))) EXPECT_EQ(contact, 1);
    }
}

TEST(ThesisFourSurfaces, MassMovesAsTheStringAndGravityPull) {
    const double h = 0.005;
    const SimulatedModel run("four_surfaces_implicit", makeOptions(1.2, h, 1e-9));
    const std::vector<double> length = run.getOfString("length"), rate = run.getOfString("rate");
    const std::vector<double> tension = run.getOfString("tension");
    const std::vector<double> x = SimulatedModel::get(run.result.states, "/jointset/free_point/point_tx/value");
    const std::vector<double> y = SimulatedModel::get(run.result.states, "/jointset/free_point/point_ty/value");
    const std::vector<double> z = SimulatedModel::get(run.result.states, "/jointset/free_point/point_tz/value");
    for (std::size_t k = 1; k + 1 < x.size(); ++k) {
        EXPECT_NEAR(tension[k], 40 * (length[k] - 7.2) * (1 + 0.2 * rate[k]), 1e-12);
        const auto calcAcceleration = [&](const std::vector<double>& p) {
            return (p[k + 1] - 2 * p[k] + p[k - 1]) / (h * h);
        };
        // 1 kg: what is not gravity is the tension. The difference's error is h^2/12 of the fourth derivative.
        const SimTK::Vec3 pull(calcAcceleration(x), calcAcceleration(y), calcAcceleration(z) + 9.81);
        EXPECT_NEAR(pull.norm(), tension[k], 3e-3) << "row " << k;
    }
}

TEST(ThesisFourSurfaces, RateIsTheSlopeOfTheLength) {
    const double h = 0.005;
    const SimulatedModel run("four_surfaces_parametric", makeOptions(1.2, h, 1e-9));
    const std::vector<double> length = run.getOfString("length"), rate = run.getOfString("rate");
    const std::vector<double> contact = run.getOfString("contact.over_ellipsoid");
    for (std::size_t k = 2; k + 2 < length.size(); ++k) {
        if (contact[k - 2] != contact[k + 2]) continue;  // the length's third derivative jumps there
        const double slope = (8 * (length[k + 1] - length[k - 1]) - (length[k + 2] - length[k - 2])) / (12 * h);
        EXPECT_NEAR(slope, rate[k], 1e-5) << "row " << k;
    }
}

TEST(ThesisFourSurfaces, LengthAndRateAreContinuousOverTheEvents) {
    ModelSystem model(models::readOsimFile(TAUTLINE_SOURCE_DIR "/models/four_surfaces_implicit.osim"));
    const Cable& cable = model.getSprings().at(0).cable;
    int events = 0;
    Cable(cable).setContactListener([&events](const ContactEvent& event) {
        ++events;
        EXPECT_NEAR(event.lengthAfter, event.lengthBefore, 1e-9 * event.lengthBefore);
    });
    SimTK::RungeKuttaMersonIntegrator integrator(model.getSystem());
    integrator.setAccuracy(1e-6);
    integrator.setReturnEveryInternalStep(true);
    SimTK::TimeStepper stepper(model.getSystem(), integrator);
    stepper.setReportAllSignificantStates(true);
    stepper.initialize(model.makeDefaultState());
    while (stepper.getTime() < 3.1) {
        const int before = events;
        model.getSystem().realize(stepper.getState(), SimTK::Stage::Position);
        const PathSolution path = cable.getSolution(stepper.getState());
        stepper.stepTo(3.1);
        if (events == before) continue;
        // The same pose with the contacts of before and of after the event.
        SimTK::State after = stepper.getState(), old = stepper.getState();
        cable.continueFrom(old, path);
        model.getSystem().realize(after, SimTK::Stage::Velocity);
        model.getSystem().realize(old, SimTK::Stage::Velocity);
        EXPECT_EQ(cable.getStatus(old), PathStatus::Solved);
        EXPECT_NEAR(cable.getLength(after), cable.getLength(old), 1e-9 * cable.getLength(old));
        // The fastest end is the mass, at up to 1 m/s.
        EXPECT_NEAR(cable.getLengthRate(after), cable.getLengthRate(old), 1e-7) << stepper.getTime();
        std::cout << stepper.getTime() << " s: length changes by " << cable.getLength(after) - cable.getLength(old)
                  << " m, rate by " << cable.getLengthRate(after) - cable.getLengthRate(old) << " m/s\n";
    }
    EXPECT_EQ(events, 2);
}

TEST(ThesisFourSurfaces, StartIsWrittenObstacleByObstacle) {
    const SimulatedModel run("four_surfaces_implicit", makeOptions(0.01, 0.01, 1e-3));
    EXPECT_EQ(run.result.starts.substr(0, 30), "path,iteration,obstacle,error\n");
    EXPECT_EQ(std::count(run.result.starts.begin(), run.result.starts.end(), '\n'), 1 + 6 * 5);
    EXPECT_NE(run.result.starts.find("/forceset/string,5,over_cylinder,"), std::string::npos);
    EXPECT_EQ(run.result.starts.find("/forceset/string,6"), std::string::npos);
}

// --- 8.4 -----------------------------------------------------------------------------------------------------------

/** Means over the ten paths of the muscle (Fig. 8.8), for each time. */
std::vector<double> calcMean(const SimulatedModel& run, const std::string& quantity) {
    constexpr int kPaths = 10;
    std::vector<double> mean;
    for (int i = 1; i <= kPaths; ++i) {
        const std::string label = "/forceset/latissimus_" + std::to_string(i) + "|" + quantity;
        const std::vector<double> values = SimulatedModel::get(run.result.paths, label);
        mean.resize(values.size());
        for (std::size_t k = 0; k < values.size(); ++k) mean[k] += values[k];
    }
    for (double& value : mean) value /= kPaths;
    return mean;
}

TEST(ThesisLatissimus, LengthAndRateGoSmoothlyOverTheRibs) {
    const double h = 0.02;
    const SimulatedModel run("latissimus", makeOptions(5, h, 1e-3));
    const std::vector<double> length = calcMean(run, "length"), rate = calcMean(run, "rate");
    for (const double share : calcMean(run, "contact.ribs")) EXPECT_EQ(share, 1);  // all paths, all the time
    ASSERT_EQ(length.size(), 251u);
    EXPECT_GT(length.back() - length.front(), 0.04);
    double largest = 0;
    for (std::size_t k = 3; k + 3 < length.size(); ++k) {
        // Of sixth order: what is left is rounding over h.
        const double slope = (45 * (length[k + 1] - length[k - 1]) - 9 * (length[k + 2] - length[k - 2]) +
                              (length[k + 3] - length[k - 3])) /
                             (60 * h);
        EXPECT_NEAR(slope, rate[k], 1e-8) << k * h;
        largest = std::max(largest, std::abs(rate[k + 1] - 2 * rate[k] + rate[k - 1]) / (h * h));
    }
    std::cout << "mean length from " << length.front() << " to " << length.back() << " m, rate bends by at most "
              << largest << " m/s^3\n";
    // A jump j of the rate would show as j/h^2: none above 1e-5.
    EXPECT_LT(largest, 0.02);
    for (const double error : calcMean(run, "path_error")) EXPECT_LT(error, 1e-10);
}

}  // namespace
}  // namespace tautline
