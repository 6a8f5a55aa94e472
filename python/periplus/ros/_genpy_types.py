"""Definitions of ROS 1 message types: from the registry of native types, or from `.msg`, `.srv` and `.action` text.

The wire carries ROS 2 types. Where ROS 1 differs (the names of the fields of CameraInfo, `Header.seq`, `time`), the
definition has both: the name of ROS 1 for programs, the name of the storage for the native module.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from typing import Any

# Names of rosidl's basic types in ROS 1.
_BASIC = {
    "boolean": "bool",
    "octet": "byte",
    "float": "float32",
    "double": "float64",
    "wstring": "string",
    "builtin_interfaces/Time": "time",
    "builtin_interfaces/Duration": "duration",
}
PRIMITIVES = frozenset(
    "bool byte char int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 float64 string time duration".split()
)
_INTEGER_RANGES = {f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)} | {
    f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)
}
# Fields that ROS 2 added to types of ROS 1.
_HIDDEN = {
    "visualization_msgs/Marker": {"texture_resource", "texture", "uv_coordinates", "mesh_file"},
    "sensor_msgs/Range": {"variance"},
    "shape_msgs/SolidPrimitive": {"polygon"},
}
# Fields that ROS 2 renamed: name in ROS 2 -> name in ROS 1.
_RENAMED = {"sensor_msgs/CameraInfo": {"d": "D", "k": "K", "r": "R", "p": "P"}}
_FIELD = re.compile(r"^([A-Za-z][\w/]*)(<=\d+)?\s*(\[\s*(?:<=)?\s*\d*\s*\])?\s+([A-Za-z]\w*)(\s+\S.*)?$")
_CONSTANT = re.compile(r"^\s*([a-z]+\d*)\s+([A-Za-z]\w*)\s*=(.*)$")


@dataclass
class Field:
    """A field: its name and type in ROS 1, and the slot of its value."""

    name: str
    type: str
    slot: str
    #: `FILE:LINE` of its definition; empty for a type of the registry.
    place: str = ""


@dataclass
class Definition:
    """A message type of ROS 1."""

    #: Name in ROS 1, such as ``std_msgs/String``.
    type: str
    #: Name of the native type, such as ``std_msgs/msg/String``.
    native: str
    fields: list[Field]
    constants: dict[str, Any] = field(default_factory=dict)
    #: Lines ``type NAME=value`` of the constants, or None if their types are not known.
    constant_lines: list[str] | None = field(default_factory=list)
    #: Fields that only ROS 2 has.
    hidden: list[Field] = field(default_factory=list)
    handle: Any = None
    #: Text with bounds or defaults, which only ROS 2 has and the registry is to have as it is; None for others.
    ros2_text: str | None = None


def native_type_name(name: str) -> str:
    """Name that ROS 2 permits for a type: words that begin with a capital letter.

    >>> native_type_name("tfMessage"), native_type_name("my_Type"), native_type_name("add_two_Request")
    ('TfMessage', 'MyType', 'AddTwo_Request')
    """
    for ending in ("_Request", "_Response"):
        if name.endswith(ending):
            return native_type_name(name[: -len(ending)]) + ending
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


def type_in_ros1(native: str) -> str:
    """Name in ROS 1 of a native type.

    >>> type_in_ros1("std_srvs/srv/SetBool_Request")
    'std_srvs/SetBoolRequest'
    """
    package, _, name = native.split("/")
    return f"{package}/{_without_separator(name)}"


def _without_separator(name: str) -> str:
    """Name of a part of a service in ROS 1: `SetBoolRequest` for `SetBool_Request`."""
    whole, _, ending = name.rpartition("_")
    return whole + ending if whole and ending in ("Request", "Response") else name


def _ros1_type(text: str) -> str:
    """Type of a field in ROS 1 of its type in rosidl's notation, such as ``sequence<double>``."""
    if text.startswith("sequence<"):
        return _ros1_type(text[len("sequence<") : -1].split(",")[0].strip()) + "[]"
    if text.endswith("]"):
        base, _, length = text[:-1].rpartition("[")
        return f"{_ros1_type(base)}[{length}]"
    if text.startswith(("string<", "wstring<")):
        return "string"
    if text.count("/") == 2:
        package, _, name = text.split("/")
        text = f"{package}/{name}"
    return _BASIC.get(text, text)


def from_handle(handle: Any) -> Definition:
    """Definition of a native type."""
    native = handle.type_name
    name = type_in_ros1(native)
    hidden_names = _HIDDEN.get(name, ())
    renamed = _RENAMED.get(name, {})
    fields: list[Field] = []
    hidden: list[Field] = []
    if name == "std_msgs/Header":
        fields.append(Field("seq", "uint32", "_seq"))
    for field_name, type_text in handle.fields:
        if field_name == "structure_needs_at_least_one_member":
            continue
        one = Field(renamed.get(field_name, field_name), _ros1_type(type_text), "_" + field_name)
        (hidden if field_name in hidden_names else fields).append(one)
    constants = {
        key: value[0] if isinstance(value, bytes) else value for key, value in handle.constants.items()
    }
    return Definition(name, native, fields, constants, None if constants else [], hidden, handle)


class DefinitionError(ValueError):
    """A line of a `.msg`, `.srv` or `.action` file is not understood."""


def parse(text: str, package: str, name: str, kind: str = "msg", file: str = "") -> Definition:
    """Definition of a message text of ROS 1."""
    fields: list[Field] = []
    constants: dict[str, Any] = {}
    lines: list[str] = []
    used: set[str] = set()
    is_ros2 = False
    for number, line in enumerate(text.splitlines(), 1):
        constant = _CONSTANT.match(line)
        if constant is not None:
            type_text, key, value = constant.groups()
            if type_text != "string":
                value = value.split("#", 1)[0]
            value = value.strip()
            constants[key] = _constant(type_text, value, f"{file}:{number}")
            lines.append(f"{type_text} {key}={value}")
            continue
        line = line.split("#", 1)[0].strip()
        if not line:
            continue
        match = _FIELD.match(line)
        if match is None:
            at = f"{file or package + '/' + name}:{number}"
            raise DefinitionError(f"{at}: `{line}` is neither `type name` nor `type NAME=value`")
        base, bound, array, field_name, default = match.groups()
        array = (array or "").replace(" ", "")
        if bound or default or "<=" in array or base in ("wstring", "builtin_interfaces/Time", "builtin_interfaces/Duration"):
            is_ros2 = True
        array = "[]" if "<=" in array else array
        base = _BASIC.get(base, base)
        if base in ("Header", "roslib/Header"):
            base = "std_msgs/Header"
        elif "/" not in base and base not in PRIMITIVES:
            base = f"{package}/{base}"
        place = f"{file}:{number}" if file else ""
        if any(one.name == field_name for one in fields):
            raise DefinitionError(f"{place or package + '/' + name}: `{field_name}` is already defined")
        slot = _native_name(field_name, used)
        fields.append(Field(field_name, base + array, "_" + slot, place))
    ros1_name = f"{package}/{_without_separator(name) if kind == 'srv' else name}"
    made = Definition(ros1_name, f"{package}/{kind}/{native_type_name(name)}", fields, constants, lines)
    made.ros2_text = text if is_ros2 else None
    return made


def _native_name(name: str, used: set[str]) -> str:
    """Field name that ROS 2 permits: lower case with single underscores."""
    native = re.sub(r"__+", "_", re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()).strip("_") or "field"
    while native in used:
        native += "x"
    used.add(native)
    return native


def _constant(type_text: str, value: str, where: str) -> Any:
    try:
        if type_text == "string":
            return value
        if type_text in ("float32", "float64"):
            return float(value)
        if type_text == "bool":
            return {"true": True, "1": True, "false": False, "0": False}[value.lower()]
        number = int(value, 0) if not re.fullmatch(r"-?0\d+", value) else int(value)
        low, high = _INTEGER_RANGES.get(type_text, (number, number))
        if not low <= number <= high:
            raise DefinitionError(f"{where}: `{value}` is not a value of {type_text}: it has {low} to {high}")
        return number
    except DefinitionError:
        raise
    except (ValueError, KeyError):
        raise DefinitionError(f"{where}: `{value}` is not a value of {type_text}") from None


def native_text(definition: Definition) -> str:
    """Text of the same type for the native registry."""
    if definition.ros2_text is not None:
        return definition.ros2_text.rstrip("\n") + "\n"
    lines = []
    for one in definition.fields:
        if one.slot == "_seq" and definition.type == "std_msgs/Header":
            continue
        base, bracket, rest = one.type.partition("[")
        base = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}.get(base, base)
        # `byte` and `char` are numbers in ROS 1.
        base = {"byte": "int8", "char": "uint8"}.get(base, base)
        if "/" in base:
            package, _, name = base.partition("/")
            base = f"{package}/{native_type_name(name)}"
        lines.append(f"{base}{bracket}{rest} {one.slot[1:]}")
    return "\n".join(lines) + "\n"


def base_type(type_text: str) -> str:
    """Type without the brackets of an array."""
    return type_text.split("[", 1)[0]


def element_class(type_text: str) -> Any:
    """Class of a field's type, or of its elements; None for numbers and strings."""
    base = base_type(type_text)
    if base in ("time", "duration"):
        import genpy

        return genpy.Time if base == "time" else genpy.Duration
    if base in PRIMITIVES:
        return None
    from periplus.ros._genpy import message_class

    return message_class(base)


def md5_text(definition: Definition) -> str | None:
    """Text of which the checksum is taken, or None if a constant's type is not known."""
    if definition.constant_lines is None:
        return None
    lines = list(definition.constant_lines)
    for one in definition.fields:
        base = base_type(one.type)
        if base in PRIMITIVES:
            lines.append(f"{one.type} {one.name}")
        else:
            nested = md5sum(element_class(base).__definition__)
            if nested == "*":
                return None
            lines.append(f"{nested} {one.name}")
    return "\n".join(lines)


def md5sum(definition: Definition) -> str:
    """Checksum of ROS 1, or ``*`` if it cannot be computed from the registry."""
    text = md5_text(definition)
    return "*" if text is None else hashlib.md5(text.encode()).hexdigest()


def full_text(definition: Definition) -> str:
    """Definition with those of all nested types, as bags carry it."""
    parts: list[str] = []
    done: set[str] = set()

    def visit(one: Definition) -> None:
        done.add(one.type)
        lines = list(one.constant_lines or [f"int32 {key}={value}" for key, value in one.constants.items()])
        lines += [f"{each.type} {each.name}" for each in one.fields]
        body = "\n".join(lines) + "\n"
        parts.append(body if not parts else f"{'=' * 80}\nMSG: {one.type}\n{body}")
        for each in one.fields:
            base = base_type(each.type)
            if base not in PRIMITIVES and base not in done:
                visit(element_class(base).__definition__)

    visit(definition)
    return "\n".join(parts)
