// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "bindings.h"
#include "excitations.h"
#include "parallel_work.h"
#include "simulation.h"
#include "tautline/models/osim_reader.h"
#include "tautline/models/parallel_study.h"

namespace tautline::python {
namespace {

using models::ModelDescription;

/** A model that was read, shared by all that is made of it. */
struct Model {
    std::shared_ptr<const ModelDescription> description;

    std::vector<std::string> getCoordinates() const {
        std::vector<std::string> names;
        for (const models::Joint& joint : description->joints)
            for (const models::Coordinate& coordinate : joint.coordinates) names.push_back(coordinate.name);
        return names;
    }
    std::vector<std::string> getMuscles() const {
        std::vector<std::string> names;
        for (const models::Muscle& muscle : description->muscles) names.push_back(muscle.name);
        return names;
    }
    std::vector<std::string> getNotes() const {
        std::vector<std::string> notes;
        const auto add = [&](int line, const std::string& text) {
            notes.push_back(description->fileName + ":" + std::to_string(line) + ": " + text);
        };
        for (const models::SkippedElements& skipped : description->skipped)
            add(skipped.firstLine, skipped.element + " in " + skipped.owner + " is passed over: " + skipped.reason);
        for (const models::ReadingNote& note : description->notes) add(note.line, note.text);
        return notes;
    }
};

Model readModel(const std::string& file, const std::vector<std::string>& ignored, bool lengthsOnly,
                const std::vector<std::string>& settings) {
    const py::gil_scoped_release released;
    return {std::make_shared<const ModelDescription>(models::readOsimFile(file, {ignored, lengthsOnly, settings}))};
}

/** What StudyResults and Study have in common. */
struct Layout {
    std::vector<models::StudiedPath> paths;
    std::vector<std::string> coordinates;

    std::vector<std::string> getPathNames() const {
        std::vector<std::string> names;
        for (const models::StudiedPath& path : paths) names.push_back(path.name);
        return names;
    }
    std::vector<std::string> getObstacleNames() const {
        std::vector<std::string> names;
        for (const models::StudiedPath& path : paths)
            for (const std::string& obstacle : path.obstacles) names.push_back(path.name + "/" + obstacle);
        return names;
    }
};

/** The answers for n poses. */
class StudyResults {
public:
    StudyResults(std::shared_ptr<const Layout> layout, std::vector<models::PoseAnswer> answers)
        : m_layout(std::move(layout)), m_answers(std::move(answers)) {}

    const models::PoseAnswer& get(int i) const { return m_answers[static_cast<std::size_t>(i)]; }
    int size() const { return static_cast<int>(m_answers.size()); }
    const Layout& getLayout() const { return *m_layout; }

    template <class Get>
    Numbers listPaths(Get get_) const {
        const auto numPaths = m_layout->paths.size();
        Numbers numbers({static_cast<std::size_t>(size()), numPaths});
        for (int i = 0; i < size(); ++i)
            for (std::size_t p = 0; p < numPaths; ++p) *numbers.mutable_data(i, p) = get_(get(i).paths[p]);
        return numbers;
    }

    /** One entry per path and obstacle, in the order of Layout::getObstacleNames(). */
    template <class Get>
    Numbers listObstacles(Get get_) const {
        std::size_t count = 0;
        for (const models::StudiedPath& path : m_layout->paths) count += path.obstacles.size();
        Numbers numbers({static_cast<std::size_t>(size()), count});
        for (int i = 0; i < size(); ++i) {
            std::size_t o = 0;
            for (const models::PathAnswer& path : get(i).paths)
                for (const models::ObstacleAnswer& obstacle : path.obstacles)
                    *numbers.mutable_data(i, o++) = get_(obstacle);
        }
        return numbers;
    }

    /** Zero about coordinates that a path does not cross. */
    Numbers listArms(std::vector<double> models::PathAnswer::*arms) const {
        const auto numPaths = m_layout->paths.size(), numCoordinates = m_layout->coordinates.size();
        Numbers numbers({static_cast<std::size_t>(size()), numPaths, numCoordinates});
        std::fill_n(numbers.mutable_data(), numbers.size(), 0.0);
        for (std::size_t p = 0; p < numPaths; ++p) {
            const std::vector<std::string>& crossed = m_layout->paths[p].coordinates;
            for (std::size_t c = 0; c < crossed.size(); ++c) {
                const auto& all = m_layout->coordinates;
                const auto at = std::find(all.begin(), all.end(), crossed[c]) - all.begin();
                for (int i = 0; i < size(); ++i) *numbers.mutable_data(i, p, at) = (get(i).paths[p].*arms)[c];
            }
        }
        return numbers;
    }

    Numbers listCoordinates(std::vector<double> models::PoseAnswer::*values) const {
        const auto numCoordinates = m_layout->coordinates.size();
        Numbers numbers({static_cast<std::size_t>(size()), numCoordinates});
        for (int i = 0; i < size(); ++i)
            for (std::size_t c = 0; c < numCoordinates; ++c) *numbers.mutable_data(i, c) = (get(i).*values)[c];
        return numbers;
    }

    std::vector<std::vector<std::string>> getStatus() const {
        std::vector<std::vector<std::string>> names;
        for (const models::PoseAnswer& answer : m_answers) {
            names.emplace_back();
            for (const models::PathAnswer& path : answer.paths) names.back().push_back(getName(path.status));
        }
        return names;
    }

    std::string explain(int i, const std::string& name) const {
        if (i < 0 || i >= size())
            throw py::index_error("pose " + std::to_string(i) + " of " + std::to_string(size()) + " is asked for");
        for (std::size_t p = 0; p < m_layout->paths.size(); ++p)
            if (m_layout->paths[p].name == name) {
                const std::string& told = get(i).paths[p].explanation;
                return told.empty() ? "a local minimum" : told;
            }
        throw py::key_error("there is no path '" + name + "'");
    }

private:
    std::shared_ptr<const Layout> m_layout;
    std::vector<models::PoseAnswer> m_answers;
};

/** Paths of a model in poses. */
class Study {
public:
    Study(const Model& model, const std::optional<std::vector<std::string>>& paths)
        : m_study(makeStudy(*model.description, paths)) {
        auto layout = std::make_shared<Layout>();
        layout->paths = m_study.getStudy().getPaths();
        layout->coordinates = m_study.getStudy().getCoordinateNames();
        m_layout = layout;
        for (const std::string& name : paths.value_or(std::vector<std::string>())) {
            const std::vector<std::string> known = layout->getPathNames();
            require(std::find(known.begin(), known.end(), name) != known.end(), "the model has no path '", name, "'");
        }
    }

    const Layout& getLayout() const { return *m_layout; }

    std::shared_ptr<StudyResults> solve(const Numbers& q, const std::optional<std::vector<std::string>>& coordinates,
                                        const std::optional<Numbers>& u, const std::optional<Numbers>& times,
                                        int numThreads) {
        const std::vector<std::string>& names = coordinates ? *coordinates : m_layout->coordinates;
        const auto numCoordinates = static_cast<py::ssize_t>(names.size());
        requireShape(q, "q", {-1, numCoordinates});
        const py::ssize_t count = q.shape(0);
        if (u) requireShape(*u, "u", {count, numCoordinates});
        if (times) requireShape(*times, "times", {count});
        const double *values = q.data(), *speeds = u ? u->data() : nullptr, *at = times ? times->data() : nullptr;
        const auto makePose = [&](int i) {
            models::ModelPose pose;
            if (at) pose.time = at[i];
            for (py::ssize_t c = 0; c < numCoordinates; ++c) {
                const std::string& name = names[static_cast<std::size_t>(c)];
                pose.values[name] = values[i * numCoordinates + c];
                if (speeds) pose.speeds[name] = speeds[i * numCoordinates + c];
            }
            return pose;
        };
        std::vector<models::PoseAnswer> answers;
        runInterruptibly(numThreads, [&](const Threads& threads) {
            return m_study.solveMany(static_cast<int>(count), makePose, answers, threads);
        });
        return std::make_shared<StudyResults>(m_layout, std::move(answers));
    }

private:
    static models::ParallelStudy makeStudy(const ModelDescription& description,
                                           const std::optional<std::vector<std::string>>& wanted) {
        const py::gil_scoped_release released;
        return models::ParallelStudy(description, [wanted](const std::string& name) {
            return !wanted || std::find(wanted->begin(), wanted->end(), name) != wanted->end();
        });
    }

    models::ParallelStudy m_study;
    std::shared_ptr<const Layout> m_layout;
};

py::tuple makeTable(const StorageTable& table) {
    Numbers rows({table.rows.size(), table.labels.size()});
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        std::copy(table.rows[i].begin(), table.rows[i].end(), rows.mutable_data(i, 0));
    return py::make_tuple(table.labels, rows);
}

/** A function of Python's that keeps what it raises: an integrator would only take smaller steps. */
Excitation makeExcitation(const py::object& function, const std::shared_ptr<std::exception_ptr>& raised) {
    return [function = function.cast<Excitation>(), raised](double time) {
        try {
            return function(time);
        } catch (...) {
            *raised = std::current_exception();
            throw;
        }
    };
}

/** Numbers and functions of time, of all muscles that are not named the program's default. */
std::map<std::string, Excitation> makeAll(const Model& model, const std::map<std::string, py::object>& given,
                                          const std::shared_ptr<std::exception_ptr>& raised) {
    std::map<std::string, Excitation> excitations;
    for (const std::string& name : model.getMuscles()) excitations[name] = [](double) { return kDefaultExcitation; };
    for (const models::PrescribedControl& control : model.description->controls)
        if (excitations.count(control.actuator))
            excitations[control.actuator] = [function = control.control](double time) {
                return std::clamp(function.calcValue(time), 0.0, 1.0);
            };
    for (const auto& [name, value] : given) {
        require(excitations.count(name) > 0, "the model has no muscle '", name, "'");
        if (PyCallable_Check(value.ptr())) {
            excitations[name] = makeExcitation(value, raised);
            continue;
        }
        const auto constant = value.cast<double>();
        require(constant >= 0 && constant <= 1, "excitation of '", name, "' must be in [0, 1], but is ", constant);
        excitations[name] = [constant](double) { return constant; };
    }
    return excitations;
}

/** The model's own, as the program begins with it. */
InitialState makeInitialState(const ModelDescription& description) {
    InitialState initial;
    for (const models::Joint& joint : description.joints)
        for (const models::Coordinate& coordinate : joint.coordinates)
            if (coordinate.locked) initial.speeds[coordinate.name] = 0.0;
    return initial;
}

py::dict simulateModel(const Model& model, const std::map<std::string, py::object>& given, double duration,
                       double interval, double accuracy) {
    SimulationOptions options;
    options.duration = duration;
    options.interval = interval;
    options.accuracy = accuracy;
    options.validate();
    const auto raised = std::make_shared<std::exception_ptr>();
    const std::map<std::string, Excitation> excitations = makeAll(model, given, raised);
    const auto isInterrupted = [&raised] {
        const py::gil_scoped_acquire python;
        return *raised || PyErr_CheckSignals() != 0;
    };
    SimulationResult result;
    {
        const py::gil_scoped_release released;
        models::ModelSystem system(*model.description);
        result = simulate(
            system, excitations, options, [](double) {}, nullptr, makeInitialState(*model.description), isInterrupted);
    }
    if (*raised) std::rethrow_exception(*raised);
    if (PyErr_Occurred()) throw py::error_already_set();
    if (result.ending.kind == SimulationEnding::Kind::Stuck)
        throw std::runtime_error("the simulation cannot go on at " + std::to_string(result.ending.time) +
                                 " s: " + result.ending.reason);
    py::dict tables;
    tables["states"] = makeTable(result.states);
    tables["paths"] = makeTable(result.paths);
    tables["muscles"] = makeTable(result.muscles);
    tables["clearances"] = makeTable(result.clearances);
    tables["events"] = result.events;
    return tables;
}

}  // namespace

void bindModels(py::module_& module) {
    using py::arg;
    py::class_<Model>(module, "Model", "A model file that was read.")
        .def_property_readonly("name", [](const Model& model) { return model.description->name; })
        .def_property_readonly("coordinates", &Model::getCoordinates, "Names, in the order of the file.")
        .def_property_readonly("muscles", &Model::getMuscles, "Names, in the order of the file.")
        .def_property_readonly("notes", &Model::getNotes,
                               "What was read over or read otherwise than it is written, and why.");
    module.def("read_osim", &readModel, arg("file"), py::kw_only(), arg("ignored") = std::vector<std::string>(),
               arg("lengths_only") = false, arg("settings") = std::vector<std::string>(),
               "Reads an OpenSim model.\n\n"
               "ignored        names or types of elements to leave out though they are not known\n"
               "lengths_only   what only makes forces is never in the way\n"
               "settings       ELEMENT/FIELD=VALUE or ELEMENT/FIELD=*FACTOR: fields with other values than the file's\n\n"
               "Raises ModelError with everything that is not known.");

    py::class_<StudyResults, std::shared_ptr<StudyResults>>(
        module, "StudyResults", "Paths of a model in n poses. SI units and radians, the lists of names as in Study.")
        .def("__len__", &StudyResults::size)
        .def_property_readonly("paths", [](const StudyResults& r) { return r.getLayout().getPathNames(); })
        .def_property_readonly("coordinates", [](const StudyResults& r) { return r.getLayout().coordinates; })
        .def_property_readonly("obstacles", [](const StudyResults& r) { return r.getLayout().getObstacleNames(); })
        .def_property_readonly(
            "length", [](const StudyResults& r) { return r.listPaths([](const auto& path) { return path.length; }); },
            "(n, paths) [m]")
        .def_property_readonly(
            "rate", [](const StudyResults& r) { return r.listPaths([](const auto& path) { return path.rate; }); },
            "(n, paths): lengthening speeds [m/s]")
        .def_property_readonly(
            "sound",
            [](const StudyResults& r) {
                return r.listPaths([](const auto& path) { return path.isSound() ? 1.0 : 0.0; });
            },
            "(n, paths): 1 for a shortest path on the sides that the model asks for, else 0")
        .def_property_readonly(
            "status",
            [](const StudyResults& r) {
                return makeWords(r.getStatus()).attr("reshape")(r.size(), r.getLayout().paths.size());
            },
            "(n, paths): words, such as 'solved'")
        .def_property_readonly(
            "moment_arm", [](const StudyResults& r) { return r.listArms(&models::PathAnswer::effectiveArms); },
            "(n, paths, coordinates): effective moment arms -dl/dq [m or 1], coupled coordinates moving along; 0 "
            "about\n"
            "coordinates that a path does not cross, NaN where constraints hold the coordinate")
        .def_property_readonly(
            "geometric_moment_arm",
            [](const StudyResults& r) { return r.listArms(&models::PathAnswer::geometricArms); },
            "(n, paths, coordinates): the same with all other coordinates at rest")
        .def_property_readonly(
            "touched",
            [](const StudyResults& r) {
                return r.listObstacles([](const auto& obstacle) { return obstacle.isTouched ? 1.0 : 0.0; });
            },
            "(n, obstacles): 1 where an obstacle is touched, else 0")
        .def_property_readonly(
            "arc_length",
            [](const StudyResults& r) {
                return r.listObstacles([](const auto& obstacle) { return obstacle.arcLength; });
            },
            "(n, obstacles) [m]")
        .def_property_readonly(
            "values", [](const StudyResults& r) { return r.listCoordinates(&models::PoseAnswer::values); },
            "(n, coordinates) as they stand once the constraints hold [rad or m]")
        .def_property_readonly(
            "speeds", [](const StudyResults& r) { return r.listCoordinates(&models::PoseAnswer::speeds); },
            "(n, coordinates)")
        .def_property_readonly(
            "constraint_faults",
            [](const StudyResults& r) {
                std::vector<std::string> faults;
                for (int i = 0; i < r.size(); ++i) faults.push_back(r.get(i).constraintFault);
                return faults;
            },
            "n texts: why the constraints do not hold; empty where they do")
        .def("explain", &StudyResults::explain, arg("index"), arg("path"), "The status of a path in a sentence.");

    py::class_<Study>(module, "Study",
                      "Lengths, rates, contacts and moment arms of a model's paths in poses. Forces play no part.")
        .def(py::init<const Model&, const std::optional<std::vector<std::string>>&>(), arg("model"),
             arg("paths") = py::none(), "paths   names of those that are wanted; None: all")
        .def_property_readonly("paths", [](const Study& study) { return study.getLayout().getPathNames(); })
        .def_property_readonly("coordinates", [](const Study& study) { return study.getLayout().coordinates; })
        .def_property_readonly(
            "obstacles", [](const Study& study) { return study.getLayout().getObstacleNames(); },
            "path/obstacle, along each path")
        .def(
            "solve", &Study::solve, arg("q"), py::kw_only(), arg("coordinates") = py::none(), arg("u") = py::none(),
            arg("times") = py::none(), arg("threads") = 0,
            "Solves in n poses. Each answer is that of its pose alone; its last digits may depend on the poses before\n"
            "it in its block of 64, from one to the next of which paths are continued, and on nothing else.\n\n"
            "q             (n, m): values of m coordinates [rad or m], clipped to no range\n"
            "coordinates   their names; None: all of the model, in the order of the file. Others stand at their "
            "defaults\n"
            "u             (n, m): speeds; None: at rest\n"
            "times         (n,) [s], for coordinates that follow a motion; None: 0\n"
            "threads       0: as many as the machine has. Python's lock is released\n\n"
            "Returns StudyResults. Raises ModelError naming a coordinate that is not there or not finite.");

    module.def(
        "simulate", &simulateModel, arg("model"), py::kw_only(),
        arg("excitations") = std::map<std::string, py::object>(), arg("duration") = SimulationOptions().duration,
        arg("interval") = SimulationOptions().interval, arg("accuracy") = SimulationOptions().accuracy,
        "Simulates a model forward, as `tautline run` does, with the same results.\n\n"
        "excitations   by muscle: a number in [0, 1] or a function of time [s]; 0.05 for others\n"
        "duration, interval   in s\n"
        "accuracy      of the integrator\n\n"
        "Returns a dict: states, paths, muscles and clearances are (labels, rows) with rows (k, labels), the first\n"
        "column time; events is the text of events.csv.");
}

}  // namespace tautline::python
