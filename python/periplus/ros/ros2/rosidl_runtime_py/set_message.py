"""Fields of a message from a dictionary."""

from __future__ import annotations

from array import array
from typing import Any

from rosidl_parser.definition import AbstractNestedType, NamespacedType
from rosidl_runtime_py.import_message import import_message_from_namespaced_type


def set_message_fields(
    msg: Any, values: dict[str, Any], expand_header_auto: bool = False, expand_time_now: bool = False
) -> list[Any]:
    """Sets fields of a message, nested ones too.

    With `expand_header_auto` the value `auto` of a header, and with `expand_time_now` the value `now` of a time, leaves
    the field; these stamps are returned, to be set later.
    """
    stamps: list[Any] = []

    def set_all(message: Any, given: Any) -> None:
        if not hasattr(given, "items"):
            raise TypeError(f"Value '{given}' is expected to be a dictionary but is a {type(given).__name__}")
        types = dict(zip(message.get_fields_and_field_types(), message.SLOT_TYPES))
        for name, value in given.items():
            setattr(message, name, convert(getattr(message, name), types[name], value))

    def convert(field: Any, kind: Any, value: Any) -> Any:
        cls = type(field)
        if cls is array:
            return array(field.typecode, value)
        if hasattr(field, "dtype"):
            import numpy as np

            return np.array(value, dtype=field.dtype)
        if isinstance(kind, AbstractNestedType):
            if not isinstance(kind.value_type, NamespacedType):
                return list(value)
            element = import_message_from_namespaced_type(kind.value_type)
            return [filled(element(), one) for one in value]
        if isinstance(value, cls):
            return value
        if isinstance(kind, NamespacedType):
            return filled(field, value)
        return cls(value)

    def filled(message: Any, value: Any) -> Any:
        if isinstance(value, type(message)):
            return value
        type_name = getattr(type(message), "__type_name__", "")
        if expand_header_auto and value == "auto" and type_name == "std_msgs/msg/Header":
            stamps.append(message.stamp)
        elif expand_time_now and value == "now" and type_name == "builtin_interfaces/msg/Time":
            stamps.append(message)
        else:
            set_all(message, value)
        return message

    set_all(msg, values)
    return stamps
