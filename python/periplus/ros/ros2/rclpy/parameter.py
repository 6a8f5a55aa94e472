"""Parameters."""

from __future__ import annotations

from array import array
from enum import Enum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rcl_interfaces.msg import Parameter as ParameterMessage
    from rcl_interfaces.msg import ParameterValue

PARAMETER_SEPARATOR_STRING = "."

_INTEGER_CODES = "bBhHiIlLqQ"


class _Type(Enum):
    """Type of a parameter."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    def __str__(self) -> str:
        return f"Type.{self.name}"

    @classmethod
    def from_parameter_value(cls, parameter_value: Any) -> _Type:
        """Type of a value. Raises `TypeError` for a value that no parameter can have. An empty list is a BYTE_ARRAY."""
        value = parameter_value
        if value is None:
            return cls.NOT_SET
        if isinstance(value, bool):
            return cls.BOOL
        if isinstance(value, int):
            return cls.INTEGER
        if isinstance(value, float):
            return cls.DOUBLE
        if isinstance(value, str):
            return cls.STRING
        if isinstance(value, array):
            if value.typecode in _INTEGER_CODES:
                return cls.INTEGER_ARRAY
            if value.typecode in "fd":
                return cls.DOUBLE_ARRAY
        if isinstance(value, (list, tuple)):
            for element, kind in (
                (bytes, cls.BYTE_ARRAY),
                (bool, cls.BOOL_ARRAY),
                (int, cls.INTEGER_ARRAY),
                (float, cls.DOUBLE_ARRAY),
                (str, cls.STRING_ARRAY),
            ):
                if all(isinstance(one, element) for one in value):
                    return kind
            raise TypeError(f"The given value is not a list of one of the allowed types '{value}'.")
        raise TypeError(f"The given value is not one of the allowed types '{value}'.")

    def check(self, parameter_value: Any) -> bool:
        """True if a value has this type."""
        value = parameter_value
        if self is _Type.NOT_SET:
            return value is None
        if self is _Type.BOOL:
            return isinstance(value, bool)
        if self is _Type.INTEGER:
            return isinstance(value, int)
        if self is _Type.DOUBLE:
            return isinstance(value, float)
        if self is _Type.STRING:
            return isinstance(value, str)
        if isinstance(value, array):
            codes = {_Type.INTEGER_ARRAY: _INTEGER_CODES, _Type.DOUBLE_ARRAY: "fd"}.get(self, "")
            return value.typecode in codes
        element: type = {
            _Type.BYTE_ARRAY: bytes,
            _Type.BOOL_ARRAY: bool,
            _Type.INTEGER_ARRAY: int,
            _Type.DOUBLE_ARRAY: float,
            _Type.STRING_ARRAY: str,
        }[self]
        return isinstance(value, (list, tuple)) and all(isinstance(one, element) for one in value)


_Type.__name__ = _Type.__qualname__ = "Type"


class Parameter:
    """Name, type and value of a parameter."""

    Type = _Type

    @classmethod
    def from_parameter_msg(cls, param_msg: ParameterMessage) -> Parameter:
        """Parameter of a message."""
        return cls(param_msg.name, _Type(param_msg.value.type), parameter_value_to_python(param_msg.value))

    def __init__(self, name: str, type_: _Type | None = None, value: Any = None) -> None:
        if type_ is None:
            type_ = _Type.from_parameter_value(value)
        if not isinstance(type_, _Type):
            raise TypeError(f"type must be an instance of '{_Type!r}'")
        if not type_.check(value):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._type_ = type_
        self._name = name
        self._value = value

    @property
    def name(self) -> str:
        """Name of the parameter."""
        return self._name

    @property
    def type_(self) -> _Type:
        """Type of the parameter."""
        return self._type_

    @property
    def value(self) -> Any:
        """Value of the parameter; None if it is not set."""
        return self._value

    def get_parameter_value(self) -> ParameterValue:
        """The value as a message, with one field for each type."""
        from rcl_interfaces.msg import ParameterValue

        made = ParameterValue(type=self._type_.value)
        if self._type_ is not _Type.NOT_SET:
            setattr(made, _FIELDS[self._type_], self._value)
        return made

    def to_parameter_msg(self) -> ParameterMessage:
        """The parameter as a message."""
        from rcl_interfaces.msg import Parameter as ParameterMessage

        return ParameterMessage(name=self._name, value=self.get_parameter_value())


_FIELDS: dict[_Type, str] = {kind: f"{kind.name.lower()}_value" for kind in _Type if kind is not _Type.NOT_SET}


def parameter_value_to_python(parameter_value: ParameterValue) -> Any:
    """The value in a message; None if it is not set. Raises `RuntimeError` for an unknown type."""
    try:
        kind = _Type(parameter_value.type)
    except ValueError:
        raise RuntimeError(f"unexpected parameter type {parameter_value.type}") from None
    if kind is _Type.NOT_SET:
        return None
    value: Any = getattr(parameter_value, _FIELDS[kind])
    if kind in (_Type.INTEGER_ARRAY, _Type.DOUBLE_ARRAY, _Type.BOOL_ARRAY, _Type.STRING_ARRAY, _Type.BYTE_ARRAY):
        return value if isinstance(value, array) else list(value)
    return value


def get_parameter_value(string_value: str) -> ParameterValue:
    """Value of a text of YAML, as on a command line; what is no number, boolean or list is a string."""
    from rcl_interfaces.msg import ParameterValue

    from rclpy._yaml import scalar_or_list

    value = scalar_or_list(string_value)
    if value is None or isinstance(value, dict):
        value = string_value
    if value == []:
        return ParameterValue(type=_Type.BOOL_ARRAY.value)
    try:
        kind = _Type.from_parameter_value(value)
    except TypeError:
        kind, value = _Type.STRING, string_value
    made = ParameterValue(type=kind.value)
    setattr(made, _FIELDS[kind], value)
    return made


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, ParameterMessage]:
    """Parameters of a file, by name.

    Args:
        parameter_file: Path of the file.
        use_wildcard: Take the parameters under `/**` too (default False).
        target_nodes: Names of the nodes whose parameters are taken (default: all).
        namespace: Prefix of the names (default none).

    Raises:
        RuntimeError: The file has no parameters for the nodes, or is no parameter file.
    """
    from rclpy._yaml import load

    with open(parameter_file, encoding="utf-8") as file:
        nodes = load(file.read())
    if not isinstance(nodes, dict):
        raise RuntimeError(f"{parameter_file} is not a parameter file: it has no mapping of nodes")
    wanted = [name for name in nodes if name != "/**"] if target_nodes is None else list(target_nodes)
    if use_wildcard:
        wanted.insert(0, "/**")
    values: dict[str, Any] = {}
    found = False
    for name in wanted:
        content = nodes.get(name)
        if content is None:
            continue
        if not isinstance(content, dict) or not isinstance(content.get("ros__parameters"), dict):
            raise RuntimeError(f"Invalid structure of parameter file, expected same format as provided by ros2 param dump: {name}")
        found = True
        values.update(content["ros__parameters"])
    if not found:
        raise RuntimeError(f"Param file does not contain parameters for {wanted}")
    return _unpack_parameter_dict(namespace, values)


def _unpack_parameter_dict(namespace: str, parameter_dict: dict[str, Any]) -> dict[str, ParameterMessage]:
    """Messages of nested values, with names joined by dots."""
    found: dict[str, ParameterMessage] = {}
    for name, value in parameter_dict.items():
        full = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}" if namespace else str(name)
        if isinstance(value, dict):
            found.update(_unpack_parameter_dict(full, value))
        else:
            found[full] = Parameter(full, value=value).to_parameter_msg()
    return found
