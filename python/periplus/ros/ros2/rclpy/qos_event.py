"""Old name of `rclpy.event_handler`."""

import warnings
from typing import Any

from rclpy.event_handler import *  # noqa: F403
from rclpy.event_handler import QoSEventHandler

__all__ = ["QoSEventHandler"]

warnings.warn("importing 'qos_event' is deprecated; import 'event_handler' instead", stacklevel=2)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
