# SPDX-License-Identifier: Apache-2.0
"""How long Python takes for lengths and moment arms of a model in many poses, beside a C++ program on as many threads,
and whether both answers are the same to the last bit.

PYTHONPATH=build/python /usr/bin/python3 bench/model_poses.py MODEL [--poses N] [--threads T] [--repeat R]
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import tautline

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build", "bench", "model_poses")


def make_poses(study, low, high, count):
    """(count, coordinates): spread evenly over a range [rad or m], the same at each call."""
    golden = 0.6180339887498949
    steps = golden ** (1 + np.arange(len(study.coordinates)))
    return low + (high - low) * np.modf(np.outer(np.arange(count), steps))[0]


def run_cpp(model, poses, threads, program):
    """Seconds, and an array of all numbers."""
    with tempfile.TemporaryDirectory() as folder:
        inputs, outputs = os.path.join(folder, "poses"), os.path.join(folder, "answers")
        poses.astype(np.float64).tofile(inputs)
        told = subprocess.run([program, model, inputs, "--threads", str(threads), "--out", outputs], check=True,
                              capture_output=True, text=True)
        return float(told.stdout), np.fromfile(outputs)


def run_python(study, poses, threads):
    """The same from one call, arrays of lengths and moment arms included."""
    begin = time.perf_counter()
    results = study.solve(poses, threads=threads)
    length, arms = results.length, results.moment_arm
    seconds = time.perf_counter() - begin
    return seconds, np.concatenate([length, arms.reshape(len(poses), -1)], axis=1).ravel()


def main():
    """Prints a line for each repetition and the ratio of the best times; fails if the answers differ."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("model")
    parser.add_argument("--poses", type=int, default=100000)
    parser.add_argument("--range", type=float, nargs=2, default=[0.0, 1.5], help="of all coordinates [rad or m]")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--program", default=PROGRAM)
    given = parser.parse_args()
    study = tautline.Study(tautline.read_osim(given.model, lengths_only=True))
    poses = make_poses(study, *given.range, given.poses)
    study.solve(poses[: 64 * given.threads], threads=given.threads)  # the threads' systems are made by the first call
    best = [np.inf, np.inf]
    for _ in range(given.repeat):
        seconds = [run_cpp(given.model, poses, given.threads, given.program),
                   run_python(study, poses, given.threads)]
        if not np.array_equal(seconds[0][1], seconds[1][1], equal_nan=True):
            sys.exit("the answers of C++ and Python differ")
        print(f"C++ {seconds[0][0]:.3f} s, Python {seconds[1][0]:.3f} s")
        best = [min(old, new[0]) for old, new in zip(best, seconds)]
    print(f"{given.poses} poses, {given.threads} threads: Python takes {best[1] / best[0]:.3f} times as long as C++; "
          f"{seconds[0][1].size} numbers are the same to the last bit")


if __name__ == "__main__":
    main()
