"""Transformation of messages, which other modules register by their types."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.duration import Duration
from std_msgs.msg import Header


class TypeException(Exception):
    """Message type without a registered transformation."""


class NotImplementedException(Exception):
    """Method that a buffer does not have."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class TransformRegistration:
    """Functions that transform messages, by the type of the message."""

    _functions: dict[Any, Callable[..., Any]] = {}

    def add(self, key: Any, callback: Callable[..., Any]) -> None:
        """Registers `callback(message, transform)` for a type."""
        self._functions[key] = callback

    def get(self, key: Any) -> Callable[..., Any]:
        """Function for a type; raises TypeException without one."""
        return _registered(self._functions, key)

    def print_me(self) -> None:
        """Prints the registered functions."""
        print(self._functions)


class ConvertRegistration:
    """Functions that convert messages to other types and back."""

    _from_msg: dict[Any, Callable[..., Any]] = {}
    _to_msg: dict[Any, Callable[..., Any]] = {}
    _convert: dict[Any, Callable[..., Any]] = {}

    def add_from_msg(self, key: Any, callback: Callable[..., Any]) -> None:
        """Registers the conversion from a message to the type `key`."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Callable[..., Any]) -> None:
        """Registers the conversion from the type `key` to a message."""
        self._to_msg[key] = callback

    def add_convert(self, key: Any, callback: Callable[..., Any]) -> None:
        """Registers the conversion for a pair of types."""
        self._convert[key] = callback

    def get_from_msg(self, key: Any) -> Callable[..., Any]:
        """Conversion from a message to the type `key`."""
        return _registered(self._from_msg, key)

    def get_to_msg(self, key: Any) -> Callable[..., Any]:
        """Conversion from the type `key` to a message."""
        return _registered(self._to_msg, key)

    def get_convert(self, key: Any) -> Callable[..., Any]:
        """Conversion for a pair of types."""
        return _registered(self._convert, key)


def _registered(functions: dict[Any, Callable[..., Any]], key: Any) -> Callable[..., Any]:
    try:
        return functions[key]
    except KeyError:
        raise TypeException(f"Type {key} if not loaded or supported{_hint(key)}") from None


def _hint(key: Any) -> str:
    module = str(getattr(key, "__module__", ""))
    if module.startswith("geometry_msgs."):
        return " (import tf2_geometry_msgs first)"
    return " (import tf2_sensor_msgs first)" if module.startswith("sensor_msgs.") else ""


def convert(a: Any, b_type: Any) -> Any:
    """Value of `a` as an object of the type `b_type`."""
    registration = ConvertRegistration()
    both = registration._convert.get((type(a), b_type))
    if both is not None:
        return both(a)
    if isinstance(a, b_type):
        return a
    return registration.get_from_msg(b_type)(registration.get_to_msg(type(a))(a))


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802
    """Object with a header of this time and frame."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class BufferInterface:
    """Base of the buffers: transformation of stamped messages."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(self, object_stamped: Any, target_frame: str, timeout: Any = None, new_type: Any = None) -> Any:
        """Message in `target_frame`, at the time of its own stamp."""
        transform = TransformRegistration().get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout or Duration())
        made = transform(object_stamped, found)
        return made if new_type is None else convert(made, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = None,
        new_type: Any = None,
    ) -> Any:
        """Message in `target_frame` at another time, through a frame that is fixed."""
        transform = TransformRegistration().get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout or Duration()
        )
        made = transform(object_stamped, found)
        return made if new_type is None else convert(made, new_type)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Transform from one frame to another."""
        raise NotImplementedException()

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """Transform from one frame and time to another."""
        raise NotImplementedException()

    def can_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """True if there is a transform."""
        raise NotImplementedException()

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """True if there is a transform between two times."""
        raise NotImplementedException()
