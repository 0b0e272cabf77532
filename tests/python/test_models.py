# SPDX-License-Identifier: Apache-2.0
"""Models from Python give what the program gives."""
import os
import signal
import subprocess
import threading

import numpy as np
import pytest

import tautline

ROOT = os.environ["TAUTLINE_SOURCE_DIR"]
PROGRAM = os.environ["TAUTLINE_PROGRAM"]
ELBOW = os.path.join(ROOT, "models", "elbow.osim")


def read_storage(file):
    """Labels and rows."""
    with open(file) as lines:
        for line in lines:
            if line.strip() == "endheader":
                break
        labels = next(lines).split()
        return labels, np.array([[float(word) for word in line.split()] for line in lines])


def test_reads_a_model():
    model = tautline.read_osim(ELBOW)
    study = tautline.Study(model)
    assert study.coordinates == model.coordinates
    assert set(model.muscles) <= set(study.paths)
    assert all("/" in name for name in study.obstacles)


def test_moment_arms_are_differences_of_lengths():
    model = tautline.read_osim(ELBOW)
    study = tautline.Study(model)
    coordinate = "elbow_flexion"
    at = model.coordinates.index(coordinate)
    h = 1e-5
    q = np.linspace(0.4, 1.6, 9)
    around = np.concatenate([q - h, q, q + h])[:, None]
    results = study.solve(around, coordinates=[coordinate], u=np.full_like(around, 0.5))
    assert np.all(results.sound == 1)
    assert results.status.shape == results.length.shape and np.all(results.status == "solved")
    assert study.solve(around[:0], coordinates=[coordinate]).status.shape == (0, len(study.paths))
    assert np.all(np.abs(results.moment_arm[:, :, at]).max(axis=0) > 0.005)
    length = results.length.reshape(3, 9, -1)
    arms = results.moment_arm[9:18, :, at]
    np.testing.assert_allclose(arms, -(length[2] - length[0]) / (2 * h), atol=1e-8)
    np.testing.assert_allclose(results.rate[9:18], -0.5 * arms, atol=1e-12)
    np.testing.assert_array_equal(results.values[:, at], around[:, 0])


def test_equals_the_program_to_the_last_digit(tmp_path):
    model = tautline.read_osim(ELBOW)
    coordinate = "elbow_flexion"
    at = model.coordinates.index(coordinate)
    times, q = np.linspace(0, 1, 21), np.linspace(0.2, 1.9, 21)
    motion = tmp_path / "motion.sto"
    with open(motion, "w") as out:
        out.write(f"motion\nversion=1\nnRows=21\nnColumns=2\ninDegrees=no\nendheader\ntime\t{coordinate}\n")
        for row in zip(times, q):
            out.write("\t".join(repr(float(number)) for number in row) + "\n")
    subprocess.run([PROGRAM, "solve", ELBOW, "--motion", motion, "--out", tmp_path], check=True, capture_output=True)
    results = tautline.Study(model).solve(q[:, None], coordinates=[coordinate], times=times)
    found = 0
    for file in tmp_path.glob("*.sto"):
        if file == motion:
            continue
        labels, rows = read_storage(file)
        for p, path in enumerate(results.paths):
            for label, numbers in [
                (f"/forceset/{path}|length", results.length[:, p]),
                (f"/forceset/{path}|moment_arm.{coordinate}", results.moment_arm[:, p, at]),
            ]:
                if label in labels:
                    np.testing.assert_array_equal(rows[:, labels.index(label)], numbers)
                    found += 1
    assert found == 2 * len(results.paths)


def test_arm26_over_its_motion_equals_the_program_to_the_last_digit(tmp_path):
    shared = os.environ.get("TAUTLINE_SHARED", os.path.join(ROOT, "..", "shared"))
    file = os.path.join(shared, "data", "opensim", "models", "arm26.osim")
    motion = os.path.join(shared, "data", "opensim", "motions", "arm26_InverseKinematics.mot")
    if not os.path.exists(file):
        pytest.skip("no reference data: neither ../shared nor TAUTLINE_SHARED is a folder")
    subprocess.run(
        [PROGRAM, "solve", file, "--motion", motion, "--out", tmp_path, "--allow-degraded"], check=True, capture_output=True
    )
    labels, poses = read_storage(tmp_path / "coordinates.sto")
    names = [label.split("/")[3] for label in labels[1::2]]
    study = tautline.Study(tautline.read_osim(file))
    results = study.solve(poses[:, 1::2], coordinates=names, u=poses[:, 2::2], times=poses[:, 0])
    compared = 0
    for table, values in [("paths", results.length), ("moment_arms", results.moment_arm)]:
        labels, rows = read_storage(tmp_path / f"{table}.sto")
        assert len(rows) == len(poses) == 121
        for p, path in enumerate(results.paths):
            for label, column in zip(labels, rows.T):
                if label == f"/forceset/{path}|length":
                    np.testing.assert_array_equal(column, values[:, p])
                elif label.startswith(f"/forceset/{path}|moment_arm."):
                    coordinate = label.rsplit(".", 1)[1]
                    np.testing.assert_array_equal(column, values[:, p, results.coordinates.index(coordinate)])
                else:
                    continue
                compared += 1
    assert compared >= 2 * len(results.paths)


def test_simulates_as_the_program_does(tmp_path):
    model = tautline.read_osim(ELBOW)
    muscle = model.muscles[0]
    subprocess.run(
        [PROGRAM, "run", ELBOW, "--duration", "0.2", "--excitation", f"{muscle}=0.4", "--out", tmp_path],
        check=True,
        capture_output=True,
    )
    for excitation in [0.4, lambda time: 0.4]:
        tables = tautline.simulate(model, duration=0.2, excitations={muscle: excitation})
        for name in ["states", "paths", "muscles", "clearances"]:
            labels, rows = read_storage(tmp_path / f"{name}.sto")
            assert tables[name][0] == labels
            np.testing.assert_array_equal(tables[name][1], rows)
        assert tables["events"] == (tmp_path / "events.csv").read_text()


def test_errors_of_excitations_and_control_c_end_a_simulation():
    model = tautline.read_osim(ELBOW)

    def excitation(time):
        if time > 0.05:
            raise ZeroDivisionError("in my excitation")
        return 0.1

    with pytest.raises(ZeroDivisionError, match="in my excitation"):
        tautline.simulate(model, excitations={model.muscles[0]: excitation})
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        tautline.simulate(model, duration=1000, interval=1000)


def test_answers_do_not_depend_on_threads():
    model = tautline.read_osim(ELBOW)
    study = tautline.Study(model)
    q = np.linspace(0, 2, 100)[:, None]
    one = study.solve(q, coordinates=model.coordinates[:1], threads=1)
    four = study.solve(q, coordinates=model.coordinates[:1], threads=4)
    np.testing.assert_array_equal(one.length, four.length)
    np.testing.assert_array_equal(one.moment_arm, four.moment_arm)


def test_refusals(tmp_path):
    with pytest.raises(tautline.ModelError, match="no_such.osim"):
        tautline.read_osim("no_such.osim")
    broken = tmp_path / "broken.osim"
    broken.write_text("<OpenSimDocument Version='40000'>\n<Model><Rope/></Model></OpenSimDocument>")
    with pytest.raises(tautline.ModelError, match=r"broken.osim:2: unknown element Rope"):
        tautline.read_osim(str(broken))
    model = tautline.read_osim(ELBOW)
    with pytest.raises(tautline.ModelError, match="there is no coordinate 'shoulder'"):
        tautline.Study(model).solve([[0.0]], coordinates=["shoulder"])
    with pytest.raises(tautline.ModelError, match="must be finite"):
        tautline.Study(model).solve([[np.nan]], coordinates=model.coordinates[:1])
    with pytest.raises(ValueError, match="q must have the shape"):
        tautline.Study(model).solve([0.0])
    with pytest.raises(ValueError, match="the model has no path 'rope'"):
        tautline.Study(model, ["rope"])
    with pytest.raises(ValueError, match="the model has no muscle 'rope'"):
        tautline.simulate(model, excitations={"rope": 0.1})
    with pytest.raises(ValueError, match=r"must be in \[0, 1\], but is 2"):
        tautline.simulate(model, excitations={model.muscles[0]: 2.0})
    with pytest.raises(KeyError):
        tautline.Study(model).solve(np.zeros((1, 0)), coordinates=[]).explain(0, "rope")
