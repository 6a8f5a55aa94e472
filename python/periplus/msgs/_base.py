"""Base classes of messages, services and actions."""

from __future__ import annotations

from operator import attrgetter
from typing import Any, ClassVar, cast

import numpy as np

from periplus import _native

_native.load_numpy()


class MessageType(type):
    """Type of the message classes: constants cannot be assigned."""

    def __setattr__(cls, name: str, value: object) -> None:
        if name in cls.__dict__.get("__constants__", ()):
            raise AttributeError(f"{cls.__name__}.{name} is a constant")
        super().__setattr__(name, value)


class Message(metaclass=MessageType):
    """Base of all messages.

    A message takes the values of its fields as keyword arguments; others have the defaults of the definition.
    Messages are equal if all their values are (NaN is not equal to itself). They can be copied and pickled.

    >>> from periplus.msgs.geometry_msgs.msg import Point
    >>> Point(x=1) == Point(x=1.0)
    True
    """

    __slots__: tuple[str, ...] = ()
    __hash__ = None  # type: ignore[assignment]

    __type_handle__: ClassVar[_native.TypeHandle]
    __constants__: ClassVar[frozenset[str]]
    __field_types__: ClassVar[dict[str, str]]

    def __init__(self, **fields: Any) -> None:
        _native.init_message(self, fields)

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Names of the fields with their types, such as ``{'data': 'string'}``.

        >>> from periplus.msgs.std_msgs.msg import String
        >>> String.get_fields_and_field_types()
        {'data': 'string'}
        """
        return dict(cls.__field_types__)

    def __repr__(self) -> str:
        cls = type(self)
        module = cls.__module__.removeprefix("periplus.msgs.")
        values = ", ".join(f"{name}={_text(getattr(self, name))}" for name in cls.__field_types__)
        return f"{module}.{cls.__name__}({values})"

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        for name in type(self).__field_types__:
            mine, theirs = getattr(self, name), getattr(other, name)
            if isinstance(mine, np.ndarray):
                if not np.array_equal(mine, theirs):
                    return False
            elif mine != theirs:
                return False
        return True


class Service:
    """Base of all services: ``Request``, ``Response`` and ``Event`` are its messages.

    >>> from periplus.msgs.std_srvs.srv import Trigger
    >>> Trigger.Response(success=True)
    std_srvs.srv.Trigger_Response(success=True, message='')
    """

    Request: ClassVar[type[Message]]
    Response: ClassVar[type[Message]]
    Event: ClassVar[type[Message]]

    def __init__(self) -> None:
        raise NotImplementedError("Service classes can not be instantiated")


class Action:
    """Base of all actions: ``Goal``, ``Result`` and ``Feedback`` are its messages, ``Impl`` has its services.

    >>> from periplus.msgs.example_interfaces.action import Fibonacci
    >>> Fibonacci.Goal(order=5)
    example_interfaces.action.Fibonacci_Goal(order=5)
    """

    Goal: ClassVar[type[Message]]
    Result: ClassVar[type[Message]]
    Feedback: ClassVar[type[Message]]
    Impl: ClassVar[type[Any]]

    def __init__(self) -> None:
        raise NotImplementedError("Action classes can not be instantiated")


def _text(value: Any) -> str:
    if not isinstance(value, np.ndarray):
        return repr(value)
    if value.size > 64:
        shown = ", ".join(repr(one) for one in value[:3].tolist())
        return f"[{shown}, ... {value.size} values]"
    return repr(value.tolist())


def make_class(handle: _native.TypeHandle) -> type[Message]:
    """Class of a message type. The native module calls this once for each type."""
    package, kind, name = handle.type_name.split("/")
    fields = dict(handle.fields)
    constants = handle.constants
    body: dict[str, Any] = {
        "__slots__": tuple("_" + field for field in fields),
        "__module__": f"periplus.msgs.{package}.{kind}",
        "__doc__": handle.doc or f"{package}/{kind}/{name}",
        "__type_handle__": handle,
        "__field_types__": fields,
        "__constants__": frozenset(constants),
        **constants,
    }
    for index, (field, type_text) in enumerate(fields.items()):
        body[field] = property(attrgetter("_" + field), handle.setter(index), doc=type_text)
    return cast(type[Message], MessageType(name, (Message,), body))


def make_service(package: str, kind: str, name: str) -> type[Service]:
    """Class of a service."""
    body: dict[str, Any] = {"__slots__": (), "__module__": f"periplus.msgs.{package}.{kind}"}
    for part in ("Request", "Response", "Event"):
        body[part] = _native.message_class(f"{package}/{kind}/{name}_{part}")
    body["__doc__"] = f"{package}/{kind}/{name}: a request and a response."
    return type(name, (Service,), body)


def make_action(package: str, name: str) -> type[Action]:
    """Class of an action."""
    module = f"periplus.msgs.{package}.action"
    body: dict[str, Any] = {"__slots__": (), "__module__": module}
    for part in ("Goal", "Result", "Feedback"):
        body[part] = _native.message_class(f"{package}/action/{name}_{part}")
    body["Impl"] = type(
        "Impl",
        (),
        {
            "__module__": module,
            "__doc__": f"Services and topics of the action {package}/action/{name}.",
            "SendGoalService": make_service(package, "action", f"{name}_SendGoal"),
            "GetResultService": make_service(package, "action", f"{name}_GetResult"),
            "FeedbackMessage": _native.message_class(f"{package}/action/{name}_FeedbackMessage"),
            "CancelGoalService": make_service("action_msgs", "srv", "CancelGoal"),
            "GoalStatusMessage": _native.message_class("action_msgs/msg/GoalStatusArray"),
        },
    )
    body["__doc__"] = f"{package}/action/{name}: a goal, a result and feedback."
    return type(name, (Action,), body)
