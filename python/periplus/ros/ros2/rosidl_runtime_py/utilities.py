"""Classes of messages, services and actions by the names of their types."""

from __future__ import annotations

from typing import Any

from rosidl_parser.definition import NamespacedType
from rosidl_runtime_py.import_message import import_message_from_namespaced_type

_KINDS = ("msg", "srv", "action")


def get_namespaced_type(full_name: str) -> NamespacedType:
    """Type of a name such as `std_msgs/msg/String`; ValueError for another text."""
    parts = full_name.split("/")
    if len(parts) < 2 or not all(parts):
        raise ValueError(f"'{full_name}' is not a type name: expected package/msg/Type")
    return NamespacedType(parts[:-1], parts[-1])


def get_interface(identifier: str, kind: str = "msg") -> Any:
    """Class of a type name; the part `msg` may be left out."""
    named = get_namespaced_type(identifier)
    if len(named.namespaces) == 1:
        named = NamespacedType([named.namespaces[0], kind], named.name)
    return import_message_from_namespaced_type(named)


def _is(interface: Any, kind: str) -> bool:
    return all(hasattr(interface, part) for part in kind.split())


def is_message(interface: Any) -> bool:
    """True for a message class."""
    return hasattr(interface, "get_fields_and_field_types")


def is_service(interface: Any) -> bool:
    """True for a service class."""
    return _is(interface, "Request Response")


def is_action(interface: Any) -> bool:
    """True for an action class."""
    return _is(interface, "Goal Result Feedback")


def get_message(identifier: str) -> Any:
    """Class of a message, such as `std_msgs/msg/String`."""
    made = get_interface(identifier)
    if not is_message(made):
        raise ValueError(f"Expected '{identifier}' to be a message")
    return made


def get_service(identifier: str) -> Any:
    """Class of a service, such as `std_srvs/srv/SetBool`."""
    made = get_interface(identifier, "srv")
    if not is_service(made):
        raise ValueError(f"Expected '{identifier}' to be a service")
    return made


def get_action(identifier: str) -> Any:
    """Class of an action, such as `example_interfaces/action/Fibonacci`."""
    made = get_interface(identifier, "action")
    if not is_action(made):
        raise ValueError(f"Expected '{identifier}' to be an action")
    return made
