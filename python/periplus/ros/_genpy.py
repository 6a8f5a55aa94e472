"""Message classes with the conventions of ROS 1, over the native types.

The native module reads and makes objects through their slots (``_x`` for ``x``). The properties give the values the form
that programs of ROS 1 know: integers for bytes, `genpy.Time` for stamps. Arrays that arrive are tuples, or bytes.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import Any

import genpy
from genpy import Message

from periplus import _native
from periplus.ros import _genpy_types
from periplus.ros._genpy_types import PRIMITIVES, Definition, Field, native_type_name

_TIME_TYPES = {"builtin_interfaces/msg/Time": genpy.Time, "builtin_interfaces/msg/Duration": genpy.Duration}
_FLOATS = frozenset(("float32", "float64"))
_OCTETS = frozenset(("uint8", "char"))

# Attributes of the classes that a field's slot may collide with.
_CLASS_NAMES = frozenset(("_type", "_md5sum", "_slot_types", "_has_header", "_full_text"))

# Classes by native type name.
_classes: dict[str, Any] = {}
# Definitions of texts, by native type name; the registry has the others.
_texts: dict[str, Definition] = {}


def genpy_handle(native_name: str) -> Any:
    """Handle of a native type. Raises `KeyError` for an unknown one."""
    return _native.genpy_handle(native_name)


def message_class(name: str) -> Any:
    """Class of ``pkg/Name`` (ROS 1) or ``pkg/kind/Name`` (native). Raises `KeyError` for an unknown type."""
    if name.count("/") == 1:
        package, short = name.split("/")
        return message_class(_native_name(package, short))
    package, kind, short = name.split("/")
    name = f"{package}/{kind}/{native_type_name(short)}" if kind != "action" else name
    found = _classes.get(name)
    if found is None:
        from periplus.ros import _genpy_sources

        _genpy_sources.load(package)
        definition = _texts.get(name)
        found = _make(definition) if definition is not None else make_class(genpy_handle(name))
    return found


def _native_name(package: str, short: str) -> str:
    """Native name of a message or of a part of a service."""
    for ending in ("Request", "Response"):
        if short.endswith(ending) and len(short) > len(ending):
            from periplus.ros import _genpy_sources

            if short[: -len(ending)] in _genpy_sources.names(package, "srv"):
                return f"{package}/srv/{short[: -len(ending)]}_{ending}"
    return f"{package}/msg/{short}"


def make_class(handle: Any) -> Any:
    """Class of a native type. The native module calls this once for each type that it makes objects of."""
    native = handle.type_name
    cls = _TIME_TYPES.get(native) or _classes.get(native)
    if cls is None:
        definition = _texts.get(native)
        if definition is None:
            definition = _genpy_types.from_handle(handle)
        definition.handle = handle
        cls = _make(definition)
    if cls.__type_handle__ is None:
        cls.__type_handle__ = handle
    return cls


def add_definition(definition: Definition) -> None:
    """Announces a definition that was read from text; its class is made when it is used."""
    _texts[definition.native] = definition
    _classes.pop(definition.native, None)


def _make(definition: Definition) -> Any:
    if definition.native in _TIME_TYPES:
        return make_class(definition.handle)
    package, kind, _ = definition.native.split("/")
    name = definition.type.split("/")[1]
    slots = [one.slot for one in (*definition.fields, *definition.hidden)]
    body: dict[str, Any] = {
        "__slots__": tuple(slot + "_" if slot in _CLASS_NAMES else slot for slot in slots),
        "__module__": f"{package}.{kind}",
        "__doc__": _doc(definition),
        "_type": definition.type,
        "__definition__": definition,
        "_has_header": bool(definition.fields) and definition.fields[0].type == "std_msgs/Header",
        "_slot_types": [one.type for one in definition.fields],
        "__type_handle__": definition.handle,
        **definition.constants,
    }
    cls = type(name, (Message,), body)
    if definition.handle is None:
        cls.__type_handle__ = genpy_handle(definition.native)
    for slot in slots:
        if slot in _CLASS_NAMES:
            setattr(cls, slot, _SharedName(getattr(cls, slot + "_"), body.get(slot)))
    for one in definition.fields:
        setattr(cls, one.name, _property(cls, one))
    # Programs read the names of the fields here; the storage exists already.
    cls.__slots__ = [one.name for one in definition.fields]
    cls.__first_values__ = _Defaults(definition)  # type: ignore[attr-defined]
    _classes[definition.native] = cls
    return cls


def _doc(definition: Definition) -> str:
    lines = [f"{one.type} {one.name}" for one in definition.fields]
    return f"{definition.type}\n\n" + "\n".join(lines)


class _Defaults:
    """Pairs of slot and maker of its first value, found at the first use: a nested class may not exist before."""

    def __init__(self, definition: Definition) -> None:
        self.__definition__ = definition

    def __get__(self, message: object, cls: Any) -> tuple[tuple[str, Any], ...]:
        definition = self.__definition__
        made = tuple((one.slot, _maker(one.type)) for one in (*definition.fields, *definition.hidden))
        cls.__first_values__ = made
        return made


def _maker(type_text: str) -> Callable[[], Any]:
    base, bracket, rest = type_text.partition("[")
    length = rest[:-1]
    element: Any = None
    if base not in PRIMITIVES or base in ("time", "duration"):
        element = _genpy_types.element_class(base)
    if not bracket:
        return element if element is not None else _constant(_zero(base))
    if length and element is not None:
        count = int(length)
        return lambda: [element() for _ in range(count)]
    if length and base in _OCTETS:
        return _constant(bytes(int(length)))
    if length:
        values = [_zero(base)] * int(length)
        return lambda: list(values)
    return _constant(b"") if base in _OCTETS else list


def _constant(value: Any) -> Callable[[], Any]:
    return lambda: value


def _zero(base: str) -> Any:
    if base == "bool":
        return False
    if base == "string":
        return ""
    return 0.0 if base in _FLOATS else 0


def _property(cls: Any, one: Field) -> Any:
    """Access to a slot under the name and with the values of ROS 1."""
    slot = cls.__dict__[one.slot]
    base, bracket, _ = one.type.partition("[")
    if one.slot == "_seq" and one.type == "uint32":
        return _seq_property(slot)
    if base == "byte" and cls.__type_handle__ is not None and _is_octet(cls.__type_handle__, one):
        return _octets_property(slot) if bracket else _octet_property(slot)
    return slot


class _SharedName:
    """A slot whose name is that of a class attribute too: `Marker._type` is a name, `marker._type` a value."""

    def __init__(self, slot: Any, class_value: Any) -> None:
        self._slot = slot
        self._class_value = class_value

    def __get__(self, message: object, cls: Any = None) -> Any:
        return self._class_value if message is None else self._slot.__get__(message, cls)

    def __set__(self, message: object, value: Any) -> None:
        self._slot.__set__(message, value)


def _is_octet(handle: Any, one: Field) -> bool:
    return any("_" + name == one.slot and "octet" in text for name, text in handle.fields)


def _seq_property(slot: Any) -> property:
    def get(message: Any) -> int:
        try:
            return slot.__get__(message)  # type: ignore[no-any-return]
        except AttributeError:
            return 0

    return property(get, slot.__set__)


def _octet_property(slot: Any) -> property:
    """A number for programs, bytes of length 1 in the slot."""

    def get(message: Any) -> int:
        value = slot.__get__(message)
        return value[0] if isinstance(value, bytes) else value  # type: ignore[no-any-return]

    def put(message: Any, value: Any) -> None:
        slot.__set__(message, bytes((int(value) & 0xFF,)) if hasattr(value, "__index__") else value)

    return property(get, put)


def _octets_property(slot: Any) -> property:
    def get(message: Any) -> tuple[int, ...]:
        return tuple(value[0] if isinstance(value, bytes) else value for value in slot.__get__(message))

    def put(message: Any, values: Any) -> None:
        slot.__set__(message, [bytes((int(one) & 0xFF,)) if hasattr(one, "__index__") else one for one in values])

    return property(get, put)


def as_class(message: Any, cls: Any) -> Any:
    """The message as an object of `cls`, a class of the same type; itself if it is one already."""
    if type(message) is cls:
        return message
    if issubclass(cls, genpy.TVal):
        made = cls()
        made.secs, made.nsecs = message._sec, message._nanosec
        return made
    made = cls()
    definition = cls.__definition__
    for one in (*definition.fields, *definition.hidden):
        try:
            value = getattr(message, one.slot)
        except AttributeError:
            continue
        element = _genpy_types.element_class(one.type)
        if element is None:
            if hasattr(value, "typecode") or hasattr(value, "dtype"):
                value = value.tobytes() if _genpy_types.base_type(one.type) in _OCTETS else tuple(value.tolist())
            elif isinstance(value, list):
                value = deepcopy(value)
        elif one.type.endswith("]"):
            value = [as_class(each, element) for each in value]
        else:
            value = as_class(value, element)
        setattr(made, one.slot, value)
    return made


# ---- services


class ServiceDefinition:
    """Base of the service classes: `_request_class` and `_response_class` are their messages."""


_services: dict[str, Any] = {}


def service_class(package: str, name: str) -> Any:
    """Class of a service. Raises `KeyError` for an unknown one."""
    key = f"{package}/{name}"
    cls = _services.get(key)
    if cls is None:
        request = message_class(f"{package}/srv/{name}_Request")
        response = message_class(f"{package}/srv/{name}_Response")
        body = {
            "__slots__": (),
            "__module__": f"{package}.srv",
            "__doc__": f"Service {key}.",
            "_type": key,
            "_native_type": f"{package}/srv/{native_type_name(name)}",
            "_request_class": request,
            "_response_class": response,
            "_md5sum": _ServiceMd5(),
        }
        cls = _services[key] = type(name, (ServiceDefinition,), body)
    return cls


class _ServiceMd5:
    """Checksum of a service: of the texts of its request and its response."""

    def __get__(self, service: object, cls: Any) -> str:
        import hashlib

        texts = [_genpy_types.md5_text(part.__definition__) for part in (cls._request_class, cls._response_class)]
        if None in texts:
            return "*"
        return hashlib.md5("".join(str(text) for text in texts).encode()).hexdigest()


