"""Reading and writing of recordings."""

from __future__ import annotations

import io
import os
import time
from collections import namedtuple
from collections.abc import Iterable, Iterator
from typing import Any

import genpy
import periplus
from periplus import _native
from periplus.ros import _genpy, _genpy_types

BagMessage = namedtuple("BagMessage", ["topic", "message", "timestamp"])
BagMessageWithConnectionHeader = namedtuple(
    "BagMessageWithConnectionHeader", ["topic", "message", "timestamp", "connection_header"]
)
TypesAndTopicsTuple = namedtuple("TypesAndTopicsTuple", ["msg_types", "topics"])
TopicTuple = namedtuple("TopicTuple", ["msg_type", "message_count", "connections", "frequency"])
_NS = 10**9


class ROSBagException(Exception):
    """Fault of a recording."""

    def __init__(self, value: object = None) -> None:
        super().__init__(value)
        self.value = value


class ROSBagFormatException(ROSBagException):
    """The file is no recording."""


class ROSBagUnindexedException(ROSBagException):
    """The recording has no index."""


class ROSBagEncryptException(ROSBagException):
    """The recording is encrypted."""


class Compression:
    """Names of the compressions."""

    NONE = "none"
    BZ2 = "bz2"
    LZ4 = "lz4"


class Bag:
    """A recording.

    Args:
        f: File, or folder of a ROS 2 recording.
        mode: ``"r"`` to read, ``"w"`` to write a new file.
        compression: none, bz2 or lz4.
        allow_unindexed: Ignored: recordings without an index are read too.
    """

    def __init__(
        self,
        f: Any,
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = 768 * 1024,
        allow_unindexed: bool = False,
        options: dict[str, Any] | None = None,
        skip_index: bool = False,
    ) -> None:
        if options:
            mode, compression = options.get("mode", mode), options.get("compression", compression)
        if not isinstance(f, (str, os.PathLike)):
            f = getattr(f, "name", None)
            if f is None:
                raise ROSBagException("a recording needs the name of a file; a stream without a name cannot be read")
        self.filename = os.fspath(f)
        self._mode = mode
        self._compression = compression
        self._reader: Any = None
        self._writer: Any = None
        self._size = 0
        self._written: dict[str, tuple[str, int]] = {}
        if mode == "r":
            self._open()
        elif mode == "w":
            if os.path.isfile(self.filename):
                os.remove(self.filename)
            self._writer = self._new_writer()
        elif mode == "a":
            self._append()
        else:
            raise ValueError(f'mode "{mode}" is invalid: r, w or a')

    def _new_writer(self) -> Any:
        compression = None if self._compression == Compression.NONE else self._compression
        return _native.BagWriter(self.filename, compression=compression)

    def _open(self) -> None:
        try:
            self._reader = periplus.open_bag(self.filename)
        except _native.FileError as error:
            raise ROSBagFormatException(str(error)) from None
        self._types = {one.name: one for one in self._reader.topics}

    def _append(self) -> None:
        """Copies the messages of the file that exists into a new one."""
        old = f"{self.filename}.before"
        if not os.path.exists(self.filename):
            self._writer = self._new_writer()
            return
        os.rename(self.filename, old)
        self._writer = self._new_writer()
        with Bag(old) as bag:
            for topic, message, stamp in bag.read_messages():
                self.write(topic, message, stamp)
        os.remove(old)

    @property
    def mode(self) -> str:
        return self._mode

    @property
    def version(self) -> int:
        """Version of the format times 100."""
        return 200

    @property
    def size(self) -> int:
        """Size of the file [bytes]."""
        return os.path.getsize(self.filename) if os.path.isfile(self.filename) else 0

    @property
    def compression(self) -> str:
        return self._compression

    def __enter__(self) -> Bag:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Any]:
        return self.read_messages()

    # ---- reading

    def read_messages(
        self,
        topics: str | Iterable[str] | None = None,
        start_time: Any = None,
        end_time: Any = None,
        connection_filter: Any = None,
        raw: bool = False,
        return_connection_header: bool = False,
    ) -> Iterator[Any]:
        """Triples of topic, message and time, in the order of time.

        Args:
            topics: Topics to read (default all).
            start_time: Time of the first message.
            end_time: Time of the last message.
            connection_filter: Function of topic, type, checksum, definition and header.
            raw: Gives (type, bytes, checksum, position, class) in place of messages.
            return_connection_header: Adds the header of the connection.
        """
        reader = self._require_reader()
        wanted = [topics] if isinstance(topics, str) else list(topics) if topics is not None else None
        if wanted is not None:
            names = [one if one in self._types else "/" + one for one in wanted]
            wanted = [one for one in names if one in self._types]
            if not wanted:
                return
        limits = [None if one is None else int(one.to_nsec()) for one in (start_time, end_time)]
        classes: dict[str, Any] = {}
        for topic, data, time_ns in reader.messages(wanted, start=limits[0], end=limits[1], raw=True):
            cls = classes.get(topic)
            if cls is None:
                cls = classes[topic] = self._class(topic)
            header = {"topic": topic, "type": cls._type, "md5sum": cls._md5sum, "callerid": ""}
            if connection_filter is not None and not connection_filter(
                topic, cls._type, cls._md5sum, cls._full_text, header
            ):
                continue
            message = self._message(topic, cls, data, raw)
            stamp = genpy.Time(*divmod(time_ns, _NS))
            if return_connection_header:
                yield BagMessageWithConnectionHeader(topic, message, stamp, header)
            else:
                yield BagMessage(topic, message, stamp)

    def _class(self, topic: str) -> Any:
        info = self._types[topic]
        type_name = _short(info.type_name)
        found = genpy.get_message_class(type_name)
        if found is None:
            found = _class_of_text(type_name, info.schema)
        if found is None:
            raise ROSBagException(f"{self.filename}: type {type_name} of {topic} is not known and its definition cannot be read")
        return found

    def _message(self, topic: str, cls: Any, data: bytes, raw: bool) -> Any:
        is_ros1 = self._types[topic].encoding == "ros1"
        if raw and is_ros1:
            return (cls._type, bytes(data), cls._md5sum, (0, 0), cls)
        if is_ros1:
            message = cls().deserialize(bytes(data))
        else:
            message = _genpy.as_class(_native.deserialize(cls.__type_handle__.type_name, data), cls)
        if raw:
            buffer = io.BytesIO()
            message.serialize(buffer)
            return (cls._type, buffer.getvalue(), cls._md5sum, (0, 0), cls)
        return message

    def _require_reader(self) -> Any:
        if self._reader is None:
            if self._writer is None:
                raise ValueError("I/O operation on closed bag")
            raise ROSBagException(f"{self.filename} is open for writing; close it, then open it with mode 'r'")
        return self._reader

    def get_message_count(self, topic_filters: Any = None) -> int:
        """Number of messages, of some topics if given."""
        wanted = [topic_filters] if isinstance(topic_filters, str) else topic_filters
        if self._reader is None:
            return sum(count for name, (_, count) in self._written.items() if wanted is None or name in wanted)
        return sum(one.count for name, one in self._types.items() if wanted is None or name in wanted)

    def get_start_time(self) -> float:
        """Time of the first message [s]."""
        start = self._require_reader().start_ns
        if start is None:
            raise ROSBagException("Bag contains no message")
        return float(start / 1e9)

    def get_end_time(self) -> float:
        """Time of the last message [s]."""
        end = self._require_reader().end_ns
        if end is None:
            raise ROSBagException("Bag contains no message")
        return float(end / 1e9)

    def get_type_and_topic_info(self, topic_filters: Any = None) -> Any:
        """Checksums by type, and type, number, connections and rate by topic."""
        wanted = [topic_filters] if isinstance(topic_filters, str) else topic_filters
        reader = self._require_reader()
        types: dict[str, str] = {}
        topics: dict[str, Any] = {}
        for name, one in sorted(self._types.items()):
            if wanted is not None and name not in wanted:
                continue
            try:
                types[_short(one.type_name)] = self._class(name)._md5sum
            except ROSBagException:
                types[_short(one.type_name)] = "*"
            seconds = reader.duration_s
            rate = (one.count - 1) / seconds if one.count > 1 and seconds > 0 else None
            topics[name] = TopicTuple(_short(one.type_name), one.count, 1, rate)
        return TypesAndTopicsTuple(types, topics)

    def get_compression_info(self) -> Any:
        size = self.size
        return namedtuple("CompressionTuple", ["compression", "uncompressed", "compressed"])(
            self._compression, size, size
        )

    def __str__(self) -> str:
        lines = [f"path:        {self.filename}"]
        if self._reader is not None:
            lines += [f"duration:    {self._reader.duration_s:.1f}s", f"messages:    {self._reader.message_count}"]
            lines += [f"topics:      {name}  {one.count} msgs : {_short(one.type_name)}" for name, one in self._types.items()]
        return "\n".join(lines)

    # ---- writing

    def write(self, topic: str, msg: Any, t: Any = None, raw: bool = False, connection_header: Any = None) -> None:
        """Appends a message.

        Args:
            topic: Topic.
            msg: Message, or with `raw` (type, bytes, checksum, position, class).
            t: Time (default now).
            raw: The message is given as bytes.
        """
        if self._writer is None:
            raise ValueError("I/O operation on closed bag" if self._reader is None else "bag is open for reading")
        if not topic:
            raise ValueError("topic is empty")
        if raw:
            msg = msg[4]().deserialize(msg[1])
        if not isinstance(msg, genpy.Message):
            raise ROSBagException(f"{topic}: a message is expected, not {type(msg).__name__}")
        if t is None:
            t = genpy.Time.from_sec(time.time())
        native = type(msg).__type_handle__.type_name
        try:
            data = _native.serialize(msg)
        except (TypeError, ValueError) as error:
            msg._check_types()
            raise genpy.SerializationError(str(error)) from error
        self._writer.write(topic, data, t.to_nsec(), type=native)
        kind, count = self._written.get(topic, (type(msg)._type, 0))
        self._written[topic] = (kind, count + 1)

    def flush(self) -> None:
        """Writes what is buffered."""
        if self._writer is not None:
            self._writer.flush()

    def reindex(self) -> Iterator[int]:
        """Does nothing: recordings without an index are read too."""
        return iter(())

    def close(self) -> None:
        """Closes the recording."""
        if self._writer is not None:
            self._writer.close()
        self._writer = self._reader = None


def _short(type_name: str) -> str:
    return _genpy_types.type_in_ros1(type_name) if type_name.count("/") == 2 else type_name


def _class_of_text(type_name: str, schema: Any) -> Any:
    """Class of a type of a recording whose package is not here, by the definition in the recording."""
    text = schema.decode() if isinstance(schema, bytes) else schema
    if not text:
        return None
    from periplus.ros import _genpy_sources

    parts: dict[str, str] = {}
    name, lines = type_name, []
    for line in text.splitlines():
        if line.startswith("====="):
            parts[name] = "\n".join(lines)
            lines = []
        elif line.startswith("MSG: "):
            name = _short(line[5:].strip())
        else:
            lines.append(line)
    parts[name] = "\n".join(lines)
    _genpy_sources.add_texts(parts)
    return genpy.get_message_class(type_name)
