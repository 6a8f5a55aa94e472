"""Rotation matrices, Euler angles and quaternions (x, y, z, w), for `tf_transformations` and the `tf.transformations` of ROS 1.

Angles are radians. `axes` names the rotations: `s` for axes that stay, `r` for axes that turn with the body, and the
three axes in the order of the rotations. The default `sxyz` is roll, pitch, yaw.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

_EPSILON = np.finfo(float).eps * 4.0
_AXES = {"x": 0, "y": 1, "z": 2}

#: All orders of Euler angles, with the classic tuples (first axis, parity, repetition, frame).
TUPLE2AXES: dict[tuple[int, int, int, int], str] = {}
AXES2TUPLE: dict[str, tuple[int, int, int, int]] = {}


def _order(axes: Any) -> tuple[bool, int, int, int]:
    """True for turning axes, and the three axes."""
    if not isinstance(axes, str):
        axes = TUPLE2AXES[tuple(axes)]
    try:
        frame, first, second, third = axes
        numbers = (_AXES[first], _AXES[second], _AXES[third])
    except (ValueError, KeyError):
        raise ValueError(f"axes must be such as 'sxyz' or 'rzyx', not {axes!r}") from None
    if frame not in "sr" or numbers[0] == numbers[1] or numbers[1] == numbers[2]:
        raise ValueError(f"axes must be such as 'sxyz' or 'rzyx', not {axes!r}")
    return (frame == "r", *numbers)


def _fill_tables() -> None:
    # The classic first axis is that of the static order; turning axes are static ones read backwards.
    for frame in "sr":
        for name in ("xyz", "xyx", "xzy", "xzx", "yzx", "yzy", "yxz", "yxy", "zxy", "zxz", "zyx", "zyz"):
            static = name if frame == "s" else name[::-1]
            first, second = _AXES[static[0]], _AXES[static[1]]
            key = (first, int((second - first) % 3 != 1), int(static[0] == static[2]), int(frame == "r"))
            TUPLE2AXES[key] = frame + name
            AXES2TUPLE[frame + name] = key


_fill_tables()


# ---- quaternions


def quaternion_multiply(quaternion1: Any, quaternion0: Any) -> Any:
    """Rotation by `quaternion0`, then by `quaternion1`."""
    x0, y0, z0, w0 = quaternion0
    x1, y1, z1, w1 = quaternion1
    return np.array(
        (
            x1 * w0 + y1 * z0 - z1 * y0 + w1 * x0,
            -x1 * z0 + y1 * w0 + z1 * x0 + w1 * y0,
            x1 * y0 - y1 * x0 + z1 * w0 + w1 * z0,
            -x1 * x0 - y1 * y0 - z1 * z0 + w1 * w0,
        ),
        dtype=np.float64,
    )


def quaternion_conjugate(quaternion: Any) -> Any:
    """Quaternion with the opposite axis."""
    x, y, z, w = quaternion
    return np.array((-x, -y, -z, w), dtype=np.float64)


def quaternion_inverse(quaternion: Any) -> Any:
    """Inverse of a quaternion."""
    return quaternion_conjugate(quaternion) / np.dot(quaternion, quaternion)


def quaternion_about_axis(angle: float, axis: Any) -> Any:
    """Rotation by an angle about an axis."""
    length = math.sqrt(sum(float(one) ** 2 for one in axis))
    factor = math.sin(angle / 2.0) / length if length > _EPSILON else 0.0
    return np.array((*(float(one) * factor for one in axis), math.cos(angle / 2.0)))


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Any = "sxyz") -> Any:
    """Quaternion (x, y, z, w) of Euler angles."""
    if axes == "sxyz":
        ci, si = math.cos(ai / 2.0), math.sin(ai / 2.0)
        cj, sj = math.cos(aj / 2.0), math.sin(aj / 2.0)
        ck, sk = math.cos(ak / 2.0), math.sin(ak / 2.0)
        return np.array(
            (
                si * cj * ck - ci * sj * sk,
                ci * sj * ck + si * cj * sk,
                ci * cj * sk - si * sj * ck,
                ci * cj * ck + si * sj * sk,
            )
        )
    turning, *numbers = _order(axes)
    made = np.array((0.0, 0.0, 0.0, 1.0))
    for number, angle in zip(numbers, (ai, aj, ak)):
        one = np.zeros(4)
        one[number], one[3] = math.sin(angle / 2.0), math.cos(angle / 2.0)
        made = quaternion_multiply(made, one) if turning else quaternion_multiply(one, made)
    return made


def euler_from_quaternion(quaternion: Any, axes: Any = "sxyz") -> tuple[float, float, float]:
    """Euler angles of a quaternion (x, y, z, w)."""
    return euler_from_matrix(_rotation_of(quaternion), axes)


def _rotation_of(quaternion: Any) -> list[list[float]]:
    x, y, z, w = (float(one) for one in quaternion)
    norm = x * x + y * y + z * z + w * w
    if norm < _EPSILON:
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    s = 2.0 / norm
    return [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ]


def quaternion_matrix(quaternion: Any) -> Any:
    """Homogeneous rotation matrix of a quaternion."""
    made = np.identity(4)
    made[:3, :3] = _rotation_of(quaternion)
    return made


def quaternion_from_matrix(matrix: Any) -> Any:
    """Quaternion (x, y, z, w) of a rotation matrix (3 x 3 or homogeneous)."""
    m = np.asarray(matrix, dtype=np.float64)[:3, :3]
    # The eigenvector of the largest eigenvalue: also right for matrices that are not quite rotations.
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]],
        ]
    )
    values, vectors = np.linalg.eigh(k / 3.0)
    made = vectors[:, np.argmax(values)]
    return -made if made[3] < 0.0 else made


def quaternion_slerp(quat0: Any, quat1: Any, fraction: float, spin: int = 0, shortestpath: bool = True) -> Any:
    """Rotation at a fraction of the way from one quaternion to another."""
    start, end = unit_vector(np.asarray(quat0)[:4]), unit_vector(np.asarray(quat1)[:4])
    if fraction in (0.0, 1.0):
        return start if fraction == 0.0 else end
    cosine = float(np.dot(start, end))
    if abs(abs(cosine) - 1.0) < _EPSILON:
        return start
    if shortestpath and cosine < 0.0:
        cosine, end = -cosine, -end
    angle = math.acos(max(-1.0, min(1.0, cosine))) + spin * math.pi
    if abs(angle) < _EPSILON:
        return start
    return (math.sin((1.0 - fraction) * angle) * start + math.sin(fraction * angle) * end) / math.sin(angle)


def random_quaternion(rand: Any = None) -> Any:
    """Uniformly random rotation, from three numbers in 0 to 1 if they are given."""
    a, b, c = np.random.rand(3) if rand is None else rand
    low, high = math.sqrt(1.0 - a), math.sqrt(a)
    first, second = 2.0 * math.pi * b, 2.0 * math.pi * c
    return np.array((math.sin(first) * low, math.cos(first) * low, math.sin(second) * high, math.cos(second) * high))


def random_rotation_matrix(rand: Any = None) -> Any:
    """Uniformly random rotation matrix."""
    return quaternion_matrix(random_quaternion(rand))


# ---- Euler angles and matrices


def euler_matrix(ai: float, aj: float, ak: float, axes: Any = "sxyz") -> Any:
    """Homogeneous rotation matrix of Euler angles."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: Any, axes: Any = "sxyz") -> tuple[float, float, float]:
    """Euler angles of a rotation matrix (3 x 3 or homogeneous)."""
    m = matrix
    turning, a, b, c = _order(axes)
    if turning:
        a, c = c, a
    if a != c:
        sign = 1.0 if (b - a) % 3 == 1 else -1.0
        cosine = math.hypot(m[a][a], m[b][a])
        second = math.atan2(-sign * m[c][a], cosine)
        if cosine > _EPSILON:
            first, third = math.atan2(sign * m[c][b], m[c][c]), math.atan2(sign * m[b][a], m[a][a])
        else:
            first, third = math.atan2(-sign * m[b][c], m[b][b]), 0.0
    else:
        d = 3 - a - b
        sign = 1.0 if (b - a) % 3 == 1 else -1.0
        sine = math.hypot(m[a][b], m[a][d])
        second = math.atan2(sine, m[a][a])
        if sine > _EPSILON:
            first, third = math.atan2(m[a][b], sign * m[a][d]), math.atan2(m[b][a], -sign * m[d][a])
        else:
            first, third = math.atan2(-sign * m[b][d], m[b][b]), 0.0
    return (third, second, first) if turning else (first, second, third)


def identity_matrix() -> Any:
    """Homogeneous identity."""
    return np.identity(4)


def translation_matrix(direction: Any) -> Any:
    """Homogeneous matrix that moves by a vector."""
    made = np.identity(4)
    made[:3, 3] = direction[:3]
    return made


def translation_from_matrix(matrix: Any) -> Any:
    """Vector by which a homogeneous matrix moves."""
    return np.array(matrix)[:3, 3].copy()


def rotation_matrix(angle: float, direction: Any, point: Any = None) -> Any:
    """Rotation by an angle about an axis, through a point if one is given."""
    made = quaternion_matrix(quaternion_about_axis(angle, direction[:3]))
    if point is not None:
        center = np.asarray(point[:3], dtype=np.float64)
        made[:3, 3] = center - made[:3, :3] @ center
    return made


def rotation_from_matrix(matrix: Any) -> tuple[float, Any, Any]:
    """Angle, axis and a point on the axis of a rotation."""
    m = np.asarray(matrix, dtype=np.float64)
    x, y, z, w = quaternion_from_matrix(m)
    length = math.sqrt(x * x + y * y + z * z)
    direction = np.array((x, y, z)) / length if length > _EPSILON else np.array((0.0, 0.0, 1.0))
    point = np.append(np.linalg.pinv(np.identity(3) - m[:3, :3]) @ m[:3, 3], 1.0)
    return 2.0 * math.atan2(length, w), direction, point


def reflection_matrix(point: Any, normal: Any) -> Any:
    """Reflection at a plane."""
    unit = unit_vector(np.asarray(normal[:3], dtype=np.float64))
    made = np.identity(4)
    made[:3, :3] -= 2.0 * np.outer(unit, unit)
    made[:3, 3] = 2.0 * np.dot(point[:3], unit) * unit
    return made


def reflection_from_matrix(matrix: Any) -> tuple[Any, Any]:
    """Point and normal of the plane of a reflection."""
    m = np.asarray(matrix, dtype=np.float64)
    normal = _eigenvector(m[:3, :3], -1.0, "a reflection")
    # The plane is half way to where the origin goes.
    return np.append(m[:3, 3] / (2.0 * m[3, 3]), 1.0), normal


def _eigenvector(matrix: Any, value: float, what: str) -> Any:
    values, vectors = np.linalg.eig(matrix)
    index = int(np.argmin(np.abs(values - value)))
    if abs(values[index] - value) > 1e-6:
        raise ValueError(f"the matrix is not that of {what}")
    return np.real(vectors[:, index])


def scale_from_matrix(matrix: Any) -> tuple[float, Any, Any]:
    """Factor, origin and direction (None for all directions) of a scale."""
    m = np.asarray(matrix, dtype=np.float64)
    linear, factor = m[:3, :3], float(np.trace(m[:3, :3]) - 2.0)
    direction = None
    if np.allclose(linear, linear[0, 0] * np.identity(3)):
        factor = float(linear[0, 0])
    else:
        direction = _eigenvector(linear, factor, "a scale")
    origin = np.linalg.pinv(np.identity(3) - linear) @ m[:3, 3]
    return factor, np.append(origin, 1.0), direction


def scale_matrix(factor: float, origin: Any = None, direction: Any = None) -> Any:
    """Scale by a factor, about an origin, along a direction if one is given."""
    made = np.identity(4)
    if direction is None:
        made[:3, :3] *= factor
    else:
        unit = unit_vector(np.asarray(direction[:3], dtype=np.float64))
        made[:3, :3] -= (1.0 - factor) * np.outer(unit, unit)
    if origin is not None:
        center = np.asarray(origin[:3], dtype=np.float64)
        made[:3, 3] = center - made[:3, :3] @ center
    return made


def shear_matrix(angle: float, direction: Any, point: Any, normal: Any) -> Any:
    """Shear by an angle along a direction on a plane."""
    normal, direction = unit_vector(np.asarray(normal[:3])), unit_vector(np.asarray(direction[:3]))
    if abs(np.dot(normal, direction)) > 1e-6:
        raise ValueError("the direction and the normal of a shear must be perpendicular")
    made = np.identity(4)
    made[:3, :3] += math.tan(angle) * np.outer(direction, normal)
    made[:3, 3] = -math.tan(angle) * np.dot(point[:3], normal) * direction
    return made


def shear_from_matrix(matrix: Any) -> tuple[float, Any, Any, Any]:
    """Angle, direction, point and normal of a shear."""
    m = np.asarray(matrix, dtype=np.float64)
    change = m[:3, :3] - np.identity(3)
    u, sizes, vt = np.linalg.svd(change)
    direction, normal = u[:, 0], vt[0]
    if sizes[0] < 1e-12 or sizes[1] > 1e-6 * sizes[0] or abs(np.dot(direction, normal)) > 1e-6:
        raise ValueError("the matrix is not that of a shear")
    point = np.append(-normal * np.dot(direction, m[:3, 3]) / sizes[0], 1.0)
    return math.atan(sizes[0]), direction, point, normal


def projection_from_matrix(matrix: Any, pseudo: bool = False) -> tuple[Any, Any, Any, Any, bool]:
    """Point, normal, direction, perspective and `pseudo` of a projection."""
    m = np.asarray(matrix, dtype=np.float64)
    values, vectors = np.linalg.eig(m)
    fixed = np.flatnonzero(np.abs(values - 1.0) < 1e-8)
    if not pseudo and len(fixed) and np.abs(m[3, :3]).max() < 1e-12:
        point = np.real(vectors[:, fixed[-1]])
        direction = _eigenvector(m[:3, :3], 0.0, "a projection")
        rows, columns = np.linalg.eig(m[:3, :3].T)
        index = int(np.argmin(np.abs(rows)))
        return point / point[3], np.real(columns[:, index]), direction, None, False
    solid = np.flatnonzero(np.abs(values) > 1e-8)
    if not len(solid):
        raise ValueError("the matrix is not that of a projection")
    point = np.real(vectors[:, solid[-1]])
    normal = -m[3, :3]
    perspective = m[:3, 3] / np.dot(point[:3] / point[3], normal)
    if pseudo:
        perspective = perspective - normal
    return point / point[3], normal, None, perspective, pseudo


def orthogonalization_matrix(lengths: Any, angles: Any) -> Any:
    """Matrix from the axes of a crystal (lengths, angles in degrees) to right-angled ones."""
    a, b, c = lengths
    cosines, sines = np.cos(np.radians(angles)), np.sin(np.radians(angles))
    shared = (cosines[0] * cosines[1] - cosines[2]) / (sines[0] * sines[1])
    made = np.identity(4)
    made[0, 0] = a * sines[1] * math.sqrt(1.0 - shared * shared)
    made[1, 0], made[1, 1] = -a * sines[1] * shared, b * sines[0]
    made[2, :3] = a * cosines[1], b * cosines[0], c
    return made


def projection_matrix(point: Any, normal: Any, direction: Any = None, perspective: Any = None, pseudo: bool = False) -> Any:
    """Projection on a plane: orthogonal, along a direction, or from a point."""
    made = np.identity(4)
    center = np.asarray(point[:3], dtype=np.float64)
    normal = unit_vector(np.asarray(normal[:3], dtype=np.float64))
    if perspective is not None:
        eye = np.asarray(perspective[:3], dtype=np.float64)
        distance = float(np.dot(eye - center, normal))
        made[:3, :3] = distance * np.identity(3) - np.outer(eye, normal)
        made[:3, 3] = np.dot(center, normal) * eye
        if pseudo:
            made[:3, :3] -= np.outer(normal, normal)
            made[:3, 3] += np.dot(center, normal) * normal
        made[3, :3] = -normal
        made[3, 3] = np.dot(eye, normal)
        return made
    along = normal if direction is None else np.asarray(direction[:3], dtype=np.float64)
    made[:3, :3] -= np.outer(along, normal) / np.dot(along, normal)
    made[:3, 3] = along * (np.dot(center, normal) / np.dot(along, normal))
    return made


def compose_matrix(
    scale: Any = None, shear: Any = None, angles: Any = None, translate: Any = None, perspective: Any = None
) -> Any:
    """Matrix of a scale, a shear, Euler angles (sxyz), a translation and a perspective."""
    made = np.identity(4)
    if perspective is not None:
        made[3, :] = perspective[:4]
    if translate is not None:
        made = made @ translation_matrix(translate)
    if angles is not None:
        made = made @ euler_matrix(*angles)
    if shear is not None:
        part = np.identity(4)
        part[0, 1], part[0, 2], part[1, 2] = shear
        made = made @ part
    if scale is not None:
        made = made @ np.diag((*scale, 1.0))
    return made / made[3, 3]


def decompose_matrix(matrix: Any) -> tuple[Any, list[float], list[float], Any, Any]:
    """Scale, shear, Euler angles (sxyz), translation and perspective of a matrix."""
    m = np.array(matrix, dtype=np.float64)
    if abs(m[3, 3]) < _EPSILON:
        raise ValueError("the last element of the matrix must not be 0")
    m /= m[3, 3]
    linear = m.copy()
    linear[3, :] = (0.0, 0.0, 0.0, 1.0)
    if not np.linalg.det(linear):
        raise ValueError("the matrix is singular")
    perspective = np.array((0.0, 0.0, 0.0, 1.0))
    if np.any(np.abs(m[3, :3]) > _EPSILON):
        perspective = m[3, :] @ np.linalg.inv(linear)
    rotation, upper = np.linalg.qr(linear[:3, :3])
    signs = np.sign(np.diag(upper))
    rotation, upper = rotation * signs, (upper.T * signs).T
    if np.linalg.det(rotation) < 0.0:
        rotation, upper = -rotation, -upper
    scale = np.diag(upper).copy()
    shear = [upper[0, 1] / scale[1], upper[0, 2] / scale[2], upper[1, 2] / scale[2]]
    return scale, shear, list(euler_from_matrix(rotation)), linear[:3, 3].copy(), perspective


def clip_matrix(
    left: float, right: float, bottom: float, top: float, near: float, far: float, perspective: bool = False
) -> Any:
    """Matrix from view coordinates to normalized device coordinates."""
    if left >= right or bottom >= top or near >= far:
        raise ValueError("the frustum is empty")
    width, height, depth = right - left, top - bottom, far - near
    if perspective:
        if near <= _EPSILON:
            raise ValueError("near must be positive")
        return np.array(
            (
                (-2.0 * near / width, 0.0, (right + left) / width, 0.0),
                (0.0, -2.0 * near / height, (top + bottom) / height, 0.0),
                (0.0, 0.0, -(far + near) / depth, 2.0 * far * near / depth),
                (0.0, 0.0, -1.0, 0.0),
            )
        )
    return np.array(
        (
            (2.0 / width, 0.0, 0.0, -(right + left) / width),
            (0.0, 2.0 / height, 0.0, -(top + bottom) / height),
            (0.0, 0.0, 2.0 / depth, -(far + near) / depth),
            (0.0, 0.0, 0.0, 1.0),
        )
    )


def superimposition_matrix(v0: Any, v1: Any, scaling: bool = False, usesvd: bool = True) -> Any:
    """Rotation and translation (and scale) that fits points `v0` (columns) to `v1` best."""
    first, second = np.asarray(v0, dtype=np.float64)[:3], np.asarray(v1, dtype=np.float64)[:3]
    c0, c1 = first.mean(axis=1), second.mean(axis=1)
    d0, d1 = first - c0[:, None], second - c1[:, None]
    u, _, vt = np.linalg.svd(d1 @ d0.T)
    flip = np.diag((1.0, 1.0, np.sign(np.linalg.det(u @ vt))))
    made = np.identity(4)
    made[:3, :3] = u @ flip @ vt
    if scaling:
        made[:3, :3] *= math.sqrt(np.sum(d1 * d1) / np.sum(d0 * d0))
    made[:3, 3] = c1 - made[:3, :3] @ c0
    return made


def concatenate_matrices(*matrices: Any) -> Any:
    """Product of matrices."""
    made = np.identity(4)
    for one in matrices:
        made = made @ one
    return made


def inverse_matrix(matrix: Any) -> Any:
    """Inverse of a matrix."""
    return np.linalg.inv(matrix)


def is_same_transform(matrix0: Any, matrix1: Any) -> bool:
    """True if two homogeneous matrices are the same transform."""
    first, second = np.array(matrix0, dtype=np.float64), np.array(matrix1, dtype=np.float64)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))


# ---- vectors


def vector_norm(data: Any, axis: int | None = None, out: Any = None) -> Any:
    """Length of a vector, or lengths along an axis."""
    made = np.linalg.norm(np.asarray(data, dtype=np.float64), axis=axis)
    if out is None:
        return made
    out[...] = made
    return None


def unit_vector(data: Any, axis: int | None = None, out: Any = None) -> Any:
    """Vector of length 1, or vectors along an axis."""
    values = np.array(data, dtype=np.float64)
    made = values / np.linalg.norm(values, axis=axis, keepdims=axis is not None)
    if out is None:
        return made
    out[...] = made
    return None


def random_vector(size: Any) -> Any:
    """Uniformly random numbers in 0 to 1."""
    return np.random.random(size)
