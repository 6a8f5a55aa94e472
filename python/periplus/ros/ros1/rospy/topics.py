"""Publishers and subscribers."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable
from typing import Any

import genpy
from periplus.ros import _faults, _waiting

from rospy import core, names
from rospy._dispatch import Source, report_fault
from rospy._reader import DEFAULT_DEPTH, Reader, qos
from rospy.exceptions import ROSException, ROSSerializationException
from rospy.msg import AnyMsg, args_kwds_to_message, ready_to_publish


class Topic:
    """What publishers and subscribers share."""

    reg_type = ""

    def __init__(self, name: str, data_class: Any) -> None:
        if not name or not isinstance(name, str):
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if not isinstance(data_class, type):
            raise ValueError(f"data_class [{data_class}] is not a class")
        if not issubclass(data_class, genpy.Message):
            raise ValueError(f"data_class [{data_class.__name__}] is not a message data class")
        if name.startswith("~") and not core.is_initialized():
            raise ROSException(
                f"rospy.init_node() must be called before a private name such as {name!r} is used"
            )
        self.name = self.resolved_name = names.remap_name(name)
        self._given_name = name
        self.data_class = data_class
        self.type = data_class._type
        self.md5sum = data_class._md5sum
        self._closed = False

    def _resolve(self) -> None:
        """Resolves the name for the node, which may not have had its own when this object was made."""
        self.name = self.resolved_name = core.live_node().resolve(names.remap_name(self._given_name))

    @property
    def impl(self) -> Topic:
        return self

    def get_num_connections(self) -> int:
        raise NotImplementedError

    def unregister(self) -> None:
        raise NotImplementedError


class SubscribeListener:
    """Base of objects that hear when the first subscribers come; they are called with `peer_publish`."""

    def peer_subscribe(self, topic_name: str, topic_publish: Any, peer_publish: Any) -> None:
        """Called when a subscriber has come."""

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """Called when a subscriber has gone."""


class Publisher(Topic):
    """Publisher of a topic.

    Args:
        name: Topic.
        data_class: Message class.
        subscriber_listener: Object that hears of subscribers.
        tcp_nodelay: Ignored.
        latch: Sends the last message to subscribers that come later.
        headers: Ignored.
        queue_size: Number of messages that wait for a slow subscriber.
    """

    reg_type = "pub"

    def __init__(
        self,
        name: str,
        data_class: Any,
        subscriber_listener: SubscribeListener | None = None,
        tcp_nodelay: bool = False,
        latch: bool = False,
        headers: dict[str, str] | None = None,
        queue_size: int | None = None,
    ) -> None:
        super().__init__(name, data_class)
        if queue_size is not None and not isinstance(queue_size, int):
            raise ValueError("queue_size must be None or an integer")
        if queue_size is None:
            warnings.warn(
                "The publisher should be created with an explicit keyword argument 'queue_size', such as queue_size=10. "
                f"Without it, a message of {name} is kept until every subscriber has it",
                category=SyntaxWarning,
                stacklevel=2,
            )
        self.is_latch = latch
        self.queue_size = queue_size
        self._native: Any = None
        self._seq = 0
        self._lock = threading.Lock()
        self._has_header = data_class._has_header
        self._listener: _Listener | None = None
        core.when_initialized(self._start)
        if subscriber_listener is not None:
            self._listener = _Listener(self, subscriber_listener)
            core.when_initialized(self._listener.start)

    def _start(self) -> None:
        self._resolve()
        depth = 1 if self.is_latch else self.queue_size or DEFAULT_DEPTH
        durability = "transient_local" if self.is_latch else "volatile"
        native_type = self.data_class.__type_handle__.type_name
        self._native = core.live_node().publisher(
            self.resolved_name, native_type, qos(depth, durability=durability)
        )

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Publishes a message, or the message with these fields.

        Raises:
            ROSException: The node is not initialized, or has shut down.
            ROSSerializationException: A field has a value that does not fit.
        """
        native = self._native
        if native is None:
            raise ROSException("ROS node has not been initialized yet. Please call init_node() first")
        if self._closed or core.state.is_shutdown:
            raise ROSException("publish() to a closed topic")
        message = args_kwds_to_message(self.data_class, args, kwds)
        if self._has_header:
            with self._lock:
                self._seq += 1
                message.header.seq = self._seq
        try:
            native.publish(ready_to_publish(message))
        except (TypeError, ValueError, AttributeError, OverflowError) as error:
            try:
                message._check_types()
            except genpy.SerializationError as better:
                raise ROSSerializationException(f"{self.resolved_name}: {better}") from None
            raise ROSSerializationException(f"{self.resolved_name}: {error}") from error

    def get_num_connections(self) -> int:
        """Number of subscribers."""
        if self._native is None or self._closed or core.state.is_shutdown:
            return 0
        _waiting.poll()
        return int(self._native.subscription_count)

    def has_connection(self, endpoint_id: str = "") -> bool:
        return self.get_num_connections() > 0

    def unregister(self) -> None:
        """Closes the publisher."""
        if not self._closed:
            self._closed = True
            if self._native is not None:
                self._native.close()


class _Listener(Source):
    """Watches the number of subscribers for a `SubscribeListener`."""

    def __init__(self, publisher: Publisher, listener: Any) -> None:
        super().__init__()
        self._publisher = publisher
        self._target = listener
        self._count = 0

    def start(self) -> None:
        assert core.state.dispatcher is not None
        core.state.dispatcher.add(self)

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        count = self._publisher.get_num_connections()
        before, self._count = self._count, count
        name, publish = self._publisher.resolved_name, self._publisher.publish
        calls: list[tuple[int, Callable[[], None]]] = []
        if count > before:
            function = getattr(self._target, "peer_subscribe", None)
            if function is not None:
                calls += [(0, lambda: function(name, publish, publish))] * (count - before)
        elif count < before:
            gone = getattr(self._target, "peer_unsubscribe", None)
            if gone is not None:
                calls.append((0, lambda: gone(name, count)))
        return calls


class Subscriber(Topic):
    """Subscriber of a topic. Callbacks run in another thread, one at a time for each topic.

    Args:
        name: Topic.
        data_class: Message class.
        callback: Function of the message, and of `callback_args` if they are given.
        callback_args: Second argument of the callback.
        queue_size: Number of messages that wait for the callback; the oldest are dropped (default: all are kept).
        buff_size: Ignored.
        tcp_nodelay: Ignored.
    """

    reg_type = "sub"

    def __init__(
        self,
        name: str,
        data_class: Any,
        callback: Callable[..., Any] | None = None,
        callback_args: Any = None,
        queue_size: int | None = None,
        buff_size: int = 65536,
        tcp_nodelay: bool = False,
    ) -> None:
        super().__init__(name, data_class)
        self.callback = callback
        self.callback_args = callback_args
        self.queue_size = queue_size
        self._topic: _SharedTopic | None = None
        core.when_initialized(self._start)

    def _start(self) -> None:
        if self._closed:
            return
        self._resolve()
        self._topic = _shared_topic(self.resolved_name, self.data_class, self.queue_size)
        self._topic.add(self)

    def get_num_connections(self) -> int:
        """Number of publishers."""
        _waiting.poll()
        return 0 if self._topic is None or self._closed else self._topic.publisher_count()

    def unregister(self) -> None:
        """Ends the subscription."""
        if not self._closed:
            self._closed = True
            if self._topic is not None:
                self._topic.remove(self)
            self.callback = None


_topics: dict[tuple[str, Any], _SharedTopic] = {}


def _shared_topic(name: str, data_class: Any, queue_size: int | None) -> _SharedTopic:
    with core.state.lock:
        topic = _topics.get((name, data_class))
        if topic is None:
            topic = _topics[name, data_class] = _SharedTopic(name, data_class, queue_size)
        elif queue_size is None or topic.limit is not None and queue_size > topic.limit:
            topic.limit = queue_size
        return topic


class _SharedTopic(Source):
    """The subscribers of one topic in this process."""

    def __init__(self, name: str, data_class: Any, queue_size: int | None) -> None:
        super().__init__()
        self._name = name
        self._class = data_class
        self.limit = queue_size
        self._subscribers: tuple[Subscriber, ...] = ()
        self._monitors: dict[int, Any] = {}
        self._reader: Reader | None = None
        self._is_any = issubclass(data_class, AnyMsg)
        self._header = {"topic": name, "type": data_class._type, "md5sum": data_class._md5sum, "callerid": ""}
        if not self._is_any:
            self._open(data_class.__type_handle__.type_name)

    def _open(self, type_name: str) -> None:
        depth = self.limit if self.limit else DEFAULT_DEPTH
        self._reader = Reader(self._name, type_name, depth, raw=False)

    def publisher_count(self) -> int:
        return 0 if self._reader is None else self._reader.publisher_count

    def add(self, subscriber: Subscriber) -> None:
        is_first = not self._subscribers
        self._subscribers = (*self._subscribers, subscriber)
        self._monitors[id(subscriber)] = _faults.CallbackMonitor(
            subscriber.callback or _nothing, node=core.get_name(), kind="subscription", name=self._name
        )
        if is_first and core.state.dispatcher is not None:
            core.state.dispatcher.add(self)

    def remove(self, subscriber: Subscriber) -> None:
        self._subscribers = tuple(one for one in self._subscribers if one is not subscriber)
        self._monitors.pop(id(subscriber), None)
        if not self._subscribers:
            with core.state.lock:
                _topics.pop((self._name, self._class), None)
            if core.state.dispatcher is not None:
                core.state.dispatcher.remove(self)
            if self._reader is not None:
                self._reader.close()

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        reader = self._reader
        if reader is None:
            self._find_type()
            return []
        messages = reader.poll()
        self.wake_ns = reader.wake_ns
        return [(stamp, lambda message=message: self._call(message)) for message, stamp in messages]  # type: ignore[misc]

    def _find_type(self) -> None:
        """Opens the reader of an `AnyMsg` subscriber once somebody publishes."""
        for topic, types in core.state.graph.topics():
            if topic == self._name and types:
                self._open(types[0])
                self._header = {**self._header, "type": _any_type(types[0])}
                self.wake_ns = None
                return
        self.wake_ns = core.state.graph.steady_ns() + 100_000_000

    def _call(self, message: Any) -> None:
        message = self._received(message)
        for subscriber in self._subscribers:
            callback = subscriber.callback
            if callback is None or core.state.is_shutdown:
                continue
            monitor = self._monitors.get(id(subscriber))
            before = monitor.start() if monitor is not None else None
            try:
                if subscriber.callback_args is not None:
                    callback(message, subscriber.callback_args)
                else:
                    callback(message)
            except Exception:
                if not core.is_shutdown_requested():
                    report_fault(callback, "subscription", self._name)
            except KeyboardInterrupt:
                # A wait in the callback was ended by the shutdown.
                pass
            finally:
                if monitor is not None:
                    monitor.end(before)

    def _received(self, message: Any) -> Any:
        from rospy.msg import received

        return received(message, self._class, self._header)


def _nothing(message: Any) -> None:
    """Stands for the callback of a subscriber without one."""


def _any_type(native: str) -> str:
    from periplus.ros._genpy_types import type_in_ros1

    return type_in_ros1(native)
