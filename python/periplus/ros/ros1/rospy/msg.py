"""Messages between programs and the native module."""

from __future__ import annotations

import io
from typing import Any, ClassVar

import genpy
from genpy import Message


class AnyMsg(Message):
    """Message of any type: `_buff` has its bytes in the format of ROS 1, `_connection_header` its type."""

    __slots__ = ("_buff",)
    _type: ClassVar[str] = "*"
    _md5sum: ClassVar[str] = "*"
    _full_text: ClassVar[str] = ""
    _slot_types: ClassVar[list[str]] = []

    def __init__(self, *args: Any) -> None:
        if args:
            raise TypeError("AnyMsg does not accept arguments")
        self._buff = b""

    def serialize(self, buff: io.BytesIO) -> None:
        buff.write(self._buff)

    def deserialize(self, data: bytes) -> AnyMsg:
        self._buff = bytes(data)
        return self

    def __str__(self) -> str:
        return f"<{len(self._buff)} bytes>"


AnyMsg.__slots__ = ()


def args_kwds_to_message(data_class: Any, args: tuple[Any, ...], kwds: dict[str, Any]) -> Any:
    """Message that the arguments of `publish()`, or of a service call, stand for."""
    if args and kwds:
        raise TypeError("publish() can be called with arguments or keywords, but not both.")
    if kwds:
        return data_class(**kwds)
    if len(args) == 1:
        one = args[0]
        if isinstance(one, data_class):
            return one
        if isinstance(one, Message):
            if type(one)._type == data_class._type:
                return one
            # A message with a single field of that message's type.
            if data_class._slot_types != [type(one)._type]:
                raise TypeError(f"expected [{data_class._type}] but got [{type(one)._type}]")
    return data_class(*args)


def ready_to_publish(message: Any) -> Any:
    """The message itself, or one that the native module knows for an `AnyMsg`."""
    if isinstance(message, AnyMsg):
        header = getattr(message, "_connection_header", None) or {}
        cls = genpy.get_message_class(header.get("type", ""))
        if cls is None:
            raise TypeError("an AnyMsg can be published only if it was received")
        return cls().deserialize(message._buff)
    return message


def received(message: Any, data_class: Any, header: dict[str, str]) -> Any:
    """The native message as an object of the class that the subscriber asked for."""
    if type(message) is not data_class:
        from periplus.ros._genpy import as_class

        if issubclass(data_class, AnyMsg):
            found = data_class()
            buffer = io.BytesIO()
            cls = genpy.get_message_class(header["type"])
            if cls is not None:
                as_class(message, cls).serialize(buffer)
            found._buff = buffer.getvalue()
            message = found
        elif data_class.__bases__ == (type(message),):
            message.__class__ = data_class
        else:
            message = as_class(message, data_class)
    message._connection_header = header
    return message


def serialize_message(b: io.BytesIO, seq: int, msg: Message) -> None:
    """Appends a message with its length, as it stands on a ROS 1 connection."""
    buffer = io.BytesIO()
    msg.serialize(buffer)
    data = buffer.getvalue()
    b.write(len(data).to_bytes(4, "little") + data)
