"""Serialization of messages in the format of ROS 1: little endian, no padding, lengths as uint32."""

from __future__ import annotations

import struct
from functools import cache
from typing import Any

_FORMATS = {
    "bool": "?",
    "byte": "b",
    "char": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
_TIMES = {"time": "<II", "duration": "<ii"}
_LENGTH = struct.Struct("<I")


@cache
def _struct(format_text: str) -> struct.Struct:
    return struct.Struct(format_text)


def encode(message: Any) -> bytes:
    """Bytes of a message."""
    out: list[bytes] = []
    try:
        _encode_message(message, out)
    except (struct.error, TypeError, AttributeError, ValueError) as error:
        from genpy.message import SerializationError

        message._check_types()
        raise SerializationError(f"{type(message)._type}: {error}") from error
    return b"".join(out)


def _encode_message(message: Any, out: list[bytes]) -> None:
    for name, type_text in zip(type(message).__slots__, message._slot_types, strict=True):
        _encode_value(getattr(message, name), type_text, out)


def _encode_value(value: Any, type_text: str, out: list[bytes]) -> None:
    code = _FORMATS.get(type_text)
    if code is not None:
        out.append(struct.pack("<" + code, value))
    elif type_text == "string":
        data = value if isinstance(value, bytes) else value.encode("utf-8")
        out.append(_LENGTH.pack(len(data)) + data)
    elif type_text in _TIMES:
        out.append(struct.pack(_TIMES[type_text], value.secs, value.nsecs))
    elif type_text.endswith("]"):
        _encode_array(value, type_text, out)
    else:
        _encode_message(value, out)


def _encode_array(values: Any, type_text: str, out: list[bytes]) -> None:
    base, _, length = type_text[:-1].rpartition("[")
    count = len(values)
    if length and int(length) != count:
        raise ValueError(f"{count} values where {type_text} needs {length}")
    if not length:
        out.append(_LENGTH.pack(count))
    code = _FORMATS.get(base)
    if code is None:
        for value in values:
            _encode_value(value, base, out)
    elif code == "B" and isinstance(values, (bytes, bytearray, memoryview)):
        out.append(bytes(values))
    else:
        out.append(struct.pack(f"<{count}{code}", *values))


def decode(message: Any, data: bytes) -> None:
    """Sets the fields of a message from its bytes."""
    try:
        end = _decode_message(message, memoryview(data), 0)
    except (struct.error, ValueError, IndexError) as error:
        from genpy.message import DeserializationError

        raise DeserializationError(f"{type(message)._type}: {error}") from error
    if end > len(data):
        from genpy.message import DeserializationError

        raise DeserializationError(f"{type(message)._type}: {len(data)} bytes are too few")


def _decode_message(message: Any, data: memoryview, at: int) -> int:
    for name, type_text in zip(type(message).__slots__, message._slot_types, strict=True):
        value, at = _decode_value(type_text, data, at)
        setattr(message, name, value)
    return at


def _decode_value(type_text: str, data: memoryview, at: int) -> tuple[Any, int]:
    code = _FORMATS.get(type_text)
    if code is not None:
        one = _struct("<" + code)
        return one.unpack_from(data, at)[0], at + one.size
    if type_text == "string":
        (length,) = _LENGTH.unpack_from(data, at)
        at += 4
        if at + length > len(data):
            raise ValueError("a string ends behind the last byte")
        raw = bytes(data[at : at + length])
        return raw.decode("utf-8", "replace"), at + length
    if type_text in _TIMES:
        from genpy.rostime import Duration, Time

        secs, nsecs = struct.unpack_from(_TIMES[type_text], data, at)
        return (Time if type_text == "time" else Duration)(secs, nsecs), at + 8
    if type_text.endswith("]"):
        return _decode_array(type_text, data, at)
    from periplus.ros._genpy_types import element_class

    message = element_class(type_text)()
    return message, _decode_message(message, data, at)


def _decode_array(type_text: str, data: memoryview, at: int) -> tuple[Any, int]:
    base, _, length = type_text[:-1].rpartition("[")
    if length:
        count = int(length)
    else:
        (count,) = _LENGTH.unpack_from(data, at)
        at += 4
    code = _FORMATS.get(base)
    if code is None:
        if count > len(data):
            raise ValueError(f"{count} elements in {len(data)} bytes")
        values = []
        for _ in range(count):
            value, at = _decode_value(base, data, at)
            values.append(value)
        return values, at
    size = struct.calcsize("<" + code) * count
    if at + size > len(data):
        raise ValueError(f"{count} elements of {base} end behind the last byte")
    if code == "B":
        return bytes(data[at : at + size]), at + size
    return struct.unpack_from(f"<{count}{code}", data, at), at + size
