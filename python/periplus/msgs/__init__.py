"""ROS messages, services and actions as Python classes.

Classes have the names of ROS: ``from periplus.msgs.sensor_msgs.msg import LaserScan``,
``from periplus.msgs.std_srvs.srv import Trigger``, ``from periplus.msgs.tf2_msgs.action import LookupTransform``.
They are made on first use from the definitions of the types. :func:`load` adds the types of a package of your own.

Arrays of numbers are numpy arrays of exactly the type of the field. A value that does not fit a field, such as a
text, a number out of range, or an array of the wrong length, is refused with an error that names the field:

>>> from periplus.msgs.sensor_msgs.msg import LaserScan
>>> scan = LaserScan(angle_min=-1, ranges=[1.0, 2.5])
>>> scan.ranges
array([1. , 2.5], dtype=float32)
>>> scan.ranges = "near"
Traceback (most recent call last):
    ...
TypeError: LaserScan.ranges must be an array of float32, not str
"""

from __future__ import annotations

import os
from typing import Any, TypeVar

from periplus import _native
from periplus.msgs import _modules
from periplus.msgs._base import Action, Message, Service

_M = TypeVar("_M", bound=Message)

__all__ = [
    "Action",
    "Message",
    "Service",
    "from_dict",
    "from_json",
    "get_message",
    "load",
    "to_dict",
    "to_json",
    "to_yaml",
    "type_names",
]

_modules.install()


def get_message(type_name: str) -> type[Message]:
    """Class of a message type by its name, such as ``geometry_msgs/msg/Twist`` or ``geometry_msgs/Twist``.

    Raises ``KeyError`` for an unknown name.

    >>> from periplus.msgs import get_message
    >>> get_message("geometry_msgs/msg/Point")(x=1)
    geometry_msgs.msg.Point(x=1.0, y=0.0, z=0.0)
    """
    return _native.message_class(type_name)


def type_names() -> list[str]:
    """Names of all message types, sorted; requests and responses of services and parts of actions included.

    >>> from periplus.msgs import type_names
    >>> "sensor_msgs/msg/LaserScan" in type_names()
    True
    """
    return _native.message_types()


def load(folder: str | os.PathLike[str]) -> list[str]:
    """Add the types of a package (``msg/*.msg``, ``srv/*.srv``, ``action/*.action``) or of a folder of packages.

    Returns the names of the packages, whose classes can be imported then:
    ``from periplus.msgs.my_package.msg import MyMessage``. A type replaces a built-in one of the same name.
    Raises ``FileNotFoundError`` if there is no such folder and ``FileError`` for an error in a definition, with
    its file, line and column.

    >>> import pathlib, tempfile
    >>> from periplus.msgs import get_message, load
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     package = pathlib.Path(folder) / "doc_msgs"
    ...     (package / "msg").mkdir(parents=True)
    ...     _ = (package / "package.xml").write_text("<package><name>doc_msgs</name></package>")
    ...     _ = (package / "msg" / "Gear.msg").write_text("uint8 teeth 12\\n")
    ...     load(folder)
    ['doc_msgs']
    >>> get_message("doc_msgs/msg/Gear")()
    doc_msgs.msg.Gear(teeth=12)
    """
    packages = _native.load_messages(os.fspath(folder))
    _modules.forget(packages)
    return packages


def to_dict(message: Message) -> dict[str, Any]:
    """Message as a dictionary of its fields; arrays stay numpy arrays.

    >>> from periplus.msgs import to_dict
    >>> from periplus.msgs.geometry_msgs.msg import Point
    >>> to_dict(Point(x=1))
    {'x': 1.0, 'y': 0.0, 'z': 0.0}
    """

    def convert(value: Any) -> Any:
        if isinstance(value, Message):
            return to_dict(value)
        if isinstance(value, list):
            return [convert(one) for one in value]
        return value

    return {name: convert(getattr(message, name)) for name in message.get_fields_and_field_types()}


def from_dict(type: type[_M] | str, fields: dict[str, Any]) -> _M:
    """Message of a dictionary of its fields, as :func:`to_dict` makes it; fields that are missing have defaults.

    Raises ``TypeError`` or ``ValueError`` if a value does not fit its field, and ``TypeError`` for an unknown field.

    >>> from periplus.msgs import from_dict
    >>> from_dict("geometry_msgs/msg/Point", {"x": 1})
    geometry_msgs.msg.Point(x=1.0, y=0.0, z=0.0)
    """

    cls: Any = _native.message_class(type) if isinstance(type, str) else type
    types: dict[str, str] = cls.get_fields_and_field_types()

    def convert(name: str, value: Any) -> Any:
        if not isinstance(value, (dict, list)) or "/" not in types.get(name, ""):
            return value
        element = types[name].removeprefix("sequence<").split(",")[0].split("[")[0].rstrip(">")
        if isinstance(value, dict):
            return from_dict(element, value)
        return [from_dict(element, one) if isinstance(one, dict) else one for one in value]

    message: _M = cls(**{name: convert(name, value) for name, value in fields.items()})
    return message


def to_json(message: Message, *, indent: bool = False) -> str:
    """Message as JSON: objects with the names of the fields. NaN and infinity are strings, bytes are numbers.

    >>> from periplus.msgs import to_json
    >>> from periplus.msgs.std_msgs.msg import String
    >>> to_json(String(data="hi"))
    '{"data":"hi"}'
    """
    return _native.message_to_json(message, indent=indent)


def from_json(type: type[_M] | str, text: str) -> _M:
    """Message of a JSON text, as :func:`to_json` makes it; fields that are missing have defaults.

    Raises ``ValueError`` if the text is no JSON or does not fit the type.

    >>> from periplus.msgs import from_json
    >>> from_json("std_msgs/msg/String", '{"data": "hi"}')
    std_msgs.msg.String(data='hi')
    """
    message: _M = _native.message_from_json(type, text)
    return message


def to_yaml(message: Message, *, max_length: int | None = None) -> str:
    """Message as YAML, in the format of ``ros2 topic echo``.

    ``max_length`` truncates longer lists and texts, with ``'...'``.

    >>> from periplus.msgs import to_yaml
    >>> from periplus.msgs.geometry_msgs.msg import Point
    >>> print(to_yaml(Point(x=1)), end="")
    x: 1.0
    y: 0.0
    z: 0.0
    """
    return _native.message_to_yaml(message, max_length=max_length)


def __getattr__(name: str) -> Any:
    if not name.startswith("_") and _modules.has_package(name):
        import importlib

        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_modules.packages()})
