"""Writing of recordings."""

from __future__ import annotations

import enum
from typing import Any

from periplus import _native

from rosbag2_py._options import ConverterOptions, MessageDefinition, StorageOptions, TopicMetadata, _Record


class CompressionMode(enum.Enum):
    """What is compressed."""

    NONE = 0
    FILE = 1
    MESSAGE = 2

    def __str__(self) -> str:
        return self.name.lower()


class CompressionOptions(_Record):
    """Compression of a recording."""

    _defaults = {
        "compression_format": "zstd",
        "compression_mode": CompressionMode.FILE,
        "compression_queue_size": 0,
        "compression_threads": 0,
        "thread_priority": 0,
    }


class SequentialWriter:
    """Writes messages to a recording."""

    def __init__(self) -> None:
        self._writer: Any = None
        self._topics: dict[str, TopicMetadata] = {}

    def _compression(self) -> dict[str, str]:
        return {}

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None) -> None:
        """Begins a recording; RuntimeError if the path exists."""
        options: Any = storage_options
        try:
            self._writer = _native.BagWriter(
                options.uri.removeprefix("file://"),
                storage=options.storage_id or None,
                max_size_bytes=options.max_bagfile_size or None,
                max_duration_s=options.max_bagfile_duration or None,
                **self._compression(),
            )
        except FileExistsError:
            raise RuntimeError(f"Bag directory already exists ({options.uri}), can't overwrite existing bag") from None
        except (ValueError, OSError) as error:
            raise RuntimeError(f"The bag {options.uri!r} cannot be written: {error}") from None

    def _opened(self) -> Any:
        if self._writer is None:
            raise RuntimeError("Bag is not open. Call open() before writing.")
        return self._writer

    def create_topic(self, topic_with_type: TopicMetadata, message_definition: MessageDefinition | None = None) -> None:
        """Announces a topic."""
        self._opened()
        self._topics[topic_with_type.name] = topic_with_type

    def remove_topic(self, topic_with_type: TopicMetadata) -> None:
        """Takes back the announcement of a topic."""
        self._topics.pop(topic_with_type.name, None)

    def write(self, topic_name: str, message: bytes, time_stamp: int, sequence_number: int = 0) -> None:
        """Writes the bytes (CDR) of a message with its time [ns]; RuntimeError for a topic that was not created."""
        topic: Any = self._topics.get(topic_name)
        if topic is None:
            raise RuntimeError(
                f"Tried to write on topic '{topic_name}' without creating it first. "
                "Call create_topic(TopicMetadata(name=..., type=..., serialization_format='cdr'))"
            )
        profiles = [qos for qos in map(_qos, topic.offered_qos_profiles) if qos is not None]
        self._opened().write(topic_name, bytes(message), time_stamp, type=topic.type, qos=profiles or None)

    def close(self) -> None:
        """Ends the recording."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None

    def split_bagfile(self) -> None:
        """Writes what is buffered; files are split by size and duration only."""
        self._opened().flush()

    def take_snapshot(self) -> bool:
        """False: there is no snapshot mode."""
        return False

    def __del__(self) -> None:
        self.close()


class SequentialCompressionWriter(SequentialWriter):
    """Writes compressed recordings."""

    def __init__(self, compression_options: CompressionOptions | None = None) -> None:
        super().__init__()
        self._options: Any = compression_options or CompressionOptions()

    def _compression(self) -> dict[str, str]:
        mode = self._options.compression_mode
        if mode == CompressionMode.NONE:
            return {}
        return {"compression": self._options.compression_format or "zstd", "compression_mode": str(mode)}


def _qos(profile: Any) -> dict[str, Any] | None:
    if not hasattr(profile, "reliability"):
        return None
    made: dict[str, Any] = {"depth": profile.depth}
    for name in ("history", "reliability", "durability", "liveliness"):
        made[name] = getattr(profile, name).name.lower()
    return {name: value for name, value in made.items() if value not in ("system_default", "unknown", "best_available")}
