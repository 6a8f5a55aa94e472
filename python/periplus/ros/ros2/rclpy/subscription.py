"""Subscriptions."""

from __future__ import annotations

from enum import Enum
from types import FunctionType, MethodType
from typing import TYPE_CHECKING, Any, TypeVar

from rclpy._rclpy_pybind11 import InvalidHandle

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy._native import RosSubscription
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.qos import QoSProfile

MsgType = TypeVar("MsgType")

_FORMS = (
    "Subscription.__init__(): callback should be either be callable with one argument"
    "(to get only the message) or two (to get message and message info)"
)


class CallbackType(Enum):
    """Arguments of a callback."""

    MessageOnly = 0
    WithMessageInfo = 1


class Subscription:
    """Messages of a topic, for a callback. `Node.create_subscription` makes it."""

    CallbackType = CallbackType

    _kind = "subscription"
    _monitor: Any = None

    def __init__(
        self,
        subscription_impl: RosSubscription,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        raw: bool,
        event_callbacks: SubscriptionEventCallbacks,
    ) -> None:
        self._native = subscription_impl
        self._destroyed = False
        self.msg_type = msg_type
        #: Name as the program gave it.
        self.topic = topic
        self.callback = callback
        self.callback_group = callback_group
        self.qos_profile = qos_profile
        self.raw = raw
        self.event_handlers = event_callbacks.create_event_handlers(callback_group, self, topic)

    # ---- use

    @property
    def callback(self) -> Callable[..., Any]:
        """The callback; with one argument it gets the message, with two also a dictionary about it."""
        return self._callback

    @callback.setter
    def callback(self, value: Callable[..., Any]) -> None:
        self._with_info = _takes_info(value)
        self._callback = value
        self._monitor = None

    @property
    def topic_name(self) -> str:
        """Full name of the topic."""
        self._check()
        return self._native.topic

    @property
    def logger_name(self) -> str:
        """Name of the logger of the node."""
        self._check()
        return str(getattr(self, "_logger_name", ""))

    @property
    def handle(self) -> Subscription:
        """The subscription itself."""
        return self

    def get_publisher_count(self) -> int:
        """Number of publishers that the subscription is connected to."""
        self._check()
        return self._native.publisher_count

    def destroy(self) -> None:
        """Ends the subscription. `Node.destroy_subscription` does it."""
        if not self._destroyed:
            self._destroyed = True
            self._native.close()

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def __enter__(self) -> Subscription:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        self.destroy()

    # ---- for the executor

    def _full_name(self) -> str:
        return self._native.topic

    def _take(self) -> Any:
        if self._destroyed:
            return None
        return self._native.take_raw() if self.raw else self._native.take()

    def _call(self, taken: Any, executor: Any) -> Any:
        if not self._with_info:
            return self._callback(taken[0])
        message, source_ns, received_ns, sent, received = taken
        return self._callback(
            message,
            {
                "source_timestamp": source_ns,
                "received_timestamp": received_ns,
                "publication_sequence_number": sent,
                "reception_sequence_number": received,
            },
        )


def _takes_info(callback: Any) -> bool:
    """True for a callback with two arguments, False for one with one; raises `RuntimeError` for others."""
    function = callback.__func__ if type(callback) is MethodType else callback
    if type(function) is FunctionType and not hasattr(function, "__wrapped__"):
        code = function.__code__
        given = 0 if function is callback else 1
        most = code.co_argcount - given
        least = most - len(function.__defaults__ or ())
        keywords = code.co_kwonlyargcount - len(function.__kwdefaults__ or ())
        if code.co_flags & 0x04:  # *args
            most = 2
        if keywords == 0 and least <= 1 <= most:
            return False
        if keywords == 0 and least <= 2 <= most:
            return True
        raise RuntimeError(_FORMS)
    import inspect

    try:
        signature = inspect.signature(callback)
    except TypeError:
        raise RuntimeError(_FORMS) from None
    except ValueError:  # built-in without a signature
        return False
    for count in (1, 2):
        try:
            signature.bind(*[None] * count)
        except TypeError:
            continue
        return count == 2
    raise RuntimeError(_FORMS)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
