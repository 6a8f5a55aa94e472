"""Vectors, rotations and frames with the names of KDL."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, overload


class Vector:
    """Three numbers."""

    __slots__ = ("_v",)

    def __init__(self, x: Any = 0.0, y: float = 0.0, z: float = 0.0) -> None:
        self._v: list[float] = list(x._v) if isinstance(x, Vector) else [float(x), float(y), float(z)]

    @staticmethod
    def Zero() -> Vector:  # noqa: N802
        return Vector()

    def x(self, value: float | None = None) -> float:
        return self._item(0, value)

    def y(self, value: float | None = None) -> float:
        return self._item(1, value)

    def z(self, value: float | None = None) -> float:
        return self._item(2, value)

    def _item(self, index: int, value: float | None) -> float:
        if value is not None:
            self._v[index] = float(value)
        return self._v[index]

    def __getitem__(self, index: int) -> float:
        return self._v[index]

    def __setitem__(self, index: int, value: float) -> None:
        self._v[index] = float(value)

    def __len__(self) -> int:
        return 3

    def __iter__(self) -> Iterator[float]:
        return iter(self._v)

    def Norm(self) -> float:  # noqa: N802
        """Length."""
        return math.sqrt(dot(self, self))

    def Normalize(self) -> float:  # noqa: N802
        """Makes the length 1; returns what it was."""
        norm = self.Norm()
        self._v = [one / norm for one in self._v] if norm > 1e-12 else [1.0, 0.0, 0.0]
        return norm

    def __add__(self, other: Vector) -> Vector:
        return Vector(*(a + b for a, b in zip(self._v, other._v)))

    def __sub__(self, other: Vector) -> Vector:
        return Vector(*(a - b for a, b in zip(self._v, other._v)))

    def __neg__(self) -> Vector:
        return Vector(*(-one for one in self._v))

    def __mul__(self, other: Any) -> Vector:
        if isinstance(other, Vector):
            (a, b, c), (d, e, f) = self._v, other._v
            return Vector(b * f - c * e, c * d - a * f, a * e - b * d)
        return Vector(*(one * other for one in self._v))

    def __rmul__(self, other: float) -> Vector:
        return self * other

    def __truediv__(self, other: float) -> Vector:
        return Vector(*(one / other for one in self._v))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Vector) and self._v == other._v

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return "[" + ",".join(f"{one:12g}" for one in self._v) + "]"


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return sum(one * two for one, two in zip(a._v, b._v))


class Rotation:
    """Rotation matrix; nine numbers, row by row."""

    __slots__ = ("_m",)

    def __init__(self, *values: Any) -> None:
        if len(values) == 9:
            self._m = [[float(one) for one in values[3 * row : 3 * row + 3]] for row in range(3)]
        elif len(values) == 3:
            self._m = [[values[column][row] for column in range(3)] for row in range(3)]
        elif len(values) == 1:
            self._m = [list(row) for row in values[0]._m]
        else:
            self._m = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]

    @staticmethod
    def Identity() -> Rotation:  # noqa: N802
        return Rotation()

    @staticmethod
    def Quaternion(x: float, y: float, z: float, w: float) -> Rotation:  # noqa: N802
        """Rotation of a quaternion of length 1."""
        return Rotation(
            1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
            2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
            2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
        )  # fmt: skip

    @staticmethod
    def RPY(roll: float, pitch: float, yaw: float) -> Rotation:  # noqa: N802
        """Rotation about x, then y, then z, of fixed axes."""
        return Rotation.RotZ(yaw) * Rotation.RotY(pitch) * Rotation.RotX(roll)

    @staticmethod
    def EulerZYX(alfa: float, beta: float, gamma: float) -> Rotation:  # noqa: N802
        return Rotation.RPY(gamma, beta, alfa)

    @staticmethod
    def EulerZYZ(alfa: float, beta: float, gamma: float) -> Rotation:  # noqa: N802
        return Rotation.RotZ(alfa) * Rotation.RotY(beta) * Rotation.RotZ(gamma)

    @staticmethod
    def RotX(angle: float) -> Rotation:  # noqa: N802
        c, s = math.cos(angle), math.sin(angle)
        return Rotation(1, 0, 0, 0, c, -s, 0, s, c)

    @staticmethod
    def RotY(angle: float) -> Rotation:  # noqa: N802
        c, s = math.cos(angle), math.sin(angle)
        return Rotation(c, 0, s, 0, 1, 0, -s, 0, c)

    @staticmethod
    def RotZ(angle: float) -> Rotation:  # noqa: N802
        c, s = math.cos(angle), math.sin(angle)
        return Rotation(c, -s, 0, s, c, 0, 0, 0, 1)

    @staticmethod
    def Rot(axis: Vector, angle: float) -> Rotation:  # noqa: N802
        """Rotation about an axis."""
        unit = axis / axis.Norm()
        half = math.sin(angle / 2)
        return Rotation.Quaternion(unit[0] * half, unit[1] * half, unit[2] * half, math.cos(angle / 2))

    def GetRPY(self) -> tuple[float, float, float]:  # noqa: N802
        """Roll, pitch and yaw."""
        m = self._m
        pitch = math.atan2(-m[2][0], math.hypot(m[0][0], m[1][0]))
        if abs(abs(pitch) - math.pi / 2) < 1e-12:
            return 0.0, pitch, math.atan2(-m[0][1], m[1][1])
        return math.atan2(m[2][1], m[2][2]), pitch, math.atan2(m[1][0], m[0][0])

    def GetEulerZYX(self) -> tuple[float, float, float]:  # noqa: N802
        roll, pitch, yaw = self.GetRPY()
        return yaw, pitch, roll

    def GetQuaternion(self) -> tuple[float, float, float, float]:  # noqa: N802
        """Quaternion x, y, z, w."""
        m = self._m
        trace = m[0][0] + m[1][1] + m[2][2]
        if trace > 1e-12:
            s = 0.5 / math.sqrt(trace + 1.0)
            return (m[2][1] - m[1][2]) * s, (m[0][2] - m[2][0]) * s, (m[1][0] - m[0][1]) * s, 0.25 / s
        i = max(range(3), key=lambda axis: m[axis][axis])
        j, k = (i + 1) % 3, (i + 2) % 3
        s = 2.0 * math.sqrt(max(0.0, 1.0 + m[i][i] - m[j][j] - m[k][k]))
        q = [0.0, 0.0, 0.0]
        q[i], q[j], q[k] = 0.25 * s, (m[i][j] + m[j][i]) / s, (m[i][k] + m[k][i]) / s
        return q[0], q[1], q[2], (m[k][j] - m[j][k]) / s

    def GetRotAngle(self) -> tuple[float, Vector]:  # noqa: N802
        """Angle and axis."""
        x, y, z, w = self.GetQuaternion()
        length = math.sqrt(x * x + y * y + z * z)
        if length < 1e-12:
            return 0.0, Vector(0, 0, 1)
        angle = 2 * math.atan2(length, w)
        axis = Vector(x, y, z) / length
        return (angle, axis) if angle <= math.pi else (2 * math.pi - angle, -axis)

    def GetRot(self) -> Vector:  # noqa: N802
        """Axis times angle."""
        angle, axis = self.GetRotAngle()
        return axis * angle

    def Inverse(self) -> Rotation:  # noqa: N802
        return Rotation(*(self._m[column][row] for row in range(3) for column in range(3)))

    def UnitX(self) -> Vector:  # noqa: N802
        return Vector(*(row[0] for row in self._m))

    def UnitY(self) -> Vector:  # noqa: N802
        return Vector(*(row[1] for row in self._m))

    def UnitZ(self) -> Vector:  # noqa: N802
        return Vector(*(row[2] for row in self._m))

    def DoRotZ(self, angle: float) -> None:  # noqa: N802
        self._m = (self * Rotation.RotZ(angle))._m

    @overload
    def __mul__(self, other: Rotation) -> Rotation: ...
    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    def __mul__(self, other: Rotation | Vector) -> Rotation | Vector:
        if isinstance(other, Vector):
            return Vector(*(sum(a * b for a, b in zip(row, other._v)) for row in self._m))
        columns = list(zip(*other._m))
        return Rotation(*(sum(a * b for a, b in zip(row, column)) for row in self._m for column in columns))

    def __getitem__(self, place: tuple[int, int]) -> float:
        return self._m[place[0]][place[1]]

    def __setitem__(self, place: tuple[int, int], value: float) -> None:
        self._m[place[0]][place[1]] = float(value)

    def __repr__(self) -> str:
        return "[" + ";\n ".join(",".join(f"{one:12g}" for one in row) for row in self._m) + "]"


class Frame:
    """Rotation `M` and position `p`."""

    __slots__ = ("M", "p")

    def __init__(self, *values: Any) -> None:
        self.M, self.p = Rotation(), Vector()
        for one in values:
            if isinstance(one, Frame):
                self.M, self.p = Rotation(one.M), Vector(one.p)
            elif isinstance(one, Rotation):
                self.M = Rotation(one)
            elif isinstance(one, Vector):
                self.p = Vector(one)
            else:
                raise TypeError(f"a Frame is made of a Rotation and a Vector, not of {type(one).__name__}")

    @staticmethod
    def Identity() -> Frame:  # noqa: N802
        return Frame()

    def Inverse(self) -> Frame:  # noqa: N802
        inverse = self.M.Inverse()
        return Frame(inverse, -(inverse * self.p))

    @overload
    def __mul__(self, other: Frame) -> Frame: ...
    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    def __mul__(self, other: Frame | Vector) -> Frame | Vector:
        if isinstance(other, Vector):
            return self.M * other + self.p
        return Frame(self.M * other.M, self.M * other.p + self.p)

    def __getitem__(self, place: tuple[int, int]) -> float:
        row, column = place
        return self.p[row] if column == 3 else self.M[row, column]

    def __repr__(self) -> str:
        return f"[{self.M!r}\n {self.p!r}]"
