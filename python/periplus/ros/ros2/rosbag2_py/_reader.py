"""Reading of recordings."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from rosbag2_py import _info
from rosbag2_py._options import (
    BagMetadata,
    ConverterOptions,
    MessageDefinition,
    ReadOrder,
    StorageFilter,
    StorageOptions,
    TopicMetadata,
)

_Message = tuple[str, bytes, int]


class SequentialReader:
    """Reads messages of a recording one after another, as bytes of CDR."""

    def __init__(self) -> None:
        self._bag: Any = None
        self._messages: Iterator[_Message] = iter(())
        self._next: _Message | None = None
        self._filter = StorageFilter()
        self._is_reverse = False
        self._start_ns: int | None = None

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None) -> None:
        """Opens a recording; its format is found out. RuntimeError if it cannot be read."""
        self._options = storage_options
        self._bag = _info.open_bag(storage_options.uri)  # type: ignore[attr-defined]
        self._restart(None)

    def open_uri(self, uri: str) -> None:
        """Opens a recording."""
        self.open(StorageOptions(uri=uri))

    def close(self) -> None:
        """Closes the recording."""
        self._bag, self._messages, self._next = None, iter(()), None

    def _opened(self) -> Any:
        if self._bag is None:
            raise RuntimeError("Bag is not open. Call open() before reading.")
        return self._bag

    def _topics(self) -> list[str] | None:
        chosen: Any = self._filter
        names = [topic.name for topic in self._opened().topics]
        kept = names
        if chosen.topics:
            kept = [name for name in kept if name in chosen.topics]
        include, exclude = chosen.topics_regex or chosen.regex, chosen.topics_regex_to_exclude or chosen.regex_to_exclude
        if include:
            kept = [name for name in kept if re.search(include, name)]
        if exclude:
            kept = [name for name in kept if not re.search(exclude, name)]
        kept = [name for name in kept if name not in chosen.exclude_topics]
        return None if kept == names else kept

    def _restart(self, start_ns: int | None) -> None:
        self._start_ns = start_ns
        topics = self._topics()
        first = getattr(self._options, "start_time_ns", -1)
        last = getattr(self._options, "end_time_ns", -1)
        limits: dict[str, int] = {} if last < 0 else {"end": last}
        if self._is_reverse:
            if start_ns is not None:
                limits["end"] = min(start_ns, limits.get("end", start_ns))
            start_ns = None
        start = max((one for one in (start_ns, first) if one is not None and one >= 0), default=None)
        if start is not None:
            limits["start"] = start
        if topics == []:
            self._messages = iter(())
        elif self._is_reverse:
            self._messages = iter(list(self._bag.messages(topics, raw=True, **limits))[::-1])
        else:
            self._messages = iter(self._bag.messages(topics, raw=True, **limits))
        self._advance()

    def _advance(self) -> None:
        self._next = next(self._messages, None)

    def has_next(self) -> bool:
        """True if there is another message."""
        self._opened()
        return self._next is not None

    def read_next(self) -> _Message:
        """Topic, bytes and time [ns] of the next message."""
        self._opened()
        message = self._next
        if message is None:
            raise RuntimeError("Bag is at end. No next message.")
        self._advance()
        return message

    def seek(self, timestamp: int) -> None:
        """Continues with the first message at or after a time [ns]."""
        self._opened()
        self._restart(timestamp)

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Reads some of the topics only."""
        self._filter = storage_filter
        self._opened()
        self._restart(self._start_ns)

    def reset_filter(self) -> None:
        """Reads all topics."""
        self.set_filter(StorageFilter())

    def set_read_order(self, order: ReadOrder) -> bool:
        """Sets the order; to be called before the first message is read."""
        self._is_reverse = bool(order.reverse)  # type: ignore[attr-defined]
        if self._bag is not None:
            self._restart(self._start_ns)
        return True

    def get_metadata(self) -> BagMetadata:
        """Description of the recording."""
        return _info.metadata(self._opened())

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Topics of the recording."""
        return [_info.topic_metadata(topic, index + 1) for index, topic in enumerate(self._opened().topics)]

    def get_all_message_definitions(self) -> list[MessageDefinition]:
        """Definitions of the types of the recording."""
        definitions: dict[str, MessageDefinition] = {}
        for topic in self._opened().topics:
            definitions.setdefault(
                topic.type_name,
                MessageDefinition(
                    topic_type=topic.type_name,
                    encoded_message_definition=topic.schema,
                    type_hash=topic.metadata.get("topic_type_hash", ""),
                ),
            )
        return list(definitions.values())


class SequentialCompressionReader(SequentialReader):
    """Reads compressed recordings too, as `SequentialReader` does."""
