"""Options and descriptions of recordings."""

from __future__ import annotations

import enum
from typing import Any


class _Record:
    """Object with named attributes that have default values."""

    _defaults: dict[str, Any] = {}

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        names = list(self._defaults)
        if len(args) > len(names):
            raise TypeError(f"{type(self).__name__}() takes at most {len(names)} arguments, not {len(args)}")
        for name, value in zip(names, args):
            if name in kwargs:
                raise TypeError(f"{type(self).__name__}() got {name!r} twice")
            kwargs[name] = value
        for name in kwargs:
            if name not in self._defaults:
                raise TypeError(f"{type(self).__name__}() has no argument {name!r}; it has {', '.join(names)}")
        for name, default in self._defaults.items():
            value = kwargs.get(name, default)
            setattr(self, name, type(default)(value) if value is default and isinstance(default, (list, dict)) else value)

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._defaults)
        return f"{type(self).__name__}({values})"


class StorageOptions(_Record):
    """File or folder of a recording, and its format."""

    _defaults = {
        "uri": "",
        "storage_id": "",
        "max_bagfile_size": 0,
        "max_bagfile_duration": 0,
        "max_cache_size": 0,
        "storage_preset_profile": "",
        "storage_config_uri": "",
        "snapshot_mode": False,
        "start_time_ns": -1,
        "end_time_ns": -1,
        "custom_data": {},
    }  # fmt: skip


class ConverterOptions(_Record):
    """Serialization formats; messages are CDR."""

    _defaults = {"input_serialization_format": "cdr", "output_serialization_format": "cdr"}


class StorageFilter(_Record):
    """Topics to read; all if none are given."""

    _defaults = {
        "topics": [],
        "topics_regex": "",
        "topics_regex_to_exclude": "",
        "services_events": [],
        "exclude_topics": [],
        "exclude_service_events": [],
        "regex": "",
        "regex_to_exclude": "",
    }


class TopicMetadata(_Record):
    """Name and type of a topic."""

    _defaults = {
        "id": 0,
        "name": "",
        "type": "",
        "serialization_format": "cdr",
        "offered_qos_profiles": [],
        "type_description_hash": "",
    }

    name: str
    type: str

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        # Before jazzy, the name was the first argument.
        super().__init__(*((0, *args) if args and isinstance(args[0], str) else args), **kwargs)

    def equals(self, other: TopicMetadata) -> bool:
        """True if name, type and serialization format are the same."""
        return (self.name, self.type) == (other.name, other.type)


class TopicInformation(_Record):
    """Topic with the number of its messages."""

    _defaults = {"topic_metadata": None, "message_count": 0}


class MessageDefinition(_Record):
    """Definition of a type."""

    _defaults = {"topic_type": "", "encoding": "ros2msg", "encoded_message_definition": "", "type_hash": ""}


class FileInformation(_Record):
    """File of a recording."""

    _defaults = {"path": "", "starting_time": None, "duration": None, "message_count": 0}


class BagMetadata(_Record):
    """Description of a recording."""

    _defaults = {
        "version": 9,
        "bag_size": 0,
        "storage_identifier": "",
        "relative_file_paths": [],
        "files": [],
        "duration": None,
        "starting_time": None,
        "message_count": 0,
        "topics_with_message_count": [],
        "compression_format": "",
        "compression_mode": "",
        "custom_data": {},
        "ros_distro": "",
    }


class ReadOrderSortBy(enum.Enum):
    """Times by which messages are sorted."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


class ReadOrder(_Record):
    """Order in which messages are read."""

    _defaults = {"sort_by": ReadOrderSortBy.ReceivedTimestamp, "reverse": False}
