"""Class of a type."""

from __future__ import annotations

import importlib
from typing import Any

from rosidl_parser.definition import NamespacedType


def import_message_from_namespaced_type(message_type: NamespacedType) -> Any:
    """Class of a type."""
    module = importlib.import_module(".".join(message_type.namespaces))
    return getattr(module, message_type.name)
