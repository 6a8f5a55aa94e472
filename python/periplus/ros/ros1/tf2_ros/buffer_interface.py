"""Transformation of data types: who can be transformed and converted, and by which function."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import Any

import genpy


class TypeException(Exception):
    """A type that no package has registered."""


class NotImplementedException(Exception):
    """A buffer that cannot do this."""


class TransformRegistration:
    """Functions that apply a transform, by data type."""

    _functions: dict[Any, Callable[..., Any]] = {}

    def add(self, key: Any, callback: Callable[..., Any]) -> None:
        self._functions[key] = callback

    def get(self, key: Any) -> Callable[..., Any]:
        return _registered(self._functions, key)


class ConvertRegistration:
    """Functions that convert between data types."""

    _to_msg: dict[Any, Callable[..., Any]] = {}
    _from_msg: dict[Any, Callable[..., Any]] = {}
    _convert: dict[Any, Callable[..., Any]] = {}

    def add_to_msg(self, key: Any, callback: Callable[..., Any]) -> None:
        self._to_msg[key] = callback

    def add_from_msg(self, key: Any, callback: Callable[..., Any]) -> None:
        self._from_msg[key] = callback

    def add_convert(self, key: Any, callback: Callable[..., Any]) -> None:
        self._convert[key] = callback

    def get_to_msg(self, key: Any) -> Callable[..., Any]:
        return _registered(self._to_msg, key)

    def get_from_msg(self, key: Any) -> Callable[..., Any]:
        return _registered(self._from_msg, key)

    def get_convert(self, key: Any) -> Callable[..., Any]:
        return _registered(self._convert, key)


def _registered(functions: dict[Any, Callable[..., Any]], key: Any) -> Callable[..., Any]:
    try:
        return functions[key]
    except KeyError:
        raise TypeException(
            f"Type {key} is not loaded or supported. import tf2_geometry_msgs registers the types of geometry_msgs"
        ) from None


def convert(a: Any, b_type: Any) -> Any:
    """Copy of `a` as an object of the type `b_type`."""
    if isinstance(a, b_type):
        return deepcopy(a)
    registry = ConvertRegistration()
    try:
        return registry.get_convert((type(a), b_type))(a)
    except TypeException:
        message = a if isinstance(a, genpy.Message) else registry.get_to_msg(type(a))(a)
        return message if isinstance(message, b_type) else registry.get_from_msg(b_type)(message)


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802
    """The object with a header."""
    from std_msgs.msg import Header

    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class BufferInterface:
    """What all buffers can do."""

    registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = None, new_type: Any = None
    ) -> Any:
        """Data with a header, transformed to a frame."""
        timeout = genpy.Duration(0) if timeout is None else timeout
        function = self.registration.get(type(object_stamped))
        header = object_stamped.header
        result = function(object_stamped, self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout))
        return result if new_type is None else convert(result, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = None,
        new_type: Any = None,
    ) -> Any:
        """Data with a header, transformed to a frame at another time."""
        timeout = genpy.Duration(0) if timeout is None else timeout
        function = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        result = function(object_stamped, found)
        return result if new_type is None else convert(result, new_type)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        raise NotImplementedException
