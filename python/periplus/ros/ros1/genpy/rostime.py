"""Time and duration values of ROS 1: seconds and nanoseconds as integers."""

from __future__ import annotations

from typing import Any, ClassVar

_NS_PER_S = 1_000_000_000


class TVal:
    """Base of `Time` and `Duration`: `secs` and `nsecs`, with 0 <= nsecs < 10**9."""

    # Slots of the native message builder; `secs` and `nsecs` are the names of ROS 1 for the same storage.
    __slots__ = ("_nanosec", "_sec")
    __type_handle__: ClassVar[Any] = None

    _sec: int
    _nanosec: int
    secs: int
    nsecs: int

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        if isinstance(secs, int) or not isinstance(secs, float) and hasattr(secs, "__index__"):
            self._set(int(secs), int(nsecs))
        elif isinstance(secs, float) or hasattr(secs, "__float__"):
            if nsecs != 0:
                raise ValueError("if secs is a float, nsecs cannot be set")
            whole = int(secs)
            self._set(whole, int((float(secs) - whole) * 1e9))
        else:
            raise TypeError(f"secs must be a number, not {type(secs).__name__}")

    def _set(self, secs: int, nsecs: int) -> None:
        if not 0 <= nsecs < _NS_PER_S:
            carry, nsecs = divmod(nsecs, _NS_PER_S)
            secs += carry
        self._sec = secs
        self._nanosec = nsecs

    @classmethod
    def from_sec(cls, float_secs: float) -> Any:
        """Value of a number of seconds."""
        if isinstance(float_secs, (str, bytes)):
            raise TypeError(f"{cls.__name__}.from_sec() needs a number of seconds, not {float_secs!r}")
        whole = int(float_secs)
        return cls(whole, int((float_secs - whole) * 1e9))

    from_seconds = from_sec

    @classmethod
    def _from_nsec(cls, nsecs: int) -> Any:
        return cls(*divmod(int(nsecs), _NS_PER_S))

    def set(self, secs: int, nsecs: int) -> None:
        """Sets both parts as they are; `canon` brings them into range."""
        self._sec = secs
        self._nanosec = nsecs

    def canon(self) -> None:
        """Brings `nsecs` into 0 to 10**9 - 1."""
        self._set(self.secs, self.nsecs)

    def is_zero(self) -> bool:
        return self.secs == 0 and self.nsecs == 0

    def to_sec(self) -> float:
        """Seconds as a float."""
        return float(self.secs) + float(self.nsecs) / 1e9

    to_seconds = to_sec

    def to_nsec(self) -> int:
        """Nanoseconds as an integer."""
        return int(self.secs * _NS_PER_S + self.nsecs)

    def __bool__(self) -> bool:
        return not self.is_zero()

    def __hash__(self) -> int:
        return hash((self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"genpy.{type(self).__name__}[{self.to_nsec()}]"

    def _family(self) -> type[TVal]:
        return Time if isinstance(self, Time) else Duration if isinstance(self, Duration) else TVal

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TVal):
            return NotImplemented
        if self._family() is not other._family() and TVal not in (self._family(), other._family()):
            return False
        return self.to_nsec() == other.to_nsec()

    def __ne__(self, other: object) -> bool:
        result = self.__eq__(other)
        return result if result is NotImplemented else not result

    def _compared(self, other: object) -> int | None:
        if not isinstance(other, TVal) or self._family() is not other._family():
            return None
        return self.to_nsec() - other.to_nsec()

    def __lt__(self, other: object) -> bool:
        difference = self._compared(other)
        return NotImplemented if difference is None else difference < 0

    def __le__(self, other: object) -> bool:
        difference = self._compared(other)
        return NotImplemented if difference is None else difference <= 0

    def __gt__(self, other: object) -> bool:
        difference = self._compared(other)
        return NotImplemented if difference is None else difference > 0

    def __ge__(self, other: object) -> bool:
        difference = self._compared(other)
        return NotImplemented if difference is None else difference >= 0


# The names of ROS 1, and those of ROS 2 for code that handles both, are the slots themselves.
for _alias, _slot in (("secs", "_sec"), ("nsecs", "_nanosec"), ("sec", "_sec"), ("nanosec", "_nanosec")):
    setattr(TVal, _alias, getattr(TVal, _slot))


class Time(TVal):
    """Point in time since 1970, or since the start of the simulation.

    >>> Time(1, 500000000) - Time(1)
    genpy.Duration[500000000]
    """

    __slots__ = ()

    def __init__(self, secs: float = 0, nsecs: int = 0) -> None:
        super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError("time values must be positive")

    def to_time(self) -> float:
        """Seconds as `time.time()` has them."""
        return self.to_sec()

    def __add__(self, other: object) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)._from_nsec(self.to_nsec() + other.to_nsec())

    __radd__ = __add__

    def __sub__(self, other: object) -> Any:
        if isinstance(other, Time):
            return self._duration_class()._from_nsec(self.to_nsec() - other.to_nsec())
        if isinstance(other, Duration):
            return type(self)._from_nsec(self.to_nsec() - other.to_nsec())
        return NotImplemented

    @staticmethod
    def _duration_class() -> type[Duration]:
        return Duration


class Duration(TVal):
    """Span of time, which may be negative.

    >>> Duration(2) * 0.25
    genpy.Duration[500000000]
    """

    __slots__ = ()

    def _scaled(self, factor: float) -> Any:
        if isinstance(factor, int):
            return type(self)._from_nsec(self.to_nsec() * factor)
        return type(self)._from_nsec(round(self.to_nsec() * float(factor)))

    def __neg__(self) -> Any:
        return type(self)._from_nsec(-self.to_nsec())

    def __abs__(self) -> Any:
        return type(self)._from_nsec(abs(self.to_nsec()))

    def __add__(self, other: object) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)._from_nsec(self.to_nsec() + other.to_nsec())

    def __sub__(self, other: object) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)._from_nsec(self.to_nsec() - other.to_nsec())

    def __mul__(self, factor: object) -> Any:
        return self._scaled(factor) if _is_number(factor) else NotImplemented  # type: ignore[arg-type]

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Any:
        if isinstance(other, Duration):
            return self.to_nsec() / other.to_nsec()
        if not _is_number(other):
            return NotImplemented
        return type(self)._from_nsec(round(self.to_nsec() / float(other)))  # type: ignore[arg-type]

    def __floordiv__(self, other: object) -> Any:
        if isinstance(other, Duration):
            return self.to_nsec() // other.to_nsec()
        if not _is_number(other):
            return NotImplemented
        if isinstance(other, float):
            return type(self)._from_nsec(int(self.to_nsec() // other))
        return type(self)._from_nsec(self.to_nsec() // int(other))  # type: ignore[call-overload]

    def __mod__(self, other: object) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)._from_nsec(self.to_nsec() % other.to_nsec())

    def __divmod__(self, other: object) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return self // other, self % other


def _is_number(value: object) -> bool:
    return not isinstance(value, TVal) and (hasattr(value, "__float__") or hasattr(value, "__index__"))
