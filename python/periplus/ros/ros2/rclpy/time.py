"""Points in time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.duration import Duration

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time as TimeMessage

_LIMIT_NS = 2**63
_new = object.__new__


class Time:
    """Point in time of one kind of clock. Times of different kinds can be neither compared nor subtracted."""

    __slots__ = ("_nanoseconds", "_clock_type", "__weakref__")
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self, *, seconds: int | float = 0, nanoseconds: int = 0, clock_type: ClockType = ClockType.SYSTEM_TIME
    ) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if total >= _LIMIT_NS:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")
        self._nanoseconds = total
        self._clock_type = clock_type

    @property
    def nanoseconds(self) -> int:
        """The time [ns] since the epoch of its clock."""
        return self._nanoseconds

    @property
    def clock_type(self) -> ClockType:
        """Kind of the clock that the time belongs to."""
        return self._clock_type

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """The time as whole seconds and the rest [ns]."""
        return divmod(self._nanoseconds, S_TO_NS)

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self._nanoseconds}, clock_type={self._clock_type.name})"

    def __add__(self, other: Any) -> Time:
        if isinstance(other, Duration):
            total = self._nanoseconds + other._nanoseconds
            if total >= _LIMIT_NS:
                raise OverflowError("Addition leads to overflow in C storage.")
            if total < 0:
                raise ValueError("Addition leads to negative time.")
            return _make(total, self._clock_type)
        return NotImplemented

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            if self._clock_type is not other._clock_type:
                raise TypeError("Can't subtract times with different clock types")
            return Duration(nanoseconds=self._nanoseconds - other._nanoseconds)
        if isinstance(other, Duration):
            total = self._nanoseconds - other._nanoseconds
            if total < 0:
                raise ValueError("Subtraction leads to negative time.")
            if total >= _LIMIT_NS:
                raise OverflowError("Subtraction leads to overflow in C storage.")
            return _make(total, self._clock_type)
        return NotImplemented

    def _check_kind(self, other: Time) -> None:
        if self._clock_type is not other._clock_type:
            raise TypeError("Can't compare times with different clock types")

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Time):
            self._check_kind(other)
            return self._nanoseconds == other._nanoseconds
        return False

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __lt__(self, other: Any) -> bool:
        if isinstance(other, Time):
            self._check_kind(other)
            return self._nanoseconds < other._nanoseconds
        return NotImplemented

    def __le__(self, other: Any) -> bool:
        if isinstance(other, Time):
            self._check_kind(other)
            return self._nanoseconds <= other._nanoseconds
        return NotImplemented

    def __gt__(self, other: Any) -> bool:
        if isinstance(other, Time):
            self._check_kind(other)
            return self._nanoseconds > other._nanoseconds
        return NotImplemented

    def __ge__(self, other: Any) -> bool:
        if isinstance(other, Time):
            self._check_kind(other)
            return self._nanoseconds >= other._nanoseconds
        return NotImplemented

    def to_msg(self) -> TimeMessage:
        """The time as a message."""
        sec, nanosec = divmod(self._nanoseconds, S_TO_NS)
        return _message_class()(sec=sec, nanosec=nanosec)

    @classmethod
    def from_msg(cls, msg: TimeMessage, clock_type: ClockType = ClockType.ROS_TIME) -> Time:
        """Time of a message. Raises `TypeError` for anything else."""
        if not isinstance(msg, _message_class()):
            raise TypeError("Must pass a builtin_interfaces.msg.Time object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)


_class: Any = None


def _message_class() -> Any:
    global _class
    if _class is None:
        from builtin_interfaces.msg import Time as TimeMessage

        _class = TimeMessage
    return _class


def _make(nanoseconds: int, clock_type: ClockType) -> Time:
    """Time without the checks of the arguments."""
    made = _new(Time)
    made._nanoseconds = nanoseconds
    made._clock_type = clock_type
    return made
