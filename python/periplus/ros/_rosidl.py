"""Message, service and action classes with the conventions of rosidl.

A class has one slot for each field (``_x`` for ``x``). Fields that need no conversion are plain slots, so that reading
and writing them costs no Python call. Arrays of numbers are ``array.array``, or numpy arrays if their length is fixed.
With ``ROS_PYTHON_CHECK_FIELDS=1`` all setters check their values.
"""

from __future__ import annotations

import os
from array import array
from collections.abc import Callable
from copy import deepcopy
from keyword import iskeyword
from typing import Any

from periplus import _native
from periplus.ros._rosidl_fields import (
    checked_setter,
    converter,
    converts,
    given_default,
    unchecked_setter,
    zero,
)
from periplus.ros._rosidl_types import AbstractType, FieldType

_KINDS = {"msg": "Message", "srv": "Service", "action": "Action"}
_ATOMIC = frozenset((int, float, str, bool, bytes))

# Classes by the name and the definition of their types.
_classes: dict[tuple[str, object], type] = {}
_wholes: dict[str, type] = {}


def snake_case(name: str) -> str:
    """Name of the module of a class: ``SetBool`` is in ``_set_bool``, ``UInt8`` in ``_u_int8``."""
    import re

    name = re.sub("(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub("([a-z0-9])([A-Z])", r"\1_\2", name).lower()


class MessageType(type):
    """Class of message classes. Constants are read-only."""

    _TYPE_SUPPORT: Any = None
    __type_name__: str

    @classmethod
    def __import_type_support__(cls) -> None:
        """Does nothing: the classes need no compiled type support."""


class _SlotTypes:
    """Types of the fields, made on first use."""

    def __get__(self, message: object, cls: Any) -> tuple[AbstractType, ...]:
        made = tuple(field.definition() for field in cls.__field_specs__.values())
        if "__field_specs__" in cls.__dict__:
            cls.SLOT_TYPES = made
        return made


class Message(metaclass=MessageType):
    """Base of the message classes."""

    __slots__: Any = ()
    __hash__ = None  # type: ignore[assignment]

    __type_handle__: Any
    __type_name__: str
    __field_specs__: dict[str, FieldType]
    __value_slots__: tuple[str, ...]
    __checks_fields__ = False
    _fields_and_field_types: dict[str, str]
    SLOT_TYPES: Any = _SlotTypes()

    @property
    def _check_fields(self) -> bool:
        return self.__checks_fields__

    @_check_fields.setter
    def _check_fields(self, value: bool) -> None:
        """Ignores the value, which copies and pickled messages bring."""

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Names of the fields with their types, such as ``{'data': 'string'}``."""
        return dict(cls._fields_and_field_types)

    def __repr__(self) -> str:
        cls = type(self)
        module = cls.__module__.rpartition(".")[0]
        values = []
        for slot in cls.__value_slots__:
            value = getattr(self, slot)
            text = repr(value.tolist()) if type(value) is array else repr(value)
            values.append(f"{slot[1:]}={text}")
        return f"{module}.{cls.__name__}({', '.join(values)})"

    def __eq__(self, other: object) -> bool:
        cls = type(self)
        if not isinstance(other, cls):
            return False
        for slot in cls.__value_slots__:
            mine, theirs = getattr(self, slot), getattr(other, slot)
            if hasattr(mine, "shape") or hasattr(theirs, "shape"):
                if not _same_array(mine, theirs):
                    return False
            elif mine != theirs:
                return False
        return True

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        cls = type(self)
        made = object.__new__(cls)
        memo[id(self)] = made
        for slot in cls.__value_slots__:
            value = getattr(self, slot)
            kind = type(value)
            if kind not in _ATOMIC:
                value = value[:] if kind is array else deepcopy(value, memo)
            setattr(made, slot, value)
        own = getattr(self, "__dict__", None)
        if own:
            made.__dict__.update(deepcopy(own, memo))
        return made


def _same_array(mine: Any, theirs: Any) -> bool:
    import numpy as np

    return bool(np.array_equal(mine, theirs))


# ---- messages


def message_class(type_name: str) -> type:
    """Class of a message type, such as ``std_msgs/msg/String`` or ``std_srvs/srv/SetBool_Request``."""
    return make_class(_native.rosidl_handle(type_name))


def make_class(handle: Any) -> type:
    """Class of a message type. The native module calls this once for each type."""
    key = (handle.type_name, handle.type_hash or tuple(handle.fields))
    made = _classes.get(key)
    if made is None:
        made = _make_class(handle)
        _classes[key] = made
    return made


def forget(packages: list[str]) -> None:
    """Drop the classes of packages whose types have changed."""
    names = set(packages)
    for key in [key for key in _classes if key[0].split("/")[0] in names]:
        del _classes[key]
    for name in [name for name in _wholes if name.split("/")[0] in names]:
        del _wholes[name]


def _metaclass(label: str, constants: dict[str, Any]) -> type[MessageType]:
    if not constants:
        return MessageType

    def constant(value: Any) -> property:
        return property(lambda cls: value)

    body: dict[str, Any] = {name: constant(value) for name, value in constants.items()}
    body["__doc__"] = f"Class of the message class {label!r}."
    return type(f"Metaclass_{label}", (MessageType,), body)


def _make_class(handle: Any) -> type:
    type_name: str = handle.type_name
    package, kind, label = type_name.split("/")
    specs = {name: FieldType(text) for name, text in handle.fields}
    defaults: dict[str, Any] = dict(handle.defaults)
    checks = os.environ.get("ROS_PYTHON_CHECK_FIELDS", "") == "1"
    constants: dict[str, Any] = dict(handle.constants)
    constants.update({f"{name.upper()}__DEFAULT": value for name, value in defaults.items()})
    slots = tuple("_" + name for name in specs)
    body: dict[str, Any] = {
        "__slots__": slots,
        "__module__": f"{package}.{kind}._{snake_case(_whole(label, kind))}",
        "__doc__": handle.doc or f"Message class '{label}'.",
        "__type_handle__": handle,
        "__type_name__": type_name,
        "__field_specs__": specs,
        "__value_slots__": slots,
        "__checks_fields__": checks,
        "_fields_and_field_types": {name: spec.text for name, spec in specs.items()},
        "__init__": _initializer(label, specs, defaults, checks),
        **constants,
    }
    cls: Any = _metaclass(label, constants)(label, (Message,), body)
    for name, spec in specs.items():
        slot = cls.__dict__["_" + name]
        if checks:
            setter = checked_setter(name, slot.__set__, spec, message_class)
        elif converts(spec):
            setter = unchecked_setter(slot.__set__, spec, f"{label}.{name}")
        else:
            type.__setattr__(cls, name, slot)
            continue
        type.__setattr__(cls, name, property(slot.__get__, setter, doc=f"Message field '{name}'."))
    cls.__slots__ = [*slots, "_check_fields"]
    made: type = cls
    return made


def _whole(label: str, kind: str) -> str:
    """Name of the service or action that a message is a part of; the name itself for other messages."""
    if kind == "msg":
        return label
    whole = label.removesuffix("_Request").removesuffix("_Response").removesuffix("_Event")
    if kind == "action":
        for part in ("_SendGoal", "_GetResult", "_FeedbackMessage", "_Goal", "_Result", "_Feedback"):
            whole = whole.removesuffix(part)
    return whole


_UNSET: Any = type("Unset", (), {"__slots__": (), "__repr__": lambda self: "default"})()


def _refuse(unknown: dict[str, Any]) -> None:
    """Refuses unknown names of fields."""
    unknown.pop("check_fields", None)
    assert not unknown, f"Invalid arguments passed to constructor: {', '.join(sorted(unknown))}"


def _initializer(label: str, specs: dict[str, FieldType], defaults: dict[str, Any], checks: bool) -> Callable[..., None]:
    """Initializer with one keyword for each field."""
    names: dict[str, Any] = {"_unset": _UNSET, "_array": array, "_refuse": _refuse}
    this = "self" if "self" not in specs else "_self"
    signature, lines = [], []
    for index, (name, spec) in enumerate(specs.items()):
        used = zero(spec, message_class) if name not in defaults else given_default(spec, defaults[name])
        expression, objects = used[0].replace("{name}", f"_n{index}"), used[1]
        names.update({key.replace("{name}", f"_n{index}"): value for key, value in objects.items()})
        is_constant = spec.shape == "one" and not objects
        target = f"{this}.{name}" if checks and not iskeyword(name) else f"{this}._{name}"
        given = name
        if iskeyword(name):
            lines.append(f"_given{index} = _more.pop({name!r}, {expression if is_constant else '_unset'})")
            given = f"_given{index}"
        else:
            signature.append(f"{name}={expression}" if is_constant else f"{name}=_unset")
        if is_constant:
            lines.append(f"{target} = {given}")
            continue
        value = given
        if converts(spec) and (spec.shape != "fixed" or not checks):
            names[f"_c{index}"] = converter(spec, f"{label}.{name}")
            value = f"_c{index}({given})"
        lines.append(f"{target} = {expression} if {given} is _unset else {value}")
    if checks:
        lines.append("if _more: _refuse(_more)")
    star = "*, " if signature else ""
    source = f"def __init__({this}, {star}{', '.join([*signature, '**_more'])}):\n    " + "\n    ".join(lines or ["pass"])
    exec(compile(source, f"<{label} of periplus.ros>", "exec"), names)
    made: Callable[..., None] = names["__init__"]
    made.__qualname__ = f"{label}.__init__"
    return made


# ---- services and actions


class WholeType(type):
    """Class of service and action classes, whose parts are made on first use."""

    _TYPE_SUPPORT: Any = None
    __type_name__: str
    __parts__: dict[str, Callable[[], Any]]

    @classmethod
    def __import_type_support__(cls) -> None:
        """Does nothing: the classes need no compiled type support."""

    def __getattr__(cls, name: str) -> Any:
        parts = cls.__dict__.get("__parts__", {})
        if name not in parts:
            raise AttributeError(f"type object {cls.__name__!r} has no attribute {name!r}")
        made = parts[name]()
        setattr(cls, name, made)
        return made

    def __dir__(cls) -> list[str]:
        return sorted({*super().__dir__(), *cls.__dict__.get("__parts__", {})})


def _no_instance(what: str) -> Callable[..., None]:
    def refuse(self: object) -> None:
        raise NotImplementedError(f"{what} classes can not be instantiated")

    return refuse


def _make_whole(type_name: str, label: str, what: str, parts: dict[str, Callable[[], Any]]) -> type:
    package, kind, name = type_name.split("/")
    body = {
        "__module__": f"{package}.{kind}._{snake_case(_whole(name, kind))}",
        "__doc__": f"{what} {type_name}.",
        "__init__": _no_instance(what),
        "__type_name__": type_name,
        "__parts__": parts,
    }
    return WholeType(label, (), body)


def service_class(type_name: str) -> type:
    """Class of a service, such as ``std_srvs/srv/SetBool``, or of one inside of an action."""
    made = _wholes.get(type_name)
    if made is None:
        if not type_name.split("/")[1] == "action":
            _require_whole(type_name)
        parts: dict[str, Callable[[], Any]] = {}
        for part in ("Request", "Response", "Event"):
            parts[part] = lambda part=part: message_class(f"{type_name}_{part}")  # type: ignore[misc]
        label = type_name.rpartition("/")[2]
        made = _wholes[type_name] = _make_whole(type_name, label, "Service", parts)
    return made


def action_class(type_name: str) -> type:
    """Class of an action, such as ``example_interfaces/action/Fibonacci``."""
    made = _wholes.get(type_name)
    if made is None:
        _require_whole(type_name)
        parts: dict[str, Callable[[], Any]] = {}
        for part in ("Goal", "Result", "Feedback"):
            parts[part] = lambda part=part: message_class(f"{type_name}_{part}")  # type: ignore[misc]
        parts["Impl"] = lambda: _implementation(type_name)
        label = type_name.rpartition("/")[2]
        made = _wholes[type_name] = _make_whole(type_name, label, "Action", parts)
    return made


def _implementation(type_name: str) -> type:
    parts: dict[str, Callable[[], Any]] = {
        "SendGoalService": lambda: service_class(f"{type_name}_SendGoal"),
        "GetResultService": lambda: service_class(f"{type_name}_GetResult"),
        "FeedbackMessage": lambda: message_class(f"{type_name}_FeedbackMessage"),
        "CancelGoalService": lambda: service_class("action_msgs/srv/CancelGoal"),
        "GoalStatusMessage": lambda: message_class("action_msgs/msg/GoalStatusArray"),
    }
    return _make_whole(type_name, "Impl", "Action implementation", parts)


def _require_whole(type_name: str) -> None:
    if type_name not in _native.message_services():
        raise KeyError(f"there is no service or action type `{type_name}`")
