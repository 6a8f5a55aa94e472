"""Publishers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.duration import Duration
from rclpy.type_support import wrong_type

if TYPE_CHECKING:
    from rclpy._native import RosPublisher
    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context
    from rclpy.event_handler import PublisherEventCallbacks
    from rclpy.qos import QoSProfile

MsgType = TypeVar("MsgType")


class Publisher:
    """Publishes messages on a topic. `Node.create_publisher` makes it."""

    _context: Context

    def __init__(
        self,
        publisher_impl: RosPublisher,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile,
        event_callbacks: PublisherEventCallbacks,
        callback_group: CallbackGroup,
    ) -> None:
        self._native = publisher_impl
        self._destroyed = False
        self._send = publisher_impl.publish
        self.msg_type = msg_type
        #: Name as the program gave it.
        self.topic = topic
        self.qos_profile = qos_profile
        self.event_handlers = event_callbacks.create_event_handlers(callback_group, self, topic)

    def publish(self, msg: Any) -> None:
        """Publishes a message, or the bytes of one.

        Raises `TypeError` for another type or a wrong value of a field, and `RCLError` after shutdown.
        """
        if not self._context._valid or self._destroyed:
            self._check()
            raise RCLError("Failed to publish: publisher's context is invalid")
        if isinstance(msg, self.msg_type):
            self._send(msg)
        elif isinstance(msg, bytes):
            self._native.publish_raw(msg)
        else:
            raise TypeError(wrong_type(self.msg_type, msg))

    def get_subscription_count(self) -> int:
        """Number of subscriptions that the publisher is connected to."""
        self._check()
        return self._native.subscription_count

    @property
    def topic_name(self) -> str:
        """Full name of the topic."""
        self._check()
        return self._native.topic

    @property
    def handle(self) -> Publisher:
        """The publisher itself."""
        return self

    @property
    def logger_name(self) -> str:
        """Name of the logger of the node."""
        self._check()
        return str(getattr(self, "_logger_name", ""))

    def assert_liveliness(self) -> None:
        """Shows that the publisher is alive, for the liveliness `MANUAL_BY_TOPIC`."""
        self._check()
        for handler in self.event_handlers:
            note = getattr(handler, "note", None)
            if note is not None and handler.event_type.name.endswith("LIVELINESS_LOST"):
                note()
        self._native.assert_liveliness()

    def wait_for_all_acked(self, timeout: Duration = Duration(seconds=-1)) -> bool:  # noqa: B008
        """Blocks until all messages have arrived at the reliable subscriptions. Returns False at the timeout."""
        self._check()
        nanoseconds = timeout.nanoseconds
        return self._context._use().flush(nanoseconds if nanoseconds >= 0 else 2**62)

    def destroy(self) -> None:
        """Ends the publisher. `Node.destroy_publisher` does it."""
        if not self._destroyed:
            self._destroyed = True
            self._native.close()

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def __enter__(self) -> Publisher:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        self.destroy()


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
