# SPDX-License-Identifier: Apache-2.0
"""The core from Python: closed forms, differences, users' surfaces, refusals, Ctrl-C."""
import os
import signal
import threading
import time

import numpy as np
import pytest

import tautline

SEED = 20261127


def make_problem(surface, **hint):
    problem = tautline.PathProblem()
    problem.add_point("origin")
    problem.add_obstacle("obstacle", surface, **hint)
    problem.add_point("insertion")
    return problem


def random_poses(n):
    """Ends on both sides of an obstacle at the origin that is turned at random."""
    print("seed", SEED)
    random = np.random.default_rng(SEED)
    positions = np.zeros((n, 3, 3))
    positions[:, 0] = [-0.2, 0.02, 0] + 0.02 * random.standard_normal((n, 3))
    positions[:, 2] = [0.2, 0.03, 0] + 0.02 * random.standard_normal((n, 3))
    rotations = np.tile(np.eye(3), (n, 3, 1, 1))
    rotations[:, 1] = np.linalg.qr(random.standard_normal((n, 3, 3)))[0]
    rotations[:, 1, :, 0] *= np.linalg.det(rotations[:, 1])[:, None]
    return tautline.poses(positions, rotations)


def sphere_length(a, b, r):
    """Over a sphere at the origin: two tangents and an arc in the plane of both ends."""
    p, q = np.linalg.norm(a, axis=-1), np.linalg.norm(b, axis=-1)
    turn = np.arccos(np.sum(a * b, axis=-1) / (p * q)) - np.arccos(r / p) - np.arccos(r / q)
    return np.where(turn > 0, np.sqrt(p**2 - r**2) + np.sqrt(q**2 - r**2) + r * turn, np.linalg.norm(a - b, axis=-1))


def test_lengths_over_a_sphere_are_those_of_the_closed_form():
    poses = random_poses(500)
    paths = make_problem(tautline.Sphere(0.05)).solve(poses)
    assert len(paths) == 500
    assert set(paths.status) == {"solved"}
    expected = sphere_length(poses[:, 0, :3, 3], poses[:, 2, :3, 3], 0.05)
    np.testing.assert_allclose(paths.length, expected, atol=1e-13)
    touched = paths.touched[:, 0] == 1
    assert 0 < touched.sum() < 500
    assert np.all(np.isnan(paths.P[~touched])) and np.all(np.isfinite(paths.P[touched]))
    np.testing.assert_allclose(np.linalg.norm(paths.Q[touched, 0], axis=1), 0.05, atol=1e-13)
    assert np.all(paths.arc_length[~touched] == 0)


def test_answers_do_not_depend_on_threads():
    poses = random_poses(200)
    problem = make_problem(tautline.Ellipsoid([0.05, 0.03, 0.08]))
    one, three = problem.solve(poses, threads=1), problem.solve(poses, threads=3)
    np.testing.assert_array_equal(one.length, three.length)
    np.testing.assert_array_equal(one.unit_forces, three.unit_forces)


def test_rates_and_forces_are_those_of_differences():
    random = np.random.default_rng(SEED)
    poses = random_poses(1)[0]
    problem = make_problem(tautline.Ellipsoid([0.06, 0.05, 0.08]), near=[0, 0.06, 0])
    paths = problem.solve(poses)
    velocities = random.standard_normal((1, 3, 6))

    def move(h):
        moved = poses.copy()
        for e in range(3):
            w, v = velocities[0, e, :3], velocities[0, e, 3:]
            angle = h * np.linalg.norm(w)
            k = np.cross(np.eye(3), w / np.linalg.norm(w))  # k @ x = w x x
            moved[e, :3, :3] = (np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k) @ poses[e, :3, :3]
            moved[e, :3, 3] += h * v
        return moved

    h = 2e-5
    around = problem.solve(np.array([move(-2 * h), move(-h), move(h), move(2 * h)]))

    def differentiate(numbers):
        return (numbers[0] - 8 * numbers[1] + 8 * numbers[2] - numbers[3]) / (12 * h)

    difference = differentiate(around.length)
    assert paths.rate(velocities)[0] == pytest.approx(difference, abs=1e-9)
    # The power of the forces of unit tension is -dL/dt, and they balance.
    assert np.sum(paths.unit_forces[0] * velocities[0]) == pytest.approx(-paths.rate(velocities)[0], abs=1e-13)
    np.testing.assert_allclose(paths.unit_forces[0, :, 3:].sum(axis=0), 0, atol=1e-13)
    variation = paths.variation(0, velocities[0])
    assert variation["is_regular"]
    assert variation["length_rate"] == pytest.approx(difference, abs=1e-9)
    np.testing.assert_allclose(variation["unit_force_rate"], differentiate(around.unit_forces), atol=1e-6)
    np.testing.assert_allclose(variation["P_rate"][1], differentiate(around.P)[0], atol=1e-6)
    np.testing.assert_allclose(variation["Q_rate"][1], differentiate(around.Q)[0], atol=1e-6)


def test_continued_paths_are_those_of_single_poses():
    problem = make_problem(tautline.Cylinder(0.05), turns=1)
    angles = np.linspace(0, 1, 50)
    positions = np.zeros((50, 3, 3))
    positions[:, 0] = [-0.2, 0.02, 0]
    positions[:, 2] = np.stack([0.2 * np.cos(angles), 0.2 * np.sin(angles), 0.1 * angles], axis=1)
    poses = tautline.poses(positions)
    np.testing.assert_allclose(
        problem.solve(poses, continued=True).length, problem.solve(poses).length, rtol=1e-12
    )


def test_surface_of_functions_is_the_sphere_that_it_says():
    r = 0.05
    own = tautline.ImplicitSurface(
        "ball",
        r,
        lambda p: p @ p - r * r,
        gradient=lambda p: 2 * p,
        hessian=lambda p: 2 * np.eye(3),
        convex=True,
    )
    poses = random_poses(20)
    np.testing.assert_allclose(
        make_problem(own).solve(poses).length, make_problem(tautline.Sphere(r)).solve(poses).length, atol=1e-12
    )
    assert own.check_laws([[0, 0.06, 0.01]], [[1, 0, 0]], 0.04) == []
    np.testing.assert_allclose(own.height([[0, 0.05, 0]]), 0, atol=1e-15)


def test_wrong_derivatives_of_an_own_surface_are_named():
    own = tautline.ImplicitSurface("ball", 0.05, lambda p: p @ p - 0.0025, gradient=lambda p: p * [2, 2, 1])
    broken = own.check_laws([[0, 0.03, 0.05]], [[1, 0, 0]], 0.04)
    assert any("df/dz" in sentence for sentence in broken), broken


def test_parametric_surface_of_functions():
    r = 0.05
    own = tautline.ParametricSurface(
        "tube", r, [-np.pi, -1], [np.pi, 1], lambda uv: [r * np.cos(uv[0]), r * np.sin(uv[0]), uv[1]]
    )
    positions = np.zeros((1, 3, 3))
    positions[:, 0], positions[:, 2] = [-0.01, 0.2, 0], [-0.01, -0.2, 0.1]
    poses = tautline.poses(positions)
    own_path = make_problem(own, near=[r, 0, 0]).solve(poses)
    path = make_problem(tautline.Cylinder(r), near=[r, 0, 0]).solve(poses)
    assert list(own_path.status) == list(path.status) == ["solved"]
    np.testing.assert_allclose(own_path.length, path.length, atol=1e-10)


def test_errors_of_own_functions_come_through():
    def value(p):
        raise ZeroDivisionError("in my surface")

    with pytest.raises(ZeroDivisionError, match="in my surface"):
        make_problem(tautline.ImplicitSurface("broken", 0.05, value)).solve(random_poses(40))


def test_refusals_name_value_and_limit():
    with pytest.raises(tautline.InvalidInput, match="-1"):
        tautline.Cylinder(-1)
    problem = make_problem(tautline.Sphere(0.05))
    with pytest.raises(ValueError, match=r"poses must have the shape \(n, 3, 4, 4\), but has \(2, 2, 4, 4\)"):
        problem.solve(np.zeros((2, 2, 4, 4)))
    poses = random_poses(1)
    poses[0, 1, 0, 0] += 0.1
    with pytest.raises(ValueError, match=r"poses\[0, 1\] is not a rotation and a translation"):
        problem.solve(poses)
    with pytest.raises(ValueError, match="one of near, side, turns and passages"):
        make_problem(tautline.Torus(0.1, 0.02), near=[0, 0, 0], passages=1)
    with pytest.raises(ValueError, match="threads must not be negative, but is -2"):
        problem.solve(random_poses(1), threads=-2)
    with pytest.raises(IndexError):
        problem.solve(random_poses(1)).explain(1)
    with pytest.raises(ValueError):
        tautline.PathProblem().solve(np.zeros((0, 4, 4)))


def test_poses_that_are_not_finite_have_a_status():
    poses = random_poses(2)
    poses[1, 0, 0, 3] = np.nan
    paths = make_problem(tautline.Sphere(0.05)).solve(poses)
    assert list(paths.status) == ["solved", "not_converged"]


def test_explains_and_draws():
    paths = make_problem(tautline.Sphere(0.05)).solve(random_poses(1))
    assert paths.explain(0) == "a local minimum"
    points = paths.points(0, 0.02)
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert length == pytest.approx(paths.length[0], rel=1e-4)


def test_python_runs_while_paths_are_solved():
    problem, poses = make_problem(tautline.Ellipsoid([0.05, 0.03, 0.08])), random_poses(3000)
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    problem.solve(poses, threads=1)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 3


def test_control_c_stops_a_long_call():
    def value(p):
        time.sleep(0.001)
        return p @ p - 0.0025

    problem, poses = make_problem(tautline.ImplicitSurface("slow", 0.05, value)), random_poses(5000)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        problem.solve(poses)
    assert 0.25 < time.monotonic() - start < 5
