"""Durations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.constants import S_TO_NS

if TYPE_CHECKING:
    from builtin_interfaces.msg import Duration as DurationMessage

_LIMIT_NS = 2**63


class Duration:
    """Signed duration with 64 bits of nanoseconds. Durations can be compared, not added."""

    __slots__ = ("_nanoseconds", "__weakref__")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, *, seconds: int | float = 0, nanoseconds: int = 0) -> None:
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -_LIMIT_NS <= total < _LIMIT_NS:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The whole duration [ns]."""
        return self._nanoseconds

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self._nanoseconds})"

    def __str__(self) -> str:
        if self._nanoseconds == _LIMIT_NS - 1:
            return "Infinite"
        return f"{self._nanoseconds} nanoseconds"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self._nanoseconds == other._nanoseconds

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __lt__(self, other: Any) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds < other._nanoseconds
        return NotImplemented

    def __le__(self, other: Any) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds <= other._nanoseconds
        return NotImplemented

    def __gt__(self, other: Any) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds > other._nanoseconds
        return NotImplemented

    def __ge__(self, other: Any) -> bool:
        if isinstance(other, Duration):
            return self._nanoseconds >= other._nanoseconds
        return NotImplemented

    def to_msg(self) -> DurationMessage:
        """The duration as a message; negative ones have a positive `nanosec`."""
        from builtin_interfaces.msg import Duration as DurationMessage

        sec, nanosec = divmod(self._nanoseconds, S_TO_NS)
        return DurationMessage(sec=sec, nanosec=nanosec)

    @classmethod
    def from_msg(cls, msg: DurationMessage) -> Duration:
        """Duration of a message. Raises `TypeError` for anything else."""
        from builtin_interfaces.msg import Duration as DurationMessage

        if not isinstance(msg, DurationMessage):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)

    def get_c_duration(self) -> Duration:
        """The duration itself: there is no other representation."""
        return self


Infinite = Duration(nanoseconds=_LIMIT_NS - 1)
DeadlineBestAvailable = Duration(nanoseconds=_LIMIT_NS - 2)
LivelinessLeaseDurationeBestAvailable = Duration(nanoseconds=_LIMIT_NS - 2)
