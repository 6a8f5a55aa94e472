"""Types of message fields, as found in ``SLOT_TYPES`` of message classes."""

from periplus.ros._rosidl_types import *  # noqa: F403
