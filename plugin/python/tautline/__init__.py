# SPDX-License-Identifier: Apache-2.0
"""Shortest paths of muscles and cables over smooth surfaces.

A path is a taut, frictionless, massless string from a point over an ordered list of smooth moving surfaces to another
point. ``PathProblem`` says what it is made of and solves it in many poses at once; ``read_osim``, ``Study`` and
``simulate`` do the same for the muscles of OpenSim models. Units are SI and radians.
"""
import numpy as _numpy

from . import _tautline
from ._tautline import *  # noqa: F401,F403
from ._tautline import __version__  # noqa: F401


def poses(positions, rotations=None):
    """Poses as homogeneous matrices.

    positions   (..., 3): origins in ground [m]
    rotations   (..., 3, 3); None: none

    Returns (..., 4, 4).
    """
    positions = _numpy.asarray(positions, dtype=float)
    matrices = _numpy.zeros(positions.shape[:-1] + (4, 4))
    matrices[..., :3, :3] = _numpy.eye(3) if rotations is None else rotations
    matrices[..., :3, 3] = positions
    matrices[..., 3, 3] = 1.0
    return matrices
