"""Rotation matrices, Euler angles and quaternions (x, y, z, w), as 4x4 matrices and arrays of numpy."""

from __future__ import annotations

import math
from typing import Any

import numpy
from periplus.ros._transformations import *  # noqa: F403
from periplus.ros._transformations import AXES2TUPLE as _AXES2TUPLE  # noqa: F401
from periplus.ros._transformations import TUPLE2AXES as _TUPLE2AXES  # noqa: F401


def orthogonalization_matrix(lengths: Any, angles: Any) -> Any:
    """Matrix from coordinates along the edges of a crystal cell to Cartesian ones.

    Args:
        lengths: Edges a, b, c.
        angles: Angles alpha, beta, gamma between them [degrees].
    """
    a, b, c = lengths
    alpha, beta, gamma = (math.radians(one) for one in angles)
    # The third axis is z. The first lies in the plane of x and z.
    cos_star = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (math.sin(alpha) * math.sin(beta))
    matrix = numpy.identity(4)
    matrix[:3, 0] = (a * math.sin(beta) * math.sqrt(1.0 - cos_star * cos_star), -a * math.sin(beta) * cos_star, a * math.cos(beta))
    matrix[:3, 1] = (0.0, b * math.sin(alpha), b * math.cos(alpha))
    matrix[:3, 2] = (0.0, 0.0, c)
    return matrix


def reflection_from_matrix(matrix: Any) -> tuple[Any, Any]:
    """Point and normal of the plane of a reflection."""
    full = numpy.array(matrix, dtype=numpy.float64)
    values, vectors = numpy.linalg.eig(full[:3, :3])
    index = numpy.where(abs(numpy.real(values) + 1.0) < 1e-8)[0]
    if not len(index):
        raise ValueError("no unit eigenvector corresponding to eigenvalue -1")
    normal = numpy.real(vectors[:, index[0]])
    return _fixed_point(full), normal


def _fixed_point(full: Any) -> Any:
    """Homogeneous point that a matrix leaves where it is."""
    values, vectors = numpy.linalg.eig(full)
    index = numpy.where(abs(numpy.real(values) - 1.0) < 1e-8)[0]
    if not len(index):
        raise ValueError("no unit eigenvector corresponding to eigenvalue 1")
    for one in index[::-1]:
        point = numpy.real(vectors[:, one])
        if abs(point[3]) > 1e-8:
            return point / point[3]
    return numpy.array((0.0, 0.0, 0.0, 1.0))


def scale_from_matrix(matrix: Any) -> tuple[float, Any, Any]:
    """Factor, origin and direction of a scaling; the direction is None for a uniform one."""
    full = numpy.array(matrix, dtype=numpy.float64)
    factor = float(numpy.trace(full[:3, :3]) - 2.0)
    values, vectors = numpy.linalg.eig(full[:3, :3])
    index = numpy.where(abs(numpy.real(values) - factor) < 1e-8)[0]
    direction = None
    if len(index):
        direction = numpy.real(vectors[:, index[0]])
        direction = direction / numpy.linalg.norm(direction)
    else:
        factor = (factor + 2.0) / 3.0
    return factor, _fixed_point(full), direction


def quaternion_real(quaternion: Any) -> float:
    """Real part of a quaternion."""
    return float(quaternion[3])


def quaternion_imag(quaternion: Any) -> Any:
    """Imaginary part of a quaternion."""
    return numpy.array(quaternion[:3], dtype=numpy.float64)
