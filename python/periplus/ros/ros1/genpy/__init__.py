"""Message classes and time values of ROS 1."""

from genpy import message, rostime
from genpy.message import (
    DeserializationError,
    Message,
    MessageException,
    SerializationError,
    check_type,
    fill_message_args,
    get_message_class,
    get_printable_message_args,
    get_service_class,
    strify_message,
)
from genpy.rostime import Duration, Time, TVal

__version__ = "0.6.15"

__all__ = [
    "DeserializationError",
    "Duration",
    "Message",
    "MessageException",
    "SerializationError",
    "TVal",
    "Time",
    "check_type",
    "fill_message_args",
    "get_message_class",
    "get_printable_message_args",
    "get_service_class",
    "message",
    "rostime",
    "strify_message",
]
