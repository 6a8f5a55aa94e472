"""Messages as bytes of CDR."""

from __future__ import annotations

from typing import Any, TypeVar, cast

from periplus import _native

from rclpy._rclpy_pybind11 import RMWError
from rclpy.type_support import check_for_type_support

_M = TypeVar("_M")


def serialize_message(message: Any) -> bytes:
    """Bytes of a message, with the header of 4 bytes."""
    check_for_type_support(type(message))
    data: bytes = _native.serialize(message)
    return data


def deserialize_message(serialized_message: bytes, message_type: type[_M]) -> _M:
    """Message of bytes. Raises `RMWError` if they are no message of the type."""
    check_for_type_support(message_type)
    if not isinstance(serialized_message, (bytes, bytearray, memoryview)):
        raise TypeError(f"serialized_message must be bytes, not {type(serialized_message).__name__}")
    made: Any
    try:
        made = _native.deserialize(cast(Any, message_type), serialized_message)
    except ValueError as error:
        raise RMWError(f"failed to deserialize ROS message: {error}") from None
    result: _M = made
    return result
