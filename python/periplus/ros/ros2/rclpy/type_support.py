"""Checks of message and service types."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import NoTypeSupportImportedException

__all__ = [
    "NoTypeSupportImportedException",
    "check_for_type_support",
    "check_is_valid_msg_type",
    "check_is_valid_srv_type",
    "type_name",
]


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Raises `AttributeError` for anything but a message, service or action class."""
    if isinstance(msg_or_srv_type, type) and hasattr(msg_or_srv_type, "__type_name__"):
        return
    if hasattr(msg_or_srv_type, "_md5sum"):
        raise AttributeError(
            f"{msg_or_srv_type!r} is a message class of ROS 1, not of ROS 2: rclpy and rospy cannot be used in one process"
        )
    what = "class" if isinstance(msg_or_srv_type, type) else "value"
    raise AttributeError(
        f"the {what} {msg_or_srv_type!r} has no attribute '_TYPE_SUPPORT': it is no message, service or action type. "
        "Pass the class, as in `from std_msgs.msg import String`"
    )


def wrong_type(expected: type, given: Any) -> str:
    """Text of the `TypeError` for something in place of a message of the class `expected`."""
    if isinstance(given, type):
        return f"Expected {expected}, got a class: a message is made by a call, as in {expected.__name__.replace('_', '.')}()"
    return f"Expected {expected}, got {type(given)}"


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Raises for anything but a message class."""
    check_for_type_support(msg_type)
    if not hasattr(msg_type, "__type_handle__"):
        raise RuntimeError(
            f"The message type provided is not valid ({msg_type}), this might be a service or action"
        )


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Raises for anything but a service class."""
    check_for_type_support(srv_type)
    if not hasattr(srv_type, "Request") or not hasattr(srv_type, "Response"):
        raise RuntimeError(
            f"The service type provided is not valid ({srv_type}), this might be a message or action"
        )


def type_name(cls: Any) -> str:
    """Name of a type, such as `std_msgs/msg/String`."""
    name: str = cls.__type_name__
    return name
