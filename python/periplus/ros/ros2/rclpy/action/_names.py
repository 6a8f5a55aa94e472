"""Topics and services of an action, and checks of its type."""

from __future__ import annotations

import os
from typing import Any

from rclpy.type_support import check_for_type_support, type_name

#: States of a goal, as in action_msgs/msg/GoalStatus.
UNKNOWN, ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(7)

ACTIVE = (ACCEPTED, EXECUTING, CANCELING)


def check_action_type(action_type: Any) -> None:
    """Raises for anything but an action class."""
    check_for_type_support(action_type)
    if not hasattr(action_type, "Goal") or not hasattr(action_type, "Impl"):
        raise RuntimeError(f"The action type provided is not valid ({action_type}), this might be a message or service")


def part_name(action_type: Any, part: str) -> str:
    """Name of the type of a part, such as `pkg/action/Fibonacci_SendGoal`."""
    return f"{type_name(action_type)}_{part}"


def new_uuid() -> Any:
    """A fresh identifier of a goal."""
    from unique_identifier_msgs.msg import UUID

    digits = bytearray(os.urandom(16))
    digits[6] = digits[6] & 0x0F | 0x40
    digits[8] = digits[8] & 0x3F | 0x80
    return UUID(uuid=list(digits))


def key_of(goal_id: Any) -> bytes:
    """Hashable form of the identifier of a goal."""
    return bytes(goal_id.uuid)
